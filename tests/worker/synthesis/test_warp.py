"""Displaced look-ups against shifts and blends worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.warp import WarpSpec
from worker.images.image import Image
from worker.images.volume import Volume
from worker.stages import silent
from worker.synthesis.warp import synthesize, synthesize_volume

NUMBERS = st.floats(-(2.0**127), 2.0**127, width=32)


def warped(texels, by, **fields):
    nothing = ConstantSpec(technique="constant", value=0.0)
    spec = WarpSpec(technique="warp", input=nothing, by=nothing, **fields)
    texels, by = np.array(texels, np.float32), np.array(by, np.float32)
    by = np.array(np.broadcast_to(by, (*texels.shape[:2], by.shape[-1] if by.ndim else 1)))
    before = texels.copy(), by.copy()
    texels.flags.writeable = by.flags.writeable = False
    inputs = {"input": Image(texels, "colour"), "by": Image(by, "data")}
    image = synthesize(spec, texels.shape[1::-1], inputs, silent)
    assert image.meaning == "colour"
    assert (texels == before[0]).all()
    assert (by == before[1]).all()
    return image.pixels


def random_texels(width, height):
    return np.random.default_rng(width + height).random((height, width, 3), "f4")


def test_at_rest_every_bit_stays():
    texels = random_texels(7, 5)

    assert warped(texels, 0.25, rest=0.25).tobytes() == texels.tobytes()
    assert warped(texels, 3.0, strength=[0.0, 0.0]).tobytes() == texels.tobytes()


@given(st.integers(-40, 40), st.integers(-40, 40))
def test_whole_texels_shift_around_the_edges(across, up):
    texels = random_texels(8, 4)

    found = warped(texels, [across / 8, up / 4], strength=[1.0, 1.0], rest=0.0)

    # Looking to the right and up brings the picture to the left and down; row 0 is at the top
    assert (found == np.roll(texels, (up, -across), (0, 1))).all()


def test_parts_of_texels_are_blended():
    row = np.float32([0, 8, 0, 0]).reshape(1, 4, 1)

    assert warped(row, 1 / 16, strength=[1.0, 0.0], rest=0.0).ravel().tolist() == [2, 6, 0, 0]
    column = row.reshape(4, 1, 1)
    assert warped(column, 1 / 16, strength=[0.0, 1.0], rest=0.0).ravel().tolist() == [0, 6, 2, 0]
    # T42: 2x2 [[0, 1], [2, 4]] with v upwards has 1.75 in its middle
    texels = np.float32([[2, 4], [0, 1]])[..., np.newaxis]
    assert warped(texels, 1.0, strength=[0.25, 0.25], rest=0.0)[1, 0, 0] == 1.75


def test_two_channels_displace_on_their_own_and_one_along_the_strength():
    texels = random_texels(8, 8)

    both = warped(texels, [0.75, 0.25], strength=[0.5, 1.0])

    assert (both == np.roll(texels, (-2, -1), (0, 1))).all()
    assert (warped(texels, 0.75, strength=[0.5, 1.0]) == np.roll(texels, (2, -1), (0, 1))).all()


@given(
    st.lists(NUMBERS, min_size=6, max_size=6),
    st.lists(NUMBERS, min_size=2, max_size=2),
    st.lists(st.floats(-16, 16), min_size=2, max_size=2),
    NUMBERS,
)
def test_every_valid_choice_is_a_blend_of_what_is_there(values, by, strength, rest):
    texels = np.float32(values).reshape(2, 3, 1)

    found = warped(texels, by, strength=strength, rest=rest)

    assert np.isfinite(found).all()
    largest = abs(texels).max()
    assert abs(found).max() <= np.nextafter(largest, np.float32(np.inf))


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    texels, by = random_texels(150, 90), random_texels(150, 90)

    one = with_threads(1, lambda: warped(texels, by))
    two = with_threads(2, lambda: warped(texels, by))

    assert one.tobytes() == two.tobytes()


@pytest.mark.parametrize("shift", [(3, 5), (0, 1)])
def test_the_warped_tile_repeats(shift):
    texels, by = random_texels(16, 12), random_texels(16, 12)

    moved = warped(np.roll(texels, shift, (0, 1)), np.roll(by, shift, (0, 1)))

    assert moved.tobytes() == np.roll(warped(texels, by), shift, (0, 1)).tobytes()


def warped_solid(voxels, by, **fields):
    nothing = ConstantSpec(technique="constant", value=0.0)
    spec = WarpSpec(technique="warp", input=nothing, by=nothing, **fields)
    shape = (*voxels.shape[:3], np.shape(by)[-1] if np.ndim(by) else 1)
    by = np.array(np.broadcast_to(np.float32(by), shape))
    inputs = {"input": Volume(voxels, "colour"), "by": Volume(by, "data")}
    made = synthesize_volume(spec, voxels.shape[2::-1], inputs, silent)
    assert made.meaning == "colour"
    return made.voxels


def random_voxels():
    return np.random.default_rng(1).random((6, 4, 8, 3), "f4")


def test_a_solid_at_rest_stays():
    assert warped_solid(random_voxels(), 0.25, rest=0.25).tobytes() == random_voxels().tobytes()


@given(*[st.integers(-20, 20)] * 3)
def test_whole_voxels_shift_around_all_faces(across, up, deep):
    by = [across / 8, up / 4, deep / 2]

    found = warped_solid(random_voxels(), by, strength=[1.0, 1.0, 2 / 6], rest=0.0)

    assert (found == np.roll(random_voxels(), (-deep, up, -across), (0, 1, 2))).all()


def test_the_last_channel_and_the_last_strength_hold_for_what_has_none():
    voxels = random_voxels()

    one = warped_solid(voxels, 1.0, strength=[0.125, 0.5], rest=0.0)
    two = warped_solid(voxels, [0.25, 0.5], strength=[0.5, 1.0, 1.0], rest=0.0)

    assert (one == np.roll(voxels, (-3, 2, -1), (0, 1, 2))).all()
    assert (two == np.roll(voxels, (-3, 2, -1), (0, 1, 2))).all()


def test_a_linear_solid_is_moved_as_far_as_it_says():
    ramp = np.arange(8, dtype=np.float32)
    voxels = ramp[:, None, None, None] * 100 - 10 * ramp[:, None, None] + ramp[:, None]

    found = warped_solid(voxels, [1 / 16, 1 / 32, 3 / 32], strength=[1.0] * 3, rest=0.0)

    # Half a column, a quarter of a row upwards, three quarters of a slice
    inside = np.s_[:7, 1:, :7]
    assert found[inside] == pytest.approx(voxels[inside] + 0.5 + 2.5 + 75, abs=1e-4)


def test_voxels_do_not_depend_on_the_number_of_threads(with_threads):
    by = np.random.default_rng(2).random((6, 4, 8, 3), "f4")

    one = with_threads(1, lambda: warped_solid(random_voxels(), by))
    two = with_threads(2, lambda: warped_solid(random_voxels(), by))

    assert one.tobytes() == two.tobytes()
