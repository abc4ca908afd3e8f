"""The chunks of layouts against numpy, there and back, and their footprints against differences."""

import math

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.language import FAMILIES
from api_schemas.members import Layout
from worker import layouts

pytestmark = pytest.mark.gl

LAYOUT = TypeAdapter(Layout)
VARIANTS = [
    *({"technique": "latlong", "centre": centre} for centre in ("+z", "+x", "-z", "-x")),
    {"technique": "angular_probe"},
    {"technique": "angular_probe", "centre": "+z"},
    {"technique": "mirror_ball"},
    *(
        {"technique": "fisheye", "angle": 2 * math.pi, "towards": f"{sign}{axis}"}
        for sign in "+-"
        for axis in "xyz"
    ),
    {"technique": "fisheye", "model": "equisolid", "angle": 4.0},
    {"technique": "fisheye", "model": "stereographic", "angle": 6.0},
    {"technique": "fisheye", "model": "orthographic"},
    {"technique": "hemispheres"},
    {"technique": "hemispheres", "second": "photograph"},
    {"technique": "dual_paraboloid"},
    {"technique": "dual_paraboloid", "second": "photograph"},
    {"technique": "octahedral"},
]


def directions_and_changes(count=1500):
    random = np.random.default_rng(3)
    directions = random.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    directions = np.float32(directions).astype(np.float64)
    changes = random.normal(size=(count, 3)) * 1e-3
    return directions, changes - directions * (directions * changes).sum(axis=1, keepdims=True)


def test_every_layout_that_is_a_picture_is_here():
    # A cube is a cube map, and tested as one
    assert {body["technique"] for body in VARIANTS} == set(FAMILIES["layouts"]) - {"cube"}


@pytest.mark.parametrize("body", VARIANTS)
def test_show_5_shaders_and_numpy_agree_there_and_back(body):
    # Imported here: it needs OpenGL.
    from tests.worker.rendering.layout_drawing import drawn  # noqa: PLC0415

    spec = LAYOUT.validate_python(body)
    directions, changes = directions_and_changes()
    _, held = layouts.direction(spec, layouts.place(spec, directions))

    uv = drawn(spec, directions, changes)[:, :2]
    back, _ = layouts.direction(spec, uv)

    off = uv - layouts.place(spec, directions)
    if spec.technique == "latlong":
        off[:, 0] -= np.rint(off[:, 0])
    assert held.mean() > 0.4
    assert np.abs(off).max() < 1e-5
    # A disc that is flat at its rim tells angles there less exactly than places
    steep = np.abs(directions[:, 1]) < 0.1 if spec.technique == "hemispheres" else ~held
    if body.get("model") == "orthographic":
        steep |= np.abs(directions[:, 2]) < 0.1
    assert np.abs(back - directions)[~steep].max() < 1e-5


@pytest.mark.parametrize("body", VARIANTS)
def test_footprints_are_derivatives(body):
    from tests.worker.rendering.layout_drawing import drawn  # noqa: PLC0415

    spec = LAYOUT.validate_python(body)
    directions, changes = directions_and_changes()

    across = drawn(spec, directions, changes)[:, 2:]

    ahead, behind = (
        layouts.place(spec, directions + sign * 1e-3 * changes) for sign in (0.5, -0.5)
    )
    differences = (ahead - behind) * 1e3
    near = np.abs(differences).max(axis=1) < 0.02  # elsewhere a seam lies between
    # Near poles and rims, where a direction is a line, footprints are held back on purpose
    _, held = layouts.direction(spec, layouts.place(spec, directions))
    tame = near & held & (np.abs(directions).max(axis=1) < 0.98)
    assert tame.mean() > 0.4
    scale = np.maximum(np.abs(differences[tame]).max(axis=1, keepdims=True), 1e-4)
    assert np.abs((across[tame] - differences[tame]) / scale).max() < 2e-3
