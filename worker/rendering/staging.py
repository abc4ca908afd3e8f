"""Who looks and what shines: as the request says, else as its models do, else as in a studio."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from api_schemas.camera import (
    FramedCamera,
    ModelCamera,
    OrthographicCamera,
    PerspectiveCamera,
)
from api_schemas.lights import (
    LIGHTS_MAX,
    AmbientLight,
    DirectionalLight,
    Light,
    PointLight,
    SpotLight,
)
from worker.errors import RenderError
from worker.geometry.transforms import Matrix, clip_from_camera, orthonormal, world_from_camera
from worker.models.model import Model, NamedCamera
from worker.rendering.framing import Placed, frame, lamp
from worker.rendering.pyrender_scene import View

Camera = PerspectiveCamera | OrthographicCamera | FramedCamera | ModelCamera


@dataclass(frozen=True, slots=True)
class PlacedModel:
    """A model and where it stands."""

    model: Model
    world_from_model: Matrix


def view_of(
    camera: Camera | None,
    models: Sequence[PlacedModel],
    placed: Iterable[Placed],
    aspect: float,
    *,
    endless: bool = False,
) -> View:
    """Return the eye.

    Args:
        camera: The request's.
        models: Where a model's camera is sought.
        placed: Vertices of all that is drawn, for a camera that frames them.
        aspect: Width over height of the picture.
        endless: Whether there are planes without end, too.

    Raises:
        RenderError: It is degenerate (`camera_degenerate`), or no model has it
            (`model_part_unknown`).
    """
    if camera is None:
        brought = any(item.model.cameras for item in models)
        camera = ModelCamera(type="model") if brought else FramedCamera(type="framed")
    if isinstance(camera, ModelCamera):
        return _view_of_model(camera, models, aspect)
    if isinstance(camera, FramedCamera):
        framing = frame(camera, placed, aspect, endless=endless)
        return View(framing.world_from_camera, framing.clip_from_camera, orthographic=False)
    return View(
        world_from_camera=world_from_camera(camera.pose),
        clip_from_camera=clip_from_camera(camera, aspect),
        orthographic=isinstance(camera, OrthographicCamera),
    )


def lights_of(
    lights: Sequence[Light] | None,
    models: Sequence[PlacedModel],
    world_from_camera: Matrix,
    *,
    surrounded: bool,
) -> tuple[Sequence[Light], Sequence[str]]:
    """Return what shines, in world axes, and what there is to warn of.

    Scenes `surrounded` by an environment need no studio. One model brings no more lights than a
    shader has room for; many together may.
    """
    if lights is not None:
        return lights, ()
    brought = [
        _in_world(light, item.world_from_model) for item in models for light in item.model.lights
    ]
    if len(brought) > LIGHTS_MAX:
        return brought[:LIGHTS_MAX], (f"only the first {LIGHTS_MAX} lights shine",)
    if surrounded:
        return brought, ()
    return brought or lamp(world_from_camera), ()


def _view_of_model(camera: ModelCamera, models: Sequence[PlacedModel], aspect: float) -> View:
    for item in models:
        for index, named in enumerate(item.model.cameras):
            if camera.camera in (None, index) or camera.camera == named.name:
                return _placed_view(named, item.world_from_model, aspect)
    message = "no model of the scene brings this camera"
    raise RenderError(message, "/scene/camera", code="model_part_unknown")


def _placed_view(named: NamedCamera, world_from_model: Matrix, aspect: float) -> View:
    camera = named.camera
    stretch = float(np.cbrt(abs(np.linalg.det(world_from_model[:3, :3]))))
    lengths = ["near", "far"] + ["height"] * isinstance(camera, OrthographicCamera)
    scaled = camera.model_copy(update={name: getattr(camera, name) * stretch for name in lengths})
    return View(
        world_from_camera=orthonormal(world_from_model @ world_from_camera(camera.pose)),
        clip_from_camera=clip_from_camera(scaled, aspect),
        orthographic=isinstance(camera, OrthographicCamera),
    )


def _in_world(light: Light, world_from_model: Matrix) -> Light:
    if isinstance(light, AmbientLight):
        return light
    changed = {}
    if isinstance(light, PointLight | SpotLight):
        place = world_from_model @ np.append(light.position, 1.0)
        changed["position"] = place[:3].tolist()
    if isinstance(light, DirectionalLight | SpotLight):
        changed["direction"] = (world_from_model[:3, :3] @ light.direction).tolist()
    return light.model_copy(update=changed)
