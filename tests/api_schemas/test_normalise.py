import pytest

from api_schemas.assets import ImageFacts
from api_schemas.normalise import normalise
from api_schemas.requests import RenderRequest

ASSET = "a" * 64


def facts(bits, floating):
    return {
        ASSET: ImageFacts(
            sha256=ASSET,
            kind="image",
            media_type="image/png",
            format="png",
            bytes=100,
            width=4,
            height=4,
            channels=3,
            bits=bits,
            float=floating,
            has_alpha=False,
        )
    }


def request(encoding="auto"):
    picture = {"texture": {"technique": "image", "asset": ASSET, "encoding": encoding}}
    surface = {"technique": "phong", "diffuse_color": picture, "exponent": picture}
    return RenderRequest.model_validate(
        {
            "scene": {
                "camera": {"type": "orthographic", "pose": {"eye": [0, 0, 3]}},
                "nodes": [{"mesh": {"type": "plane"}, "surface": surface}],
            }
        }
    )


@pytest.mark.parametrize(
    ("bits", "floating", "in_a_colour"),
    [(8, False, "srgb"), (16, False, "srgb"), (16, True, "linear"), (32, True, "linear")],
)
def test_auto_is_srgb_for_integer_pictures_in_a_colour_slot_only(bits, floating, in_a_colour):
    surface = normalise(request(), "png", facts(bits, floating)).scene.nodes[0].surface

    assert surface.diffuse_color.texture.encoding == in_a_colour
    assert surface.exponent.texture.encoding == "linear"


def test_what_the_user_said_stays():
    surface = normalise(request("srgb"), "png", facts(8, False)).scene.nodes[0].surface

    assert surface.exponent.texture.encoding == "srgb"


def test_the_format_is_settled_and_the_given_request_untouched():
    given = request()

    assert normalise(given, "exr", facts(8, False)).output.format == "exr"
    assert given.output.format is None
    assert given == request()
