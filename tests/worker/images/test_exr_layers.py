import numpy as np
import pytest

from api_schemas.families import Meaning
from worker.images.exr_layers import join_layers
from worker.images.image import Image


def flat(channels: int, meaning: Meaning, value: float = 1.0) -> Image:
    return Image(np.full((2, 3, channels), value, np.float32), meaning)


@pytest.mark.parametrize(
    ("layer", "meaning", "channels", "names"),
    [
        ("", "colour", 1, "Y"),
        ("", "colour", 2, "Y A"),
        ("", "colour", 3, "R G B"),
        ("", "colour", 4, "R G B A"),
        ("", "data", 1, "Y"),
        ("", "data", 2, "R G"),
        ("", "data", 3, "R G B"),
        ("", "data", 4, "R G B A"),
        ("Z", "data", 1, "Z"),
        ("uv", "data", 2, "uv.U uv.V"),
        ("motion", "data", 2, "motion.X motion.Y"),
        ("N", "data", 3, "N.X N.Y N.Z"),
        ("t", "data", 4, "t.X t.Y t.Z t.W"),
        ("diffuse", "colour", 3, "diffuse.R diffuse.G diffuse.B"),
    ],
)
def test_layers_are_named_as_other_programs_expect(
    layer: str, meaning: Meaning, channels: int, names: str
) -> None:
    joined = join_layers({layer: flat(channels, meaning)}, "half")

    assert joined.names == tuple(names.split())


def test_named_data_is_float_and_colour_as_asked() -> None:
    joined = join_layers(
        {"": flat(3, "colour"), "id": flat(1, "data", 4097), "glow": flat(3, "colour")}, "half"
    )

    assert joined.types == ("half",) * 3 + ("float",) + ("half",) * 3
    assert joined.pixels.shape == (2, 3, 7)
    assert (joined.pixels[..., 3] == 4097).all()


def test_what_half_cannot_hold_saturates_and_what_is_no_number_stays() -> None:
    pixels = np.array([[[1e9], [-70000], [65504], [np.inf], [-np.inf], [np.nan]]], np.float32)
    image = Image(pixels, "colour")

    half = join_layers({"": image}, "half").pixels[0, :, 0]
    full = join_layers({"": image}, "float").pixels[0, :, 0]

    assert half.tolist()[:5] == [65504, -65504, 65504, np.inf, -np.inf]
    assert np.isnan(half[5])
    assert full.tolist()[:2] == [1e9, -70000]


def test_layers_of_different_sizes_and_none_at_all_are_refused() -> None:
    smaller = Image(np.zeros((1, 1, 1), np.float32), "data")
    with pytest.raises(ValueError, match="one size"):
        join_layers({"": flat(3, "colour"), "Z": smaller}, "half")
    with pytest.raises(ValueError, match="one size"):
        join_layers({}, "half")
