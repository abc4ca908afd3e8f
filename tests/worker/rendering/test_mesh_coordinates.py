"""Coordinates of vertices, against what shaders find for the fragments there."""

from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Coordinates, Layout
from tests.worker.rendering.studio import Studio
from worker.errors import RenderError
from worker.geometry.mesh import Mesh

pytestmark = pytest.mark.gl

SPEC: TypeAdapter[Any] = TypeAdapter(Coordinates)
LAYOUT: TypeAdapter[Any] = TypeAdapter(Layout)
LATLONG = {"technique": "latlong"}
KINDS = [
    ({"technique": "uv"}, None),
    ({"technique": "affine_uv", "set": 0}, None),
    ({"technique": "position", "matrix": [[0.5, 0.1, 0], [0, 0.3, 0.2], [0, 0, 1]]}, None),
    ({"technique": "position", "offset": [0.1, 0.2, 0.3]}, LATLONG),
    ({"technique": "normal", "frame": "object"}, LATLONG),
    ({"technique": "normal", "frame": "object"}, {"technique": "octahedral"}),
    ({"technique": "cylindrical", "axis": "x", "base": -1.0, "height": 3.0}, None),
    ({"technique": "cylindrical", "axis": "y"}, None),
    ({"technique": "cylindrical", "axis": "z", "base": 0.2, "height": 0.5}, None),
]


def quad(centre: np.ndarray, normal: np.ndarray) -> Mesh:
    """A small square that faces an eye on +z, all of whose vertices have one normal."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [1, 1, 0]]) * 1e-3
    return Mesh(
        positions=centre + corners,
        normals=np.tile(normal, (4, 1)),
        uv_sets=(np.tile([0.3, 0.6], (4, 1)),),
        triangles=np.array([[0, 1, 3], [0, 3, 2]], dtype=np.uint32),
    )


@pytest.mark.parametrize(("coordinates", "layout"), KINDS, ids=str)
def test_a_vertex_looks_where_a_fragment_there_looks(
    studio: Studio, coordinates: dict[str, Any], layout: dict[str, Any] | None
) -> None:
    from worker.rendering.mesh_coordinates import coordinates_of  # noqa: PLC0415

    centre, normal = np.array([0.4, 0.7, -0.5]), np.array([0.48, 0.6, 0.64])
    mesh = quad(centre, normal)
    ramps = studio.texture([[[0, 1, 0], [1, 1, 0]], [[0, 0, 0], [1, 0, 0]]])
    half = {"scale": [0.5, 0.5], "offset": [0.25, 0.25]}
    color = {
        "texture": ramps,
        "transform": half,
        "filter": "bilinear",
        "wrap": ["clamp", "clamp"],
        "coordinates": coordinates,
        "layout": layout,
    }
    surface = {"technique": "unlit", "color": color}
    pose = {"eye": [0.4, 0.7, 2.0], "target": [0.4, 0.7, 0.0]}
    camera = {"type": "orthographic", "height": 1e-3, "pose": pose}
    seen = studio.draw(
        {"camera": camera, "nodes": [{"mesh": studio.mesh(mesh), "surface": surface}]}, (3, 3)
    )[1, 1, :2]

    found = coordinates_of(
        SPEC.validate_python(coordinates),
        None if layout is None else LAYOUT.validate_python(layout),
        Mesh(centre[None], normal[None], (np.array([[0.3, 0.6]]),), mesh.triangles),
    )[0]

    if layout is not None and layout["technique"] != "latlong":
        # Directions have joins of their own, so that the ramps are read wrapped; these are inside.
        assert (found > 0.25).all() or (found < 0.75).all()
    np.testing.assert_allclose(np.clip(found[:2], 0, 1), np.clip(seen, 0, 1), atol=5e-3)


@pytest.mark.parametrize(
    "coordinates",
    [
        {"technique": "view"},
        {"technique": "reflection"},
        {"technique": "triplanar"},
        {"technique": "position", "frame": "world"},
        {"technique": "normal"},
    ],
    ids=str,
)
def test_what_depends_on_the_eye_or_the_scene_is_refused(coordinates: dict[str, Any]) -> None:
    from worker.rendering.mesh_coordinates import coordinates_of  # noqa: PLC0415

    mesh = quad(np.zeros(3), np.array([0.0, 0.0, 1.0]))

    with pytest.raises(RenderError) as caught:
        coordinates_of(SPEC.validate_python(coordinates), None, mesh)

    assert caught.value.code == "coordinates_unsuited"


def test_a_direction_that_is_none_lies_somewhere() -> None:
    from worker.rendering.mesh_coordinates import coordinates_of  # noqa: PLC0415

    spec = SPEC.validate_python({"technique": "position"})
    mesh = Mesh(np.zeros((1, 3)), np.zeros((1, 3)), (), np.zeros((0, 3), dtype=np.uint32))

    assert np.isfinite(coordinates_of(spec, LAYOUT.validate_python(LATLONG), mesh)).all()
