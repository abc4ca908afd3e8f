"""Marble: stripes where nothing bends them (T49), and what bends them."""

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.synthesis import synthesize, synthesize_volume
from worker.synthesis.marble import marble_at


def spec(**fields):
    return TypeAdapter(Texture).validate_python({"technique": "marble", **fields})


def centres(*counts):
    axes = [(np.arange(count) + 0.5) / count for count in counts]
    axes[1] = axes[1][::-1]
    return np.stack(np.meshgrid(*axes[::-1], indexing="ij")[::-1], axis=-1)


@pytest.mark.parametrize("veins", [[5, 0], [3, -2], [0, 0]])
def test_t49_without_turbulence_it_is_exact_stripes(veins):
    pixels = synthesize(spec(veins=veins, strength=0.0, range="signed"), (300, 200), None).pixels

    angle = 2 * np.pi * centres(300, 200) @ veins
    # Averaged over a pixel: a sinc of 5 in 300 pixels takes 4.6e-4 away
    assert pixels[..., 0] == pytest.approx(np.sin(angle), abs=5e-4)


def test_a_value_of_one_moves_the_veins_by_the_strength():
    moved = spec(
        veins=[4, 0], strength=2.0, rest=0.25, turbulence={"technique": "constant", "value": 1.0}
    )

    pixels = synthesize(moved, (400, 2), None).pixels[..., 0]

    angle = 2 * np.pi * 4 * (np.arange(400) + 0.5) / 400 + 1.5
    assert pixels[0] == pytest.approx(0.5 + 0.5 * np.sin(angle), abs=2e-4)


def test_pictures_and_solids_are_what_points_have():
    bent = {"technique": "perlin", "frequency": 4, "gradients": "reference", "octaves": 2}
    texture = spec(veins=[1, 2, -3], turbulence=bent, strength=5.0)

    pixels = synthesize(texture, (12, 9), None).pixels[..., 0]
    voxels = synthesize_volume(texture, (12, 9, 7)).voxels[..., 0]

    plane = synthesize(texture.turbulence, (12, 9), None).pixels[..., 0].astype(np.float64)
    space = synthesize_volume(texture.turbulence, (12, 9, 7)).voxels[..., 0].astype(np.float64)
    assert pixels.ravel() == pytest.approx(
        marble_at(texture, centres(12, 9).reshape(-1, 2), plane.ravel(), np.diag([1 / 12, 1 / 9])),
        abs=1e-6,
    )
    assert voxels.ravel() == pytest.approx(
        marble_at(
            texture,
            centres(12, 9, 7).reshape(-1, 3),
            space.ravel(),
            np.diag([1 / 12, 1 / 9, 1 / 7]),
        ),
        abs=1e-6,
    )


def test_veins_too_fine_for_the_pixels_fade():
    pixels = synthesize(spec(veins=[64, 0], strength=0.0), (64, 4), None).pixels

    assert pixels == pytest.approx(0.5, abs=1e-6)


def test_the_tile_repeats():
    pixels = synthesize(spec(veins=[2, 1]), (256, 256), None).pixels[..., 0]

    for axis in (0, 1):
        seam = abs(np.take(pixels, 0, axis) - np.take(pixels, -1, axis)).max()
        assert seam <= 1.2 * abs(np.diff(pixels, axis=axis)).max()
