import time
from collections.abc import Iterator

import pytest

from worker.stages import Timed


def slow() -> Iterator[int]:
    for number in range(3):
        time.sleep(0.02)
        yield number


def test_it_counts_the_time_of_making_and_not_of_using() -> None:
    timed = Timed(slow())

    for _ in timed:
        time.sleep(0.1)

    assert 0.06 <= timed.seconds < 0.2


def test_it_counts_what_was_made_in_vain_too() -> None:
    def broken() -> Iterator[int]:
        time.sleep(0.02)
        raise ValueError("no more")
        yield 0

    timed = Timed(broken())
    with pytest.raises(ValueError, match="no more"):
        next(timed)

    assert timed.seconds >= 0.02
