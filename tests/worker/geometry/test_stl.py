from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.worker.geometry.refusals import outcome
from worker.errors import UnusableAssetError
from worker.geometry import stl
from worker.geometry.models import read_model

CORNERS = np.array([[(0, 0, 0), (2, 0, 0), (0, 2, 0)], [(0, 0, 1), (0, 0, 2), (1, 0, 1)]], "<f4")


def binary(corners: np.ndarray, spare: list[int] | None = None, header: bytes = b"") -> bytes:
    records = np.zeros(len(corners), [("n", "<f4", 3), ("c", "<f4", (3, 3)), ("spare", "<u2")])
    records["c"] = corners
    records["spare"] = spare or 0
    return header.ljust(80) + len(corners).to_bytes(4, "little") + records.tobytes()


def in_text(corners: np.ndarray) -> bytes:
    facets = "".join(
        "facet normal 0 0 0\n outer loop\n"
        + "".join("  vertex {} {} {}\n".format(*map(repr, vertex)) for vertex in triangle.tolist())
        + " endloop\nendfacet\n"
        for triangle in corners
    )
    return f"solid thing\n{facets}endsolid thing".encode()


@pytest.mark.parametrize("write", [binary, in_text])
def test_triangles_are_flat_and_share_nothing(write: object) -> None:
    (part,) = read_model(write(CORNERS), {}).parts  # type: ignore[operator]

    np.testing.assert_array_equal(part.mesh.positions.reshape(2, 3, 3), CORNERS)
    assert part.mesh.triangles.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert part.mesh.normals.tolist() == [[0, 0, 1]] * 3 + [[0, 1, 0]] * 3
    assert part.material is None
    assert part.mesh.colors is None


def test_a_few_bytes_after_the_triangles_are_passed_over() -> None:
    assert len(read_model(binary(CORNERS) + b"\r\n", {}).parts[0].mesh.triangles) == 2


def test_words_of_a_text_may_be_in_capitals() -> None:
    assert len(stl.read(in_text(CORNERS).upper()).parts[0].mesh.triangles) == 2


def test_colours_are_five_bits_of_srgb_blue_first_where_the_highest_bit_says_so() -> None:
    (part,) = stl.read(binary(CORNERS, [0x8000 | 31 << 10 | 15, 0])).parts

    assert part.mesh.colors is not None
    # sRGB 15 / 31 is ((15 / 31 + 0.055) / 1.055) ** 2.4 of light.
    np.testing.assert_allclose(part.mesh.colors[0], [1, 0, 0.199415, 1], atol=2e-6)
    assert part.mesh.colors[3].tolist() == [1, 1, 1, 1]


def test_magics_writes_red_first_and_a_colour_for_the_rest_in_the_header() -> None:
    header = b"STLB COLOR=\xff\x00\x00\xff"
    (part,) = stl.read(binary(CORNERS, [31 << 10, 0x8000], header)).parts

    assert part.mesh.colors is not None
    assert part.mesh.colors[0].tolist() == [0, 0, 1, 1]
    assert part.mesh.colors[3].tolist() == [1, 0, 0, 1]


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (binary(CORNERS[:0]), "no triangles"),
        (b"solid empty\nendsolid empty\n", "no triangles"),
        (binary(CORNERS * np.nan), "not three numbers"),
        (binary(CORNERS * 1e20), "not three numbers"),
        (binary(CORNERS)[:96] + b"\1\0\xa0\x7f" + binary(CORNERS)[100:], "not three numbers"),
        (in_text(CORNERS).replace(b"2.0", b"two"), "not three numbers"),
        (in_text(CORNERS)[:130], "three vertices each"),
        (in_text(CORNERS).replace(b"vertex 2.0 0.0 0.0", b""), "three vertices each"),
        (in_text(CORNERS).replace(b"endloop", b"vertex 1 1 1 endloop"), "three vertices each"),
    ],
)
def test_what_makes_no_triangles_is_refused(data: bytes, complaint: str) -> None:
    with pytest.raises(UnusableAssetError, match=complaint) as refusal:
        read_model(data, {})
    assert refusal.value.code == "asset_unusable"


def test_more_triangles_than_are_taken_are_refused_before_they_are_read() -> None:
    with pytest.raises(UnusableAssetError, match="5000000 triangles") as refusal:
        stl.read(bytes(80) + (5_000_000).to_bytes(4, "little") + bytes(50 * 5_000_000))
    assert refusal.value.code == "asset_too_large"


@given(st.integers(0, 183), st.integers(0, 255))
def test_damage_is_read_or_refused_by_name(at: int, value: int) -> None:
    for data in (binary(CORNERS), in_text(CORNERS)):
        damaged = bytearray(data)
        damaged[at] = value
        for content in (bytes(damaged), data[:at]):
            assert outcome(content, {}) in ("read", "asset_unusable", "asset_unsupported")


@pytest.mark.corpus
def test_the_spider_in_text_and_in_binary_is_one_spider(corpus: Path) -> None:
    folder = corpus / "1_models" / "assimp" / "STL"
    text, packed = (
        stl.read((folder / name).read_bytes()).parts[0].mesh
        for name in ("Spider_ascii.stl", "Spider_binary.stl")
    )

    np.testing.assert_array_equal(text.triangles, packed.triangles)
    np.testing.assert_allclose(text.positions, packed.positions, atol=1e-5)  # six digits of 4
