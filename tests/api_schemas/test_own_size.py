"""At which size the textures within a texture are made."""

import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from api_schemas.own_size import own_size, size_within

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

    for name in ("a", "b", "amount"):
        assert size_within(texture(body), name, (70, 50), measure) == (70, 50)


def test_an_exemplar_keeps_its_pixels_and_guides_are_as_large_as_the_result():
    body = {
        "technique": "texture_optimization", "size": [64, 40],
        "exemplar": UPLOAD, "exemplar_mask": SMALL_UPLOAD, "exemplar_guide": NOISE, "guide": NOISE,
    }  # fmt: skip

    grown, smaller = texture(body), texture({**body, "exemplar_size": [30, 20]})

    for name in ("exemplar", "exemplar_mask", "exemplar_guide"):
        assert size_within(grown, name, (70, 50), measure) == (300, 200)
        assert size_within(smaller, name, (70, 50), measure) == (30, 20)
    assert size_within(grown, "guide", (70, 50), measure) == (64, 40)


@pytest.mark.parametrize(
    ("arrangement", "size"), [("column", (256, 1536)), ("row", (1536, 256)), ("cross", (1024, 768))]
)
def test_functions_on_the_faces_of_a_cube_have_whole_rows_and_columns(arrangement, size):
    sky = texture(
        {
            "technique": "convert_layout",
            "environment": {"technique": "gradient"},
            "layout": {"technique": "cube", "arrangement": arrangement},
        }
    )

    assert size_within(sky, "environment", (64, 32), measure) == size
