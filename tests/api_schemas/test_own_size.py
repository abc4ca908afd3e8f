"""At which size the textures within a texture are made."""

import pytest
from pydantic import TypeAdapter

from api_schemas.language import Texture
from api_schemas.own_size import own_size, sizes_within

UPLOAD = {"technique": "image", "asset": "0" * 64}
SMALL_UPLOAD = {"technique": "image", "asset": "1" * 64}
NOISE = {"technique": "perlin"}
DISH = {"technique": "gray_scott", "size": [48, 32]}
STOPS = [{"position": 0.0, "color": [0.0, 0.0, 0.0]}]


def texture(body):
    return TypeAdapter(Texture).validate_python(body)


def measure(picture):
    return (300, 200) if picture.asset == "0" * 64 else (8, 8)


@pytest.mark.parametrize(
    ("body", "size"),
    [
        (UPLOAD, (300, 200)),
        (DISH, (48, 32)),
        (NOISE, (256, 256)),
        ({"technique": "ramp", "input": DISH, "stops": STOPS}, (48, 32)),
        ({"technique": "mix", "a": SMALL_UPLOAD, "b": UPLOAD, "amount": NOISE}, (300, 200)),
        ({"technique": "mix", "a": SMALL_UPLOAD, "b": NOISE}, (8, 8)),
    ],
)
def test_the_own_size_is_that_of_the_largest_pixels_within(body, size):
    assert own_size(texture(body), measure) == size


def test_functions_of_functions_are_made_at_their_parents_size():
    body = {"technique": "mix", "a": UPLOAD, "b": DISH, "amount": NOISE}

    sizes = sizes_within(texture(body), (70, 50), measure)

    assert sizes == {"a": (70, 50), "b": (70, 50), "amount": (70, 50)}


def test_an_exemplar_keeps_its_pixels_and_guides_are_as_large_as_the_result():
    body = {
        "technique": "texture_optimization", "size": [64, 40],
        "exemplar": UPLOAD, "exemplar_mask": SMALL_UPLOAD, "exemplar_guide": NOISE, "guide": NOISE,
    }  # fmt: skip

    assert sizes_within(texture(body), (70, 50), measure) == {
        "exemplar": (300, 200),
        "exemplar_mask": (300, 200),
        "exemplar_guide": (300, 200),
        "guide": (64, 40),
    }
    smaller = texture({**body, "exemplar_size": [30, 20]})
    assert sizes_within(smaller, (70, 50), measure)["exemplar_mask"] == (30, 20)
