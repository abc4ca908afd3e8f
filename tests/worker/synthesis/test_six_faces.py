"""A cube of six separate pictures (T08, T20): each lies where its photographer looked."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.layouts.cube import CubeSpec
from api_schemas.members import Texture
from worker import layouts
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis import six_faces

# Where somebody looks, and what is to the right and up then: -z first, then a quarter turn to the
# right each time; up and down are tilted from the first.
VIEWS = {
    "front": ((0, 0, -1), (1, 0, 0), (0, 1, 0)),
    "right": ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
    "back": ((0, 0, 1), (-1, 0, 0), (0, 1, 0)),
    "left": ((-1, 0, 0), (0, 0, -1), (0, 1, 0)),
    "top": ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    "bottom": ((0, -1, 0), (1, 0, 0), (0, 0, -1)),
}
PLAIN = {"technique": "constant", "value": 0.5}
ARRANGEMENTS = ("column", "row", "cross", "tall_cross")


def photograph(name: str, side: int, channels: int = 3) -> Image:
    """What a camera of a quarter turn sees whose film tells directions."""
    forward, right, up = (np.array(axis, float) for axis in VIEWS[name])
    place = (2 * np.arange(side) + 1) / side - 1
    s, t = np.meshgrid(place, -place)
    seen = forward + s[..., None] * right + t[..., None] * up
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    pixels = np.concatenate([seen, np.ones((side, side, 1))], axis=2)[..., :channels]
    return Image(pixels.astype(np.float32), "colour")


def made(arrangement: str, unit: int, sides: dict[str, int] | None = None) -> np.ndarray:
    faces = {name: {"technique": "checkerboard"} for name in VIEWS}
    spec = TypeAdapter(Texture).validate_python(
        {"technique": "six_faces", "arrangement": arrangement, **faces}
    )
    inputs = {name: photograph(name, (sides or {}).get(name, 16)) for name in VIEWS}
    columns, rows = spec.layout.proportion
    return six_faces.synthesize(spec, (columns * unit, rows * unit), inputs, silent).pixels


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_t08_each_direction_is_where_the_cube_has_it(arrangement: str) -> None:
    pixels = made(arrangement, 16)

    layout = CubeSpec(technique="cube", arrangement=arrangement)
    height, width, _ = pixels.shape
    towards, there = layouts.direction(layout, layouts.texel_middles(width, height))
    np.testing.assert_allclose(pixels.reshape(-1, 3)[there], towards[there], atol=1e-6)
    assert not pixels.reshape(-1, 3)[~there].any()


def test_faces_of_other_sizes_are_brought_to_the_picture_s() -> None:
    # A small face grows without its far edge bleeding in, a large one shrinks to means.
    pixels = made("row", 32, {"front": 8, "right": 64})

    layout = CubeSpec(technique="cube", arrangement="row")
    towards, _ = layouts.direction(layout, layouts.texel_middles(6 * 32, 32))
    error = np.abs(pixels - towards.reshape(32, 6 * 32, 3))
    # Half a texel of 8 beyond the outermost middles; a texel is at most a quarter in a direction
    assert error[:, 5 * 32 :].max() < 0.13
    assert error[:, :32].max() < 0.002


def test_sides_that_the_faces_do_not_divide_are_filled() -> None:
    spec = TypeAdapter(Texture).validate_python(
        {"technique": "six_faces", **dict.fromkeys(VIEWS, PLAIN)}
    )
    one = {name: Image(np.ones((3, 3, 1), np.float32), "colour") for name in VIEWS}

    for size in ((1, 1), (7, 11), (2, 6)):
        pixels = six_faces.synthesize(spec, size, one, silent).pixels
        assert pixels.shape == (size[1], size[0], 3)
        assert set(np.unique(pixels)) <= {0.0, 1.0}
