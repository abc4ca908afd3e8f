"""Pictures before lights: their textures, and the projections that find a place on them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.cookies import Gobo, Lantern, Slide
from api_schemas.layouts.cube import CubeSpec
from api_schemas.lights import AmbientLight, DirectionalLight, Light, PointLight, SpotLight
from api_schemas.transforms import Placement
from worker.geometry.transforms import Matrix, parent_from_node
from worker.images.stored_form import StoredForm
from worker.rendering.calls import call_of
from worker.rendering.light_views import light_axes
from worker.rendering.lookups import Picture, TextureSource, texture_from_uv
from worker.rendering.samplers import Sampling
from worker.rendering.shading_layout import CookieLayout, PictureLayout


@dataclass(frozen=True, slots=True)
class Cookies:
    """What is before the lights of a scene.

    Attributes:
        pictures: Each once.
        layouts: What the compiler must know of them.
        values: What those ask for that lie round a light, by name.
        numbers: For each light that is not ambient, which of them it goes through, or -1.
        from_world: (lights, 4, 4): u w, v w and w of a place in the world, or the way to it.
    """

    pictures: tuple[Picture, ...]
    layouts: tuple[CookieLayout, ...]
    values: Mapping[str, Any]
    numbers: tuple[int, ...]
    from_world: NDArray[np.float64]

    def uniforms(self, eye: NDArray[np.float64]) -> dict[str, Any]:
        """Return what lib/cookies.glsl asks for, with places seen from the eye."""
        if not self.pictures:
            return {}
        from_eye = self.from_world.copy()
        from_eye[:, :, 3] = self.from_world @ np.append(eye, 1.0)
        return {
            **self.values,
            "cookie_from_eye": from_eye,
            "cookie_picture": self.numbers,
            "cookie_period": np.array([picture.sampling.period for picture in self.pictures]),
            "cookie_size": np.array([(p.texture.width, p.texture.height) for p in self.pictures]),
        }


def cookies_of(lights: Sequence[Light], texture_of: TextureSource) -> Cookies:
    """Return the cookies of lights in the world; each picture is taken from `texture_of` once."""
    found: dict[str, tuple[Picture, CookieLayout]] = {}
    values: dict[str, Any] = {}
    numbers = []
    matrices = []
    for light in lights:
        if isinstance(light, AmbientLight):
            continue
        cookie = light.cookie
        if cookie is None:
            numbers.append(-1)
            matrices.append(np.zeros((4, 4)))
            continue
        if cookie.unit not in found:
            call = None
            if isinstance(cookie, Lantern):
                call = call_of("layout", "layouts", cookie.layout)
                values |= call.values(cookie.layout, f"cookie_{len(found)}")
            picture = _picture(cookie, texture_of)
            known = PictureLayout(picture.sampling, picture.texture.format)
            found[cookie.unit] = picture, CookieLayout(cookie.filter, known, call)
        numbers.append(list(found).index(cookie.unit))
        if isinstance(light, PointLight):
            matrices.append(_all_round(light))
        else:
            matrices.append(_projection(light, found[cookie.unit][0].sampling))
    return Cookies(
        tuple(picture for picture, _ in found.values()),
        tuple(layout for _, layout in found.values()),
        values,
        tuple(numbers),
        np.array(matrices).reshape(-1, 4, 4),
    )


def _picture(cookie: Slide | Gobo | Lantern, texture_of: TextureSource) -> Picture:
    wrap = cookie.joins
    sampling = Sampling.of(wrap, cookie.filter)
    border: tuple[float, ...] = (0.0,) * 4
    layout = None
    if isinstance(cookie, Lantern):
        layout = cookie.layout
    elif "border" in wrap:
        border = tuple(cookie.border_color)
    if isinstance(layout, CubeSpec):
        faces = texture_of.cube(cookie.texture, "colour", layout, levels=sampling.levels)
        return Picture(faces, sampling, border)
    form = StoredForm.of(cookie.filter, "box", wrap, border)
    levels = sampling.levels
    texture = texture_of(cookie.texture, "colour", levels=levels, layout=layout, form=form)
    return Picture(texture, sampling, border)


def _all_round(light: PointLight) -> Matrix:
    """Give the matrix from the world to the axes of what is round a lamp."""
    assert light.cookie is not None
    turn = parent_from_node(Placement(rotation=light.cookie.rotation))[:3, :3]
    matrix = np.zeros((4, 4))
    matrix[:3, :3] = turn.T
    matrix[:3, 3] = -turn.T @ light.position
    return matrix


def _projection(light: DirectionalLight | SpotLight, sampling: Sampling) -> Matrix:
    """Give the matrix from the world to u w, v w, w; the picture's middle lies on the axis."""
    cookie = light.cookie
    assert cookie is not None
    axes = light_axes(light.direction, np.array(cookie.up, dtype=np.float64))
    rows = np.zeros((3, 4))
    if isinstance(light, SpotLight):
        slope = max(math.tan(light.outer_angle), 1e-6)
        aspect = cookie.aspect  # type: ignore[union-attr]
        size = slope * np.array([min(aspect, 1.0), min(1 / aspect, 1.0)]) * 2
        rows[:, :3] = axes
        rows[:, 3] = -axes @ light.position
    else:
        assert isinstance(cookie, Gobo)
        size = np.array([cookie.width, cookie.height])
        rows[:2, :3] = axes[:2]
        rows[:2, 3] = -axes[:2] @ cookie.centre
        rows[2, 3] = 1.0
    rows[:2] = rows[:2] / size[:, None] + 0.5 * rows[2]
    matrix = np.zeros((4, 4))
    matrix[:3] = texture_from_uv(cookie.transform, sampling.period[:2]) @ rows
    return matrix
