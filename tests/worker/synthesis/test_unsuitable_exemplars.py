"""What every technique makes of exemplars, masks and guides that hardly suit it, or not at all."""

import numpy as np
import pytest

from api_schemas.by_example import FromExemplarSpec, GrownSpec, GuidedSpec, KeepingSpec
from api_schemas.language import FAMILIES
from tests.growing import colours, grow, noise
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis._resample import resample

SPECS = {
    name: spec for name, spec in FAMILIES["textures"].items() if issubclass(spec, FromExemplarSpec)
}
BLENDED = ("by_example_noise", "hallucination", "hex_tiling")
"""What computes with pixels, and does not only copy them."""
FILLING = ("hole_filling", "image_shuffling")
NOT_A_PICTURE = ("nearest_neighbour_field",)
"""What makes a field, not colours."""


def made(technique, exemplar, **fields):
    height, width = exemplar.shape[:2]
    part = np.zeros((height, width, 1), np.float32)
    part[: max(1, height // 3), : max(1, width // 3)] = 1
    needed = {
        "hole_filling": {"hole": part},
        "image_shuffling": {"region": part, "shift": [1, 1], "margin": 1},
        "nearest_neighbour_field": {"target": noise(12, 14, seed=8)},
        "hallucination": {"target": exemplar[::2, ::2]},
    }
    size = (20, 18) if issubclass(SPECS[technique], GrownSpec) else (width, height)
    return grow(technique, exemplar, size, **{**needed.get(technique, {}), **fields})


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (5, 4)])
@pytest.mark.parametrize("technique", SPECS)
def test_an_exemplar_smaller_than_the_neighbourhood_is_compared_with_less(technique, shape):
    exemplar = noise(*shape)
    if technique in FILLING and shape == (1, 1):
        # The part that is made anew would be all there is
        with pytest.raises(RenderError, match="copy"):
            made(technique, exemplar)
        return

    pixels = made(technique, exemplar).image.pixels

    assert np.isfinite(pixels).all()
    if technique not in (*BLENDED, *NOT_A_PICTURE):
        assert colours(pixels) <= colours(exemplar)


@pytest.mark.parametrize("technique", sorted(set(SPECS) - set(NOT_A_PICTURE)))
def test_a_constant_exemplar_stays_constant(technique):
    pixels = made(technique, np.full((24, 24, 3), 0.25, np.float32)).image.pixels

    # What blends has the rounding of its weights, whose sum is 1
    assert np.abs(pixels - 0.25).max() <= (1e-5 if technique in BLENDED else 0)


@pytest.mark.parametrize("technique", SPECS)
@pytest.mark.parametrize("left_out", ["mask", "alpha"])
def test_what_leaves_nothing_to_copy_is_refused_by_name(technique, left_out):
    exemplar, fields = noise(20, 20), {}
    if left_out == "mask":
        fields["exemplar_mask"] = np.full((20, 20, 1), 0.49, np.float32)
    else:
        exemplar = np.concatenate([exemplar * 0, np.zeros((20, 20, 1), np.float32)], axis=-1)

    with pytest.raises(RenderError) as caught:
        made(technique, exemplar, **fields)

    assert caught.value.code == "exemplar_unusable"


@pytest.mark.parametrize("technique", sorted(set(SPECS) - set(BLENDED) - set(NOT_A_PICTURE)))
def test_a_mask_of_one_half_is_one_that_copies(technique):
    # A whole grey mask leaves all; the left half a little darker leaves the right one
    exemplar, mask = noise(24, 30), np.full((24, 30, 1), 0.5, np.float32)
    mask[:, :15] = 0.49

    kept = colours(exemplar) if technique in FILLING else set()
    pixels = made(technique, exemplar, exemplar_mask=mask).image.pixels

    assert colours(pixels) <= kept | colours(exemplar[:, 15:])
    if technique in FILLING:
        hole = pixels[:8, :10] if technique == "hole_filling" else pixels[:1, :10]
        assert colours(hole) <= colours(exemplar[:, 15:])


@pytest.mark.parametrize("technique", SPECS)
@pytest.mark.parametrize("value", [np.nan, -np.inf, 3e38])
def test_numbers_that_are_none_do_not_stop_it(technique, value):
    exemplar = noise(16, 16)
    exemplar[3:6, 8:12] = value

    pixels = made(technique, exemplar).image.pixels

    if technique in BLENDED:
        assert np.isfinite(pixels).all()
    elif technique not in NOT_A_PICTURE:
        assert colours(pixels) <= colours(exemplar)


def brought(pixels, width, height):
    return resample(Image(pixels, "data").pixels, (width, height))


@pytest.mark.parametrize(
    "technique", [name for name, spec in SPECS.items() if issubclass(spec, GuidedSpec)]
)
def test_a_guide_of_another_size_is_brought_to_that_of_the_result(technique):
    exemplar, ours, guide = noise(24, 24), noise(9, 40, 1, 1), noise(7, 33, 1, 2)

    small = made(technique, exemplar, guide=guide, exemplar_guide=ours).image.pixels
    whole = made(
        technique, exemplar, guide=brought(guide, 20, 18), exemplar_guide=brought(ours, 24, 24)
    ).image.pixels

    assert small.tobytes() == whole.tobytes()


@pytest.mark.parametrize(
    "technique", [name for name, spec in SPECS.items() if issubclass(spec, KeepingSpec)]
)
def test_what_is_kept_is_brought_to_the_size_of_the_result(technique):
    exemplar, keep = noise(24, 24), noise(5, 50, seed=1)
    mask = np.zeros((3, 3, 1), np.float32)
    mask[1, 1] = 1

    pixels = made(technique, exemplar, keep=keep, keep_mask=mask).image.pixels

    stays = brought(mask, 20, 18)[..., 0] >= 0.5
    assert 10 < stays.sum() < 200
    assert pixels[stays].tobytes() == brought(keep, 20, 18)[stays].tobytes()
    assert colours(pixels[~stays]) <= colours(exemplar)


@pytest.mark.parametrize("technique", FILLING)
def test_a_hole_of_another_size_is_brought_to_that_of_the_picture(technique):
    picture, part = noise(24, 30), np.zeros((3, 5, 1), np.float32)
    part[1, 2] = 1
    name = "hole" if technique == "hole_filling" else "region"

    small, whole = (
        made(technique, picture, **{name: each}).image.pixels
        for each in (part, brought(part, 30, 24))
    )

    assert small.tobytes() == whole.tobytes()
    assert small.tobytes() != picture.tobytes()


@pytest.mark.parametrize("technique", FILLING)
def test_a_part_that_is_everything_leaves_nothing_to_copy(technique):
    name = "hole" if technique == "hole_filling" else "region"

    with pytest.raises(RenderError, match="nothing is left") as caught:
        made(technique, noise(20, 20), **{name: np.ones((20, 20, 1), np.float32)})

    assert caught.value.code == "exemplar_unusable"
