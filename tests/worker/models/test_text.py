import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.models import text


def read(word: str) -> float:
    return text.number(np.frombuffer(word.encode(), np.uint8), 0, len(word))


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("0", 0.0),
        ("-0", -0.0),
        ("1", 1.0),
        ("+1.5", 1.5),
        ("-2.", -2.0),
        (".25", 0.25),
        ("2.e1", 20.0),
        ("3.1e+02", 310.0),
        ("3.1E-2", 0.031),
        ("1e22", 1e22),
        ("0.000000000000000000000000000001", 1e-30),
        ("00000000000000000000000000000007.5", 7.5),
        ("1e400", math.inf),
        ("-1e99999999999999999999", -math.inf),
        ("1e-400", 0.0),
        ("0e999", 0.0),
    ],
)
def test_decimal_numbers_are_read(word: str, value: float) -> None:
    assert read(word) == pytest.approx(value, rel=1e-15)
    assert math.copysign(1, read(word)) == math.copysign(1, value)


@pytest.mark.parametrize(
    "word", ["", "+", "-", ".", "e5", "1e", "1e+", "3.1+e2", "1.2.3", "1_000", "nan", "inf", "0x1"]
)
def test_what_is_no_decimal_number_is_nan(word: str) -> None:
    assert math.isnan(read(word))


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_any_double_comes_back_within_three_units_in_the_last_place(value: float) -> None:
    assert abs(read(repr(value)) - value) <= 3 * math.ulp(value)


@given(st.decimals(-1e6, 1e6, places=6))
def test_six_decimals_come_back_exactly(value: object) -> None:
    assert read(str(value)) == float(str(value))


def test_words_and_lines_are_told_apart_by_any_blank_and_any_line_end() -> None:
    content = np.frombuffer(b"\n 1\t2 \r\n\r3\x0b4\n\n5", np.uint8)
    words, lines = text.count_words(content)
    numbers, starts = np.empty(words), np.empty(lines, np.int64)

    text.read_numbers(content, numbers, starts)

    assert numbers.tolist() == [1, 2, 3, 4, 5]
    assert starts.tolist() == [0, 2, 4]
