"""Text on a texture reads upright and unmirrored on every primitive, seen from where it faces."""

from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

# An F with its parts in colours: red stem, green upper arm, blue middle arm, on white.
LETTER = np.ones((64, 64, 3), dtype=np.float32)
LETTER[12:52, 20:26] = [1, 0, 0]
LETTER[12:18, 26:44] = [0, 1, 0]
LETTER[28:34, 26:38] = [0, 0, 1]

FRONT, SIDE = [0.0, 0.0, 6.0], [-6.0, 0.0, 0.0]
CASES: dict[str, tuple[dict[str, Any], list[float], list[float], list[float]]] = {
    # name: mesh, eye, up, offset that brings the letter's middle before the eye
    "cylinder": ({"type": "cylinder", "height": 2.0}, [-6.0, 1.0, 0.0], [0, 1, 0], [0, 0]),
    "lid": ({"type": "cylinder", "caps": True}, [0.0, 6.0, 0.0], [0, 0, -1], [0, 0]),
    "bottom": ({"type": "cylinder", "caps": True}, [0.0, -6.0, 0.0], [0, 0, 1], [0, 0]),
    "sphere": ({"type": "sphere"}, SIDE, [0, 1, 0], [0, 0]),
    "sphere from the front": ({"type": "sphere"}, FRONT, [0, 1, 0], [-0.25, 0]),
    "plane": ({"type": "plane"}, FRONT, [0, 1, 0], [0, 0]),
    "floor": ({"type": "plane", "facing": "+y"}, [0.0, 6.0, 0.0], [0, 0, -1], [0, 0]),
    "disk": ({"type": "disk"}, FRONT, [0, 1, 0], [0, 0]),
    "lying disk": ({"type": "disk", "facing": "+y"}, [0.0, 6.0, 0.0], [0, 0, -1], [0, 0]),
    "box +x": ({"type": "box"}, [6.0, 0.0, 0.0], [0, 1, 0], [0, 0]),
    "box -x": ({"type": "box"}, SIDE, [0, 1, 0], [0, 0]),
    "box +y": ({"type": "box"}, [0.0, 6.0, 0.0], [0, 0, -1], [0, 0]),
    "box -y": ({"type": "box"}, [0.0, -6.0, 0.0], [0, 0, 1], [0, 0]),
    "box +z": ({"type": "box"}, FRONT, [0, 1, 0], [0, 0]),
    "box -z": ({"type": "box"}, [0.0, 0.0, -6.0], [0, 1, 0], [0, 0]),
    "torus": ({"type": "torus", "tube_radius": 0.6}, SIDE, [0, 1, 0], [0, 0.5]),
}


@pytest.mark.parametrize("case", CASES)
def test_the_letter_reads(studio: Studio, case: str) -> None:
    mesh, eye, up, offset = CASES[case]
    target = [0.0, eye[1], 0.0] if case == "cylinder" else [0.0, 0.0, 0.0]
    drawn = studio.draw(
        {
            "camera": {
                "type": "perspective",
                "fov_y": 0.5,
                "pose": {"eye": eye, "target": target, "up": [float(x) for x in up]},
            },
            "nodes": [
                {
                    "mesh": mesh,
                    "surface": {
                        "technique": "unlit",
                        "color": {
                            "texture": studio.texture(LETTER),
                            "transform": {
                                "offset": [float(x) for x in offset],
                                "scale": [1.0, 2.0 if case == "torus" else 1.0],
                            },
                        },
                    },
                }
            ],
        },
        (128, 128),
    )[..., :3]

    def middle(colour: list[int]) -> tuple[float, float]:
        rows, columns = np.nonzero(np.abs(drawn - colour).max(axis=2) < 0.2)
        assert len(rows) > 8
        return float(rows.mean()), float(columns.mean())

    stem, upper, lower = middle([1, 0, 0]), middle([0, 1, 0]), middle([0, 0, 1])
    assert stem[1] < lower[1] < upper[1], "the arms point to the right"
    assert upper[0] < lower[0], "the longer arm is on top"
    assert upper[0] < stem[0]


@pytest.mark.parametrize("mesh", ["cylinder", "sphere", "torus"])
def test_the_seam_does_not_show(studio: Studio, mesh: str) -> None:
    # Half a turn round the axis and half a tile along u are the same thing.
    picture = studio.texture(np.random.default_rng(9).random((32, 64, 3)))

    def seen_from(x: float, shift: float) -> np.ndarray:
        mapped = {"texture": picture, "transform": {"offset": [shift, 0.0]}}
        return studio.draw(
            {
                "camera": {"type": "perspective", "pose": {"eye": [x, 1.0, 0.0]}},
                "nodes": [
                    {"mesh": {"type": mesh}, "surface": {"technique": "unlit", "color": mapped}}
                ],
            },
            (96, 96),
        )

    at_the_seam, opposite = seen_from(4.0, 0.0), seen_from(-4.0, 0.5)

    # cos and sin of opposite angles differ in the last bit, uv by 2^-24; 64 texels from 0 to 1.
    error = np.abs(at_the_seam - opposite).max(axis=2)
    assert np.quantile(error, 0.99) < 2e-4
    assert error[40:56, 40:56].max() < 2e-3
