"""Pictures before lights: their textures, and the projections that find a place on them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.cookies import Cookie, Gobo
from api_schemas.lights import AmbientLight, DirectionalLight, Light, PointLight, SpotLight
from worker.geometry.transforms import Matrix
from worker.images.stored_form import StoredForm
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
        numbers: For each light that is not ambient, which of them it goes through, or -1.
        from_world: (lights, 4, 4): u w, v w and w of a place in the world.
    """

    pictures: tuple[Picture, ...]
    layouts: tuple[CookieLayout, ...]
    numbers: tuple[int, ...]
    from_world: NDArray[np.float64]

    def uniforms(self, eye: NDArray[np.float64]) -> dict[str, Any]:
        """Return what lib/cookies.glsl asks for, with places seen from the eye."""
        if not self.pictures:
            return {}
        from_eye = self.from_world.copy()
        from_eye[:, :, 3] = self.from_world @ np.append(eye, 1.0)
        return {
            "cookie_from_eye": from_eye,
            "cookie_picture": self.numbers,
            "cookie_period": np.array([picture.sampling.period for picture in self.pictures]),
            "cookie_size": np.array([(p.texture.width, p.texture.height) for p in self.pictures]),
        }


def cookies_of(lights: Sequence[Light], texture_of: TextureSource) -> Cookies:
    """Return the cookies of lights in the world; each picture is taken from `texture_of` once."""
    found: dict[str, tuple[Picture, CookieLayout]] = {}
    numbers = []
    matrices = []
    for light in lights:
        if isinstance(light, AmbientLight):
            continue
        cookie = None if isinstance(light, PointLight) else light.cookie
        if cookie is None:
            numbers.append(-1)
            matrices.append(np.zeros((4, 4)))
            continue
        if cookie.unit not in found:
            picture = _picture(cookie, texture_of)
            known = PictureLayout(picture.sampling, picture.texture.format)
            found[cookie.unit] = picture, CookieLayout(cookie.filter, known)
        numbers.append(list(found).index(cookie.unit))
        matrices.append(_projection(light, cookie, found[cookie.unit][0].sampling))  # type: ignore[arg-type]
    return Cookies(
        tuple(picture for picture, _ in found.values()),
        tuple(layout for _, layout in found.values()),
        tuple(numbers),
        np.array(matrices).reshape(-1, 4, 4),
    )


def _picture(cookie: Cookie, texture_of: TextureSource) -> Picture:
    u, v = cookie.wrap
    sampling = Sampling.of((u, v), cookie.filter)
    border = tuple(cookie.border_color) if "border" in (u, v) else (0.0,) * 4
    form = StoredForm.of(cookie.filter, "box", (u, v), border)
    texture = texture_of(cookie.texture, "colour", levels=sampling.levels, form=form)
    return Picture(texture, sampling, border)


def _projection(light: DirectionalLight | SpotLight, cookie: Cookie, sampling: Sampling) -> Matrix:
    """Give the matrix from the world to u w, v w, w; the picture's middle lies on the axis."""
    axes = light_axes(light.direction, np.array(cookie.up, dtype=np.float64))
    rows = np.zeros((3, 4))
    if isinstance(light, SpotLight):
        slope = max(math.tan(light.outer_angle), 1e-6)
        aspect = cookie.aspect  # type: ignore[attr-defined]
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
