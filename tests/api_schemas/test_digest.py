import random

from hypothesis import given
from hypothesis import strategies as st

from api_schemas.digest import digest
from api_schemas.requests import RenderRequest, TextureRequest
from api_schemas.textures.perlin import PerlinSpec
from tests.spec_strategies import render_requests, texture_requests


def request(**texture):
    return TextureRequest.model_validate({"texture": {"technique": "perlin", **texture}})


def shuffled(value, order):
    if isinstance(value, dict):
        keys = list(value)
        order.shuffle(keys)
        return {key: shuffled(value[key], order) for key in keys}
    return [shuffled(item, order) for item in value] if isinstance(value, list) else value


@given(texture_requests() | render_requests(), st.integers(0, 2**32))
def test_key_order_does_not_matter(body, seed):
    model = TextureRequest if "texture" in body else RenderRequest
    again = shuffled(body, random.Random(seed))

    assert digest(model.model_validate(again)) == digest(model.model_validate(body))


def test_a_default_written_out_is_the_same_work():
    assert digest(request(octaves=1, gain=0.5)) == digest(request())


def test_negative_zero_is_zero():
    assert digest(request(gain=-0.0)) == digest(request(gain=0.0))


def test_priority_changes_no_pixel_and_no_digest():
    urgent = request()

    assert digest(urgent.model_copy(update={"priority": "batch"})) == digest(urgent)


def test_a_parameter_changes_the_digest():
    assert digest(request(seed=1)) != digest(request(seed=2))


def test_a_new_revision_of_a_nested_technique_changes_the_digest(monkeypatch):
    body = {
        "texture": {
            "technique": "ramp",
            "input": {"technique": "perlin"},
            "stops": [{"position": 0, "color": [0, 0, 0]}],
        }
    }
    before = digest(TextureRequest.model_validate(body))

    monkeypatch.setattr(PerlinSpec, "revision", PerlinSpec.revision + 1)

    assert digest(TextureRequest.model_validate(body)) != before
