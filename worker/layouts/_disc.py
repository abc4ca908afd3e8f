"""Discs on which the distance from the middle tells the angle from one direction.

Local axes are right, up and forward, towards the disc's middle; places on the disc are within the
unit circle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Numbers = NDArray[np.float64]
    Model = Literal["equidistant", "equisolid", "stereographic", "orthographic"]

OUTSIDE = 4.0
"""The radius of what is not on the disc."""


def on_disc(local: Numbers, model: Model, rim: float) -> Numbers:
    """Return where directions lie, (n, 2); `rim` is the angle from the middle to the rim."""
    across = np.hypot(local[:, 0], local[:, 1])
    angle = np.arctan2(across, local[:, 2])
    radius = _radius(angle, model) / _radius(np.float64(rim), model)
    radius = np.where(angle > rim * (1 + 1e-12), OUTSIDE, radius)
    scale = np.divide(radius, across, out=np.zeros_like(radius), where=across > 0)
    return local[:, :2] * scale[:, np.newaxis]


def from_disc(places: Numbers, model: Model, rim: float) -> tuple[Numbers, NDArray[np.bool_]]:
    """Return unit directions, (n, 3), and which places are on the disc; others are on its rim."""
    radius = np.hypot(places[:, 0], places[:, 1])
    angle = _angle(np.minimum(radius, 1.0) * _radius(np.float64(rim), model), model)
    scale = np.divide(np.sin(angle), radius, out=np.zeros_like(radius), where=radius > 0)
    local = np.column_stack([places * scale[:, np.newaxis], np.cos(angle)])
    return local, radius <= 1.0


def disc_density(places: Numbers, model: Model, rim: float) -> Numbers:
    """Return steradians per unit of the disc's area: sin(a) / (r dr/da), 0 beyond the rim."""
    whole = _radius(np.float64(rim), model)
    radius = np.maximum(np.hypot(places[:, 0], places[:, 1]), 1e-9)
    angle = _angle(np.minimum(radius, 1.0) * whole, model)
    return np.where(radius <= 1.0, _stretch(angle, model) * whole / radius, 0.0)


def _radius(angle: Numbers | np.float64, model: Model) -> Numbers:
    match model:
        case "equidistant":
            found = angle
        case "equisolid":
            found = 2 * np.sin(angle / 2)
        case "stereographic":
            found = 2 * np.tan(angle / 2)
        case "orthographic":
            found = np.sin(angle)
    return np.asarray(found)


def _angle(radius: Numbers, model: Model) -> Numbers:
    match model:
        case "equidistant":
            return radius
        case "equisolid":
            return 2 * np.arcsin(np.minimum(radius / 2, 1.0))
        case "stereographic":
            return 2 * np.arctan(radius / 2)
        case "orthographic":
            return np.arcsin(np.minimum(radius, 1.0))


def _stretch(angle: Numbers, model: Model) -> Numbers:
    """Return sin(a) over the slope of the radius there."""
    match model:
        case "equidistant":
            return np.sin(angle)
        case "equisolid":
            return 2 * np.sin(angle / 2)
        case "stereographic":
            return np.asarray(np.sin(angle) * np.cos(angle / 2) ** 2)
        case "orthographic":
            return np.tan(angle)
