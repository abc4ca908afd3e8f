import copy
import json
from pathlib import Path

import jsonschema_rs
import pytest
from hypothesis import given
from pydantic import TypeAdapter, ValidationError

import api_schemas
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from api_schemas.requests import RenderRequest, TextureRequest
from api_schemas.surface_spec import Surface
from tests.spec_strategies import render_requests, surfaces, texture_requests, textures

TEXTURE = TypeAdapter(Texture)
SURFACE = TypeAdapter(Surface)
RED = [{"position": 0, "color": [1, 0, 0]}]


@pytest.mark.parametrize("family", FAMILIES)
def test_every_module_of_a_folder_is_a_technique(family):
    folder = Path(api_schemas.__file__).parent / family
    modules = {path.stem for path in folder.glob("*.py")} - {"__init__"}

    assert modules == set(FAMILIES[family])


@pytest.mark.parametrize("family", FAMILIES)
def test_every_technique_tells_its_source_and_describes_every_parameter(family):
    for name, spec in FAMILIES[family].items():
        undescribed = [
            field
            for field, info in spec.model_fields.items()
            if field != "technique" and not info.description
        ]

        assert spec.__doc__, name
        assert spec.source, name
        assert spec.equation, name
        assert undescribed == [], name


def test_a_texture_nests_in_a_texture_in_a_surface():
    ramp = {"technique": "ramp", "input": {"technique": "perlin"}, "stops": RED}
    twice = {"technique": "ramp", "input": ramp, "stops": RED}

    spec = SURFACE.validate_python({"technique": "phong", "diffuse_color": {"texture": twice}})

    assert spec.diffuse_color.texture.input.input.technique == "perlin"


@pytest.mark.parametrize(
    "body",
    [
        {"technique": "phong", "exponent": -1},
        {"technique": "phong", "exponent": "32"},
        {"technique": "phong", "exponent": True},
        {"technique": "phong", "exponent": {"texture": {"technique": "perlin", "octaves": 1.5}}},
        {"technique": "phong", "exponent": {"texture": {"technique": "perlin", "octaves": True}}},
        {"technique": "phong", "exponent": {"texture": {"technique": "no_such"}}},
        {"technique": "phong", "exponent": {"texture": {"octaves": 1}}},
        {"technique": "unlit", "color": [1, 2]},
        {"technique": "unlit", "color": [1, 2, 1e39]},
        {"technique": "unlit", "color": None},
        {"technique": "unlit", "shine": 1},
        {"technique": "no_such"},
        {"color": [1, 1, 1]},
        [],
        None,
    ],
)
def test_one_mistake_is_one_problem_for_pydantic_and_for_the_published_schema(body):
    with pytest.raises(ValidationError) as refusal:
        SURFACE.validate_python(body)

    assert refusal.value.error_count() == 1
    assert not jsonschema_rs.validator_for(SURFACE.json_schema()).is_valid(body)


def test_a_whole_float_is_an_integer():
    spec = TEXTURE.validate_python({"technique": "perlin", "octaves": 3.0})

    assert (spec.octaves, type(spec.octaves)) == (3, int)


@given(textures(number_limit=3.4e38))
def test_every_texture_of_the_published_schema_is_accepted(body):
    assert TEXTURE.validate_python(copy.deepcopy(body)).technique == body["technique"]


@given(surfaces(number_limit=3.4e38))
def test_every_surface_of_the_published_schema_is_accepted(body):
    assert SURFACE.validate_python(copy.deepcopy(body)).technique == body["technique"]


@given(texture_requests() | render_requests())
def test_a_request_survives_its_own_json(body):
    model = TextureRequest if "texture" in body else RenderRequest
    request = model.model_validate(body)

    assert model.model_validate(json.loads(request.model_dump_json())) == request


@given(render_requests())
def test_generated_requests_fit_the_published_schema(body):
    validator = jsonschema_rs.validator_for(RenderRequest.model_json_schema())

    assert validator.is_valid(body)


@pytest.mark.parametrize("family", FAMILIES)
def test_every_field_knows_its_type_and_with_it_what_its_slot_means(family):
    for spec in FAMILIES[family].values():
        for name, field in spec.model_fields.items():
            assert "ForwardRef" not in repr(field.annotation), (spec, name)
