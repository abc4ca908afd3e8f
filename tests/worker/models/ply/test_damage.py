import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.worker.models.ply.building import FACES, FORMATS, SQUARE, XYZ, ply, square
from tests.worker.models.refusals import outcome
from worker.errors import UnusableAssetError
from worker.models.formats import read_model

HEAD = b"ply\nformat ascii 1.0\nelement vertex 3\n"


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"ply\n", "its header has no end"),
        (b"ply\nend_header\n", "does not say the format"),
        (b"ply\nformat ascii 1.0\nend_header\n", "no vertices"),
        (b"ply\nformat ebcdic 1.0\nend_header\n", "line 2 of its header"),
        (b"ply\nproperty float x\nend_header\n", "line 2 of its header"),
        (HEAD + b"property half x\nend_header\n", "no known type"),
        (HEAD + b"property list float int x\nend_header\n", "no known type"),
        (HEAD + b"property float x\nend_header\n1 2 3", "no x, y and z"),
        (HEAD.replace(b"3", b"-3") + b"end_header\n", "line 3 of its header"),
        (HEAD.replace(b"3", b"0") + b"property int x\nend_header\n", "no vertices"),
        (square()[:-20], "fewer numbers than|longer than"),
        (square("binary_little_endian")[:-1], "longer than what is there"),
        (square("binary_big_endian")[:-20], "fewer numbers than"),
        (square(faces=[((0, 1, 4),)]), "names none of its 4 vertices"),
        (square(faces=[((0, 1, -1),)]), "names none of its 4 vertices"),
        (square().replace(b"0 1 2 3 \n", b"0 1 2 x \n"), "names none of its 4 vertices"),
        (square().replace(b"1 0 0", b"1 nan 0"), "not three numbers"),
        (square().replace(b"1 0 0", b"1 2e9 0"), "not three numbers"),
    ],
)
def test_what_cannot_be_meant_is_refused(data: bytes, complaint: str) -> None:
    with pytest.raises(UnusableAssetError, match=complaint) as refusal:
        read_model(data, {})
    assert refusal.value.code == "asset_unusable"


@pytest.mark.parametrize("form", FORMATS)
def test_a_hundred_thousand_million_vertices_are_refused_before_any_is_read(form: str) -> None:
    data = square(form).replace(b"element vertex 4", b"element vertex 99999999999")

    with pytest.raises(UnusableAssetError, match="99999999999 rows") as refusal:
        read_model(data, {})
    assert refusal.value.code == "asset_too_large"


@pytest.mark.parametrize("form", FORMATS)
def test_a_list_of_four_thousand_million_items_is_refused(form: str) -> None:
    data = ply(form, ("vertex", XYZ, SQUARE), ("face", [("list uint int", "vertex_indices")], []))
    data = data.replace(b"element face 0", b"element face 1")
    data += b"4294967295 " if form == "ascii" else b"\xff\xff\xff\xff"

    with pytest.raises(UnusableAssetError, match="longer than what is there"):
        read_model(data, {})


@given(st.sampled_from(FORMATS), st.binary(max_size=3), st.integers(0, 330), st.integers(0, 30))
def test_damage_is_read_or_refused_by_name(form: str, noise: bytes, at: int, cut: int) -> None:
    layout = [*FACES, ("list uchar float", "texcoord"), ("uchar", "red")]
    whole = ply(
        form, ("vertex", XYZ, SQUARE), ("face", layout, [((0, 1, 2), (0, 0, 1, 0, 1, 1), 9)])
    )
    damaged = whole[:at] + noise + whole[at + cut :]

    named = ("read", "asset_unusable", "asset_unsupported", "asset_too_large")
    assert outcome(damaged, {}) in named
