"""Panes of glass before an eye that looks along -z."""

from typing import Any

import numpy as np

from tests.worker.rendering.studio import Studio

CAMERA = {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 10.0]}}


RED, GREEN, BLUE = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]


def glass(color: list[float], opacity: Any = 0.5, **more: Any) -> dict[str, Any]:
    surface = {"technique": "unlit", "color": color, "opacity": opacity, "alpha_mode": "blend"}
    return surface | more


def poster(z: float, surface: dict[str, Any], **transform: Any) -> dict[str, Any]:
    placed = {"translation": [0.0, 0.0, z]} | transform
    return {"mesh": {"type": "plane"}, "transform": placed, "surface": surface}


def over(front: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Porter and Duff (1984), premultiplied."""
    return front + back * (1 - front[..., 3:])


def glass_scene(studio: Studio) -> dict[str, Any]:
    """Everything that opacity does, before a picture."""
    leaves = studio.texture(np.random.default_rng(3).random((8, 8)))
    ring = {"type": "torus"}
    return {
        "camera": CAMERA,
        "background": {"texture": studio.texture(np.random.default_rng(2).random((9, 9, 3)))},
        "nodes": [
            poster(0.0, {"technique": "unlit", "color": BLUE}, scale=[0.4, 0.4, 1.0]),
            poster(-1.0, glass(GREEN, {"texture": leaves}, alpha_mode="mask"), scale=[0.9, 0.9, 1]),
            poster(1.0, glass(RED), rotation=[0.3, 0.2, 0.1, 1.0]),
            poster(0.5, glass(GREEN, 0.3), rotation=[-0.3, 0.1, 0.5, 1.0]),
            {
                "mesh": ring,
                "transform": {"scale": [0.5, 0.5, 0.5]},
                "surface": glass([1.0, 1.0, 1.0], 0.2),
            },
        ],
    }
