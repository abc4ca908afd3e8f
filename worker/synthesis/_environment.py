"""A picture of the light from all directions, as techniques get it: made fit, and told of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from api_schemas.sky import LIGHT_FROM_BELOW
from worker.errors import RenderError
from worker.images.mending import mended
from worker.synthesis._harmonics import NAMES, project
from worker.synthesis._sphere import Sphere

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.families import LayoutSpec
    from worker.images.image import Image

    Floats = NDArray[np.float64]


def taken(image: Image, layout: LayoutSpec, broken: str) -> tuple[Sphere, dict[str, Any]]:
    """Return a picture as light in three channels, and what there was to mend.

    Alpha is left out, and light below zero is none.

    Args:
        image: Of any channels; one or two are a grey.
        layout: Where directions lie on it.
        broken: "mend", or "refuse" where a texel is infinite or no number.

    Raises:
        RenderError: There is such a texel, and it is refused (`environment_texels`).
    """
    pixels, count = mended(image.pixels[..., : 3 if image.channels >= 3 else 1])
    if count and broken == "refuse":
        message = f"{count} numbers of the environment are infinite or no numbers"
        raise RenderError(message, code="environment_texels")
    light = np.ascontiguousarray(np.broadcast_to(pixels, (*pixels.shape[:2], 3)))
    return Sphere(light, layout), {"mended_numbers": count} if count else {}


def harmonics_of(sphere: Sphere) -> Floats:
    """Return the nine coefficients (9, 3) of a sphere's light."""
    light = sphere.pixels.reshape(-1, 3).astype(np.float64)
    return project(light, sphere.directions(), sphere.solid_angles().ravel())


def told(coefficients: Floats) -> dict[str, Any]:
    """Put coefficients into words: their names, and which way up they are."""
    total = coefficients.sum(axis=1)
    ratio = float(total[1] / total[0]) if total[0] > 0 else 0.0
    return {
        "coefficients": dict(zip(NAMES, coefficients.tolist(), strict=True)),
        "light_from_above": ratio,
        "upside_down": ratio < LIGHT_FROM_BELOW,
    }
