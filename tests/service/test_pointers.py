"""Every problem points at a value of the input, or at a key that is missing from it."""

import json
from functools import partial

import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.requests import RenderRequest, TextureRequest
from service.json_body import fitted
from service.pointers import LONGEST_KEY, MOST_TOLD, json_pointer
from service.problems import ProblemError
from tests.examples import examples

CAMERA = {"type": "perspective", "pose": {"eye": [0, 0, 3]}}


def problems(model, body):
    with pytest.raises(ProblemError) as refused:
        fitted(model, body)
    assert refused.value.problem.code == "request_invalid"
    return {item.pointer: item.code for item in refused.value.problem.problems}


def texture(spec):
    return problems(TextureRequest, {"texture": spec})


def surface(spec):
    node = {"mesh": {"type": "plane"}, "surface": {"technique": "phong", **spec}}
    return problems(RenderRequest, {"scene": {"camera": CAMERA, "nodes": [node]}})


def resolve(pointer, body):
    """Walk a pointer; the last key may be missing from an object that is there."""
    keys = [key.replace("~1", "/").replace("~0", "~") for key in pointer.split("/")[1:]]
    for position, key in enumerate(keys):
        if isinstance(body, list):
            body = body[int(key)]
        elif isinstance(body, dict) and key in body:
            body = body[key]
        else:
            assert isinstance(body, dict), (pointer, body)
            assert position == len(keys) - 1, (pointer, body)
            return


def test_names_of_union_members_are_not_keys():
    assert texture({"technique": "constant", "value": "x"}) == {"/texture/value": "wrong_type"}
    assert surface({"exponent": -1, "emission": "x", "diffuse_color": {"bias": "x"}}) == {
        "/scene/nodes/0/surface/exponent": "out_of_range",
        "/scene/nodes/0/surface/emission": "wrong_type",
        "/scene/nodes/0/surface/diffuse_color/bias": "wrong_type",
        "/scene/nodes/0/surface/diffuse_color/texture": "missing",
    }


def test_a_list_of_different_things_refuses_repetitions_and_what_is_unknown():
    scene = {"scene": {"camera": CAMERA, "nodes": []}}

    def layers(*names):
        return problems(RenderRequest, {**scene, "output": {"layers": list(names)}})

    assert layers("depth", "uv", "depth") == {"/output/layers": "repeated"}
    assert layers("depth", "z") == {"/output/layers/1": "not_a_choice"}


def test_a_key_called_like_a_union_member_is_still_a_key():
    assert texture({"technique": "constant", "value": "x", "constant": {"value": 1}}) == {
        "/texture/value": "wrong_type",
        "/texture/constant": "unknown_key",
    }
    assert texture({"technique": "constant", "value": {"number": 1}}) == {
        "/texture/value": "wrong_type"
    }
    assert surface({"exponent": {"value": 1, "map": 2, "texture": 3}}) == {
        "/scene/nodes/0/surface/exponent/texture": "wrong_type",
        "/scene/nodes/0/surface/exponent/value": "unknown_key",
        "/scene/nodes/0/surface/exponent/map": "unknown_key",
    }


def test_a_mistake_in_a_texture_within_a_texture_is_told_once():
    spec = {"technique": "perlin", "frequency": "x"}
    for _ in range(3):
        spec = {"technique": "ramp", "input": spec, "stops": [{"position": 0, "color": [1, 1, 1]}]}

    assert texture(spec) == {"/texture/input/input/input/frequency": "wrong_type"}


def test_an_unknown_or_missing_technique_is_told_at_its_key():
    assert texture({"technique": "no_such"}) == {"/texture/technique": "not_a_choice"}
    assert texture({"technique": 3}) == {"/texture/technique": "not_a_choice"}
    assert texture({}) == {"/texture/technique": "missing"}
    assert texture([]) == {"/texture": "wrong_type"}


def test_keys_are_escaped():
    assert json_pointer(["a/b", "~", 0, ""]) == "/a~1b/~0/0/"


def test_a_key_too_long_to_repeat_is_told_at_the_object_that_holds_it():
    long = "k" * (LONGEST_KEY + 1)

    assert texture({"technique": "perlin", long: 1}) == {"/texture": "unknown_key"}


def test_a_thousand_mistakes_are_not_all_told():
    body = {"texture": {"technique": "perlin"}} | {f"extra{n}": n for n in range(1000)}

    assert len(problems(TextureRequest, body)) == MOST_TOLD


def places(value, path=()):
    """Every place in a JSON value."""
    yield path
    if isinstance(value, dict):
        for key, item in value.items():
            yield from places(item, (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from places(item, (*path, index))


def replaced(value, path, change):
    if not path:
        return change(value)
    key, *rest = path
    copy = value.copy()
    copy[key] = replaced(value[key], rest, change)
    return copy


JUNK = st.sampled_from(
    [None, True, -1, 1e30, 0.5, "", "x", [], [1], {}, {"technique": "x"}, {"value": 1}, [[]]]
)
KEYS = st.sampled_from(["value", "map", "phong", "technique", "with matrix", "matrix", "x/y", "~"])


def spoilt(key, junk, old):
    return {**old, key: junk} if isinstance(old, dict) else junk


def problems_if_any(model, body):
    try:
        fitted(model, body)
    except ProblemError as error:
        return [item.pointer for item in error.problem.problems]
    return None


@given(data=st.data())
def test_every_pointer_resolves_whatever_is_broken(data):
    kind, body = data.draw(st.sampled_from(list(examples().values())))
    model = {"texture": TextureRequest, "render": RenderRequest}[kind]
    for _ in range(data.draw(st.integers(1, 3))):
        path = data.draw(st.sampled_from(list(places(body))))
        body = replaced(body, path, partial(spoilt, data.draw(KEYS), data.draw(JUNK)))
    pointers = problems_if_any(model, json.loads(json.dumps(body)))

    assert pointers is None or len(pointers) > 0
    for pointer in pointers or []:
        resolve(pointer, body)
