"""Cameras and lights where their nodes stand."""

import math
from typing import Any

import pytest

from api_schemas.lights import LIGHTS_MAX
from tests.worker.models.gltf.building import Builder
from worker.errors import UnusableAssetError
from worker.models.gltf.reader import read
from worker.models.model import Model

HALF = math.sqrt(0.5)
BOX = {"xmag": 2, "ymag": 3, "znear": 0, "zfar": 10}


def seen(camera: dict[str, Any], **node: Any) -> Model:
    return read(Builder(cameras=[camera], nodes=[{"camera": 0, **node}]).gltf(), {})


def test_a_perspective_camera_looks_from_its_node_to_the_horizon() -> None:
    view = {"yfov": 0.7, "znear": 0.1, "aspectRatio": 2}
    camera = {"type": "perspective", "perspective": view}
    (named,) = seen(camera, name="eye", translation=[1, 2, 3]).cameras

    assert named.name == "eye"
    assert named.camera.model_dump() == {
        "type": "perspective",
        "fov_y": 0.7,
        "near": 0.1,
        "far": 1e6,
        "pose": {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1]},
    }


def test_an_orthographic_camera_is_twice_its_ymag_high() -> None:
    camera = {"type": "orthographic", "orthographic": BOX, "name": "plan"}
    (named,) = seen(camera).cameras
    spec: Any = named.camera

    assert named.name == "plan"
    assert (spec.type, spec.height, spec.far) == ("orthographic", 6, 10)
    assert 0 < spec.near <= 1e-6


@pytest.mark.parametrize(
    "camera",
    [
        {"type": "perspective", "perspective": {"yfov": 3.15, "znear": 1}},
        {"type": "perspective", "perspective": {"yfov": 1e-9, "znear": 1}},
        {"type": "orthographic", "orthographic": {**BOX, "ymag": -1}},
        {"type": "orthographic", "orthographic": {**BOX, "ymag": 1e9}},
        {"type": "fisheye"},
    ],
)
def test_a_camera_that_cannot_be_drawn_is_left_out_and_told(camera: dict[str, Any]) -> None:
    model = seen(camera)

    assert model.cameras == ()
    assert "camera" in model.warnings[0]


@pytest.mark.parametrize(
    "camera",
    [
        {"type": "perspective"},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 0}},
        {"type": "orthographic", "orthographic": {**BOX, "ymag": 0}},
        {"type": "orthographic", "orthographic": {**BOX, "zfar": 0}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}, "orthographic": BOX},
    ],
)
def test_a_camera_that_gltf_forbids_is_refused(camera: dict[str, Any]) -> None:
    with pytest.raises(UnusableAssetError, match=r"^/cameras/0"):
        seen(camera)


def lit(lights: list[dict[str, Any]], **node: Any) -> Model:
    name = "KHR_lights_punctual"
    nodes = [{"extensions": {name: {"light": n}}, **node} for n in range(len(lights))]
    builder = Builder(extensions={name: {"lights": lights}}, extensionsUsed=[name], nodes=nodes)
    return read(builder.gltf(), {})


def test_lights_shine_along_their_own_minus_z_whatever_their_scale() -> None:
    placed = {"rotation": [HALF, 0, 0, HALF], "scale": [3, 3, 3], "translation": [1, 2, 3]}
    sun = {"type": "directional", "color": [1, 0.5, 0], "intensity": 3}
    bulb = {"type": "point", "intensity": 5}
    lamp = {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}
    (a, b, c), model = lit([sun, bulb, lamp], **placed).lights, lit([sun, bulb, lamp], **placed)

    up: Any = [0, 1, 0]  # -z turned by 90 degrees about x
    assert model.warnings == ()
    assert a.type == "directional"
    assert a.direction == pytest.approx(up, abs=1e-12)
    assert (a.color, a.irradiance) == ([1, 0.5, 0], 3)
    assert b.type == "point"
    assert (b.position, b.color, b.intensity) == ([1, 2, 3], [1, 1, 1], 5)
    assert c.type == "spot"
    assert c.direction == pytest.approx(up, abs=1e-12)
    assert (c.position, c.intensity, c.inner_angle, c.outer_angle) == ([1, 2, 3], 1, 0.1, 0.2)


def test_a_spot_without_angles_fades_to_an_eighth_of_a_turn() -> None:
    (spot,) = lit([{"type": "spot", "spot": {}}]).lights

    assert spot.type == "spot"
    assert (spot.inner_angle, spot.outer_angle) == (0, math.pi / 4)


def test_too_many_lights_a_range_and_unknown_types_are_told() -> None:
    model = lit([{"type": "point", "range": 3}] * (LIGHTS_MAX + 1) + [{"type": "laser"}])

    assert len(model.lights) == LIGHTS_MAX
    assert len(model.warnings) == 3


@pytest.mark.parametrize(
    "light",
    [
        {"type": "spot"},
        {"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}},
        {"type": "spot", "spot": {"outerConeAngle": 2}},
        {"type": "point", "intensity": -1},
        {"type": "point", "range": 0},
        {"type": "point", "color": [1, 1]},
        {},
    ],
)
def test_a_light_that_the_extension_forbids_is_refused(light: dict[str, Any]) -> None:
    with pytest.raises(UnusableAssetError, match=r"^/extensions/KHR_lights_punctual/lights/0"):
        lit([light])
