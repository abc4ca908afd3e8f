"""What must hold for every technique in the folders, new ones included."""

import copy

import numpy as np
import pytest
from hypothesis import given, settings
from pydantic import TypeAdapter

from api_schemas.families import TextureSpec
from api_schemas.language import FAMILIES, Texture
from api_schemas.walk import parts
from tests.spec_strategies import ASSET, bodies
from worker.images.image import Image
from worker.synthesis import synthesize

SIZE = (16, 16)
TEXTURES = sorted(FAMILIES["textures"])
TEXTURE = TypeAdapter(Texture)


def picture(spec, meaning):
    assert spec.asset == ASSET
    columns, rows = np.meshgrid(np.linspace(0, 1, 7), np.linspace(0, 1, 5))
    return Image(np.stack([columns, rows, columns * rows], axis=-1).astype(np.float32), meaning)


def seconds(spec):
    pixels = SIZE[0] * SIZE[1]
    return sum(
        part.cost(pixels).seconds for _, part in parts(spec) if isinstance(part, TextureSpec)
    )


def specs(name):
    return bodies(FAMILIES["textures"][name], levels=1).map(
        lambda body: TEXTURE.validate_python({"technique": name, **body})
    )


@pytest.mark.parametrize("name", TEXTURES)
def test_any_valid_spec_runs_is_finite_deterministic_and_leaves_its_spec_alone(name):
    @settings(max_examples=20)
    @given(specs(name))
    def holds(spec):
        if seconds(spec) > 0.3:
            # As valid, but a technique's own tests have the patience
            return
        before = copy.deepcopy(spec)

        image = synthesize(spec, SIZE, picture)
        again = synthesize(spec, SIZE, picture)

        assert image.pixels.shape[:2] == SIZE[::-1]
        assert image.pixels.dtype == np.float32
        assert np.isfinite(image.pixels).all()
        assert image.pixels.tobytes() == again.pixels.tobytes()
        assert spec == before

    holds()
