"""Pictures whose texels tell where they are, so that a pixel tells where it was looked up."""

from typing import Any

import numpy as np

from tests.worker.rendering.studio import Pixels, Studio
from worker import layouts

ORTHOGRAPHIC = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 4.0]}}
SIDE = 64
MIDDLES = {"scale": [0.4, 0.4], "offset": [0.5, 0.5]}
"""Brings -1..1 to the inner part of the picture."""


def places(studio: Studio) -> dict[str, Any]:
    """A texture that reads u, v, 0; exact half a texel from the edges, smoothly filtered or not."""
    middles = layouts.texel_middles(SIDE, SIDE).reshape(SIDE, SIDE, 2)
    return studio.texture(np.concatenate([middles, np.zeros((SIDE, SIDE, 1))], axis=2))


def directions(studio: Studio, layout: Any, width: int, height: int) -> dict[str, Any]:
    """A texture that reads, in a layout, the direction itself."""
    found, _ = layouts.direction(layout, layouts.texel_middles(width, height))
    return studio.texture(found.reshape(height, width, 3))


def shown(studio: Studio, mesh: Any, color: Any, size: int = 64, **more: Any) -> Pixels:
    """Draw one mesh that shows a map as it is; float32 (size, size, 4)."""
    node = {"mesh": mesh, "surface": {"technique": "unlit", "color": color}}
    return studio.draw(
        {
            "camera": more.get("camera", ORTHOGRAPHIC),
            "lights": [],
            "nodes": [{**node, "transform": more.get("transform", {})}],
        },
        (size, size),
    )


def pixel_middles(size: int) -> tuple[np.ndarray, np.ndarray]:
    """x and y of the pixels' middles in what ORTHOGRAPHIC sees."""
    x = (np.arange(size) + 0.5) * 2 / size - 1
    return tuple(np.meshgrid(x, -x))  # type: ignore[return-value]


def angles(pixels: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Degrees between directions read from pixels and unit ones."""
    lengths = np.maximum(np.linalg.norm(pixels, axis=-1, keepdims=True), 1e-9)
    chords = np.linalg.norm(pixels / lengths - wanted, axis=-1)
    return np.asarray(np.degrees(2 * np.arcsin(np.clip(chords / 2, 0, 1))))
