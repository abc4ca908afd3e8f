"""Colour, normals, relief, displacement and surroundings on one thing (T05)."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

BALL = {"type": "sphere", "segments": 64, "rings": 32}
SURFACE = {"technique": "metallic_roughness", "metallic": 0.0, "roughness": 0.4}


def grey(value: float, channels: int = 3) -> dict[str, Any]:
    return {"technique": "constant", "value": [value] * channels}


def scene(surface: dict[str, Any], **node: Any) -> dict[str, Any]:
    return {
        "camera": {"type": "perspective", "pose": {"eye": [0.5, 1.0, 3.5]}},
        "environment": {"texture": grey(0.5)},
        "lights": [{"type": "directional", "direction": [-1.0, -1.0, -1.0]}],
        "nodes": [{"mesh": BALL, "surface": {**SURFACE, **surface}, **node}],
    }


def test_t05_neutral_maps_give_the_plain_picture(studio: Studio) -> None:
    neutral = {
        "base_color": {"texture": grey(1.0)},
        "roughness": {"texture": grey(1.0), "scale": 0.4},
        "normal": {"texture": {"technique": "constant", "value": [0.5, 0.5, 1.0]}},
        "bump": {"texture": grey(0.0), "encoding": "float"},
        "height": {"texture": grey(0.7)},
        "parallax": {"texture": grey(1.0)},
    }
    still = {"texture": {"technique": "perlin"}, "depth": 0.0, "subdivisions": 0}

    plain = studio.draw(scene({}), (48, 48))

    mapped = studio.draw(scene(neutral, displacement=still), (48, 48))
    np.testing.assert_allclose(mapped, plain, rtol=2e-5, atol=2e-6)


@pytest.mark.parametrize("name", ["base_color", "normal", "height", "parallax", "displacement"])
def test_t05_each_of_them_changes_the_picture_by_itself(studio: Studio, name: str) -> None:
    noise = {"texture": {"technique": "perlin", "frequency": 8, "seed": 1}}
    normals = {"texture": {"technique": "normal_from_height", "height": noise["texture"]}}
    lines = {"base_color": {"texture": {"technique": "checkerboard"}}}
    maps: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
        "base_color": (lines, {}),
        "normal": ({"normal": normals}, {}),
        "height": ({"height": {**noise, "depth": 0.2}}, {}),
        "parallax": ({**lines, "parallax": {**noise, "depth": 0.2}}, {}),
        "displacement": ({}, {"displacement": {**noise, "depth": 0.2, "subdivisions": 0}}),
    }
    surface, node = maps[name]
    before = lines if name == "parallax" else {}

    changed = np.abs(
        studio.draw(scene(surface, **node), (48, 48)) - studio.draw(scene(before), (48, 48))
    )

    assert (changed.max(axis=2) > 0.01).mean() > 0.05
