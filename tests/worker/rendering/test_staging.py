"""Whose camera and whose lights count."""

import itertools
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.camera import Camera, OrthographicCamera, PerspectiveCamera
from api_schemas.lights import AmbientLight, DirectionalLight, Light, PointLight, SpotLight
from api_schemas.transforms import MatrixPlacement
from worker.errors import RenderError
from worker.models.model import Model, NamedCamera

pytestmark = pytest.mark.gl

IDENTITY = np.eye(4)
LIGHT: TypeAdapter[Light] = TypeAdapter(Light)
CAMERA: TypeAdapter[Camera] = TypeAdapter(Camera)
CUBE = [(np.array(list(itertools.product((-1.0, 1.0), repeat=3))), np.eye(4))]


def matrix(rows: Any) -> MatrixPlacement:
    return MatrixPlacement(matrix=np.array(rows, dtype=float).T.ravel().tolist())


def moved(x: float, y: float, z: float) -> np.ndarray:
    result = np.eye(4)
    result[:3, 3] = x, y, z
    return result


def model(cameras: Any = (), lights: Any = ()) -> Model:
    return Model((), (), (), tuple(cameras), tuple(lights), {}, ())


PERSPECTIVE = NamedCamera(
    "front", PerspectiveCamera(type="perspective", pose=matrix(moved(0, 0, 5)), fov_y=1.0)
)
ORTHOGRAPHIC = NamedCamera(
    "plan",
    OrthographicCamera(type="orthographic", pose=matrix(moved(0, 0, 3)), height=2, near=1, far=9),
)


def view(camera: Any, models: Any) -> Any:
    from worker.rendering.staging import view_of  # noqa: PLC0415  needs OpenGL

    camera = None if camera is None else CAMERA.validate_python(camera)
    return view_of(camera, models, CUBE, 1.0)


def placed(of: Model, where: np.ndarray) -> Any:
    from worker.rendering.staging import PlacedModel  # noqa: PLC0415  needs OpenGL

    return PlacedModel(of, where)


def test_without_a_camera_the_first_of_the_models_looks() -> None:
    models = [placed(model(), IDENTITY), placed(model([ORTHOGRAPHIC, PERSPECTIVE]), IDENTITY)]

    found = view(None, models)

    assert found.orthographic
    assert found.world_from_camera[:3, 3] == pytest.approx([0, 0, 3])


def test_without_any_camera_all_is_framed() -> None:
    found = view(None, [placed(model(), IDENTITY)])

    assert not found.orthographic
    assert found.world_from_camera[:3, 2] == pytest.approx(
        np.array([0.5, 0.4, 1]) / np.sqrt(1.41), abs=1e-6
    )


@pytest.mark.parametrize("name", ["front", 1])
def test_a_camera_of_a_model_is_named_and_moves_with_the_model(name: str | int) -> None:
    models = [placed(model([ORTHOGRAPHIC, PERSPECTIVE]), moved(1, 2, 3))]

    found = view({"type": "model", "camera": name}, models)

    assert not found.orthographic
    assert found.world_from_camera[:3, 3] == pytest.approx([1, 2, 8])


def test_the_camera_of_a_scaled_model_sees_the_same_part_of_it() -> None:
    plain = view(None, [placed(model([ORTHOGRAPHIC]), IDENTITY)])
    large = view(None, [placed(model([ORTHOGRAPHIC]), np.diag([10.0, 10, 10, 1]))])
    corner = np.array([0.5, 0.25, 1.0, 1.0])
    big_corner = np.array([5.0, 2.5, 10.0, 1.0])

    expected = plain.clip_from_camera @ np.linalg.inv(plain.world_from_camera) @ corner
    found = large.clip_from_camera @ np.linalg.inv(large.world_from_camera) @ big_corner

    assert found == pytest.approx(expected)
    assert np.linalg.norm(large.world_from_camera[:3, :3], axis=0) == pytest.approx(np.ones(3))


def test_a_camera_that_no_model_has_is_told() -> None:
    with pytest.raises(RenderError) as error:
        view({"type": "model", "camera": "back"}, [placed(model([PERSPECTIVE]), IDENTITY)])

    assert (error.value.code, error.value.pointer) == ("model_part_unknown", "/scene/camera")


def staged(given: Any, models: Any) -> tuple[list[Light], list[str]]:
    from worker.rendering.staging import lights_of  # noqa: PLC0415  needs OpenGL

    found, warnings = lights_of(given, models, IDENTITY, surrounded=False)
    return list(found), list(warnings)


def lights(given: Any, models: Any) -> list[Light]:
    found, warnings = staged(given, models)
    assert not warnings
    return found


def test_lights_of_the_request_replace_those_of_models_and_none_at_all_is_dark() -> None:
    models = [placed(model(lights=[PointLight(type="point", position=[0, 0, 0])]), IDENTITY)]
    own = [AmbientLight(type="ambient")]

    assert lights(own, models) == own
    assert lights([], models) == []


def test_lights_of_a_model_turn_and_move_with_it() -> None:
    quarter = np.array([[0.0, 0, 1, 7], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])  # x to -z
    brought = [
        PointLight(type="point", position=[1, 0, 0], intensity=3),
        DirectionalLight(type="directional", direction=[1, 0, 0]),
        SpotLight(type="spot", position=[0, 1, 0], direction=[0, 0, 1]),
    ]

    point, sun, spot = lights(None, [placed(model(lights=brought), quarter)])

    assert isinstance(point, PointLight)
    assert isinstance(sun, DirectionalLight)
    assert isinstance(spot, SpotLight)
    assert point.position == pytest.approx([7, 0, -1])
    assert point.intensity == 3
    assert sun.direction == pytest.approx([0, 0, -1])
    assert spot.position == pytest.approx([7, 1, 0])
    assert spot.direction == pytest.approx([1, 0, 0])


def test_many_models_bring_no_more_lights_than_a_request_and_that_is_told() -> None:
    """A shader has room for 32, as a request has."""
    lamps = [PointLight(type="point", position=[float(x), 0, 0]) for x in range(4)]
    models = [placed(model(lights=lamps), moved(10.0 * index, 0, 0)) for index in range(9)]

    found, warnings = staged(None, models)

    assert len(lights(None, models[:8])) == 32
    assert found == lights(None, models[:8])
    assert warnings == ["only the first 32 lights shine"]


def test_where_nothing_shines_a_lamp_stands_behind_the_eye() -> None:
    found = lights(None, [placed(model(), IDENTITY)])

    lamps = [light for light in found if isinstance(light, DirectionalLight)]
    assert lamps
    assert all(light.direction[2] < 0 for light in lamps)  # away from an eye that looks along -z
