"""Frequencies that are none, that do not divide the tile, or that no memory holds."""

import pytest
from pydantic import TypeAdapter, ValidationError

from api_schemas.estimate import estimate
from api_schemas.members import Texture
from api_schemas.requests import TextureRequest
from service.settings import Settings

WHOLE = ["perlin", "worley", "wavelet", "gardner", "gardner_product", "perlin_curve"]


@pytest.mark.parametrize("name", WHOLE)
@pytest.mark.parametrize("frequency", [0, -3, 2.5, 1e9, 1e300, float("nan"), float("inf"), "8"])
def test_only_whole_frequencies_that_can_be_drawn_are_taken(name, frequency):
    with pytest.raises(ValidationError) as caught:
        TypeAdapter(Texture).validate_python({"technique": name, "frequency": frequency})

    assert {error["loc"][-1] for error in caught.value.errors()} == {"frequency"}


@pytest.mark.parametrize("field", ["frequency", "octaves", "lacunarity", "beats"])
@pytest.mark.parametrize("value", [0, 1.5, 1e6])
def test_every_count_of_perlin_is_whole_and_bounded(field, value):
    with pytest.raises(ValidationError):
        TypeAdapter(Texture).validate_python({"technique": "perlin", field: value})


@pytest.mark.parametrize("name", ["perlin", "worley", "wavelet", "gardner"])
def test_a_solid_larger_than_the_memory_is_beyond_the_limit(name):
    def held(slices):
        body = {
            "texture": {"technique": name},
            "output": {"size": [1024, 1024], "slices": slices, "format": "exr"},
        }
        return estimate(TextureRequest.model_validate(body), {}).bytes

    assert held(512) > Settings().cost_limit_bytes > held(16)
