"""T38, shadow mapping round a point: its six faces fit together."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

MATT = {"technique": "phong", "diffuse_color": [1.0, 1.0, 1.0]}


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_t38_a_point_shades_on_all_six_sides(studio: Studio, axis: int, sign: int) -> None:
    """Within a box with sides of 6 a small one, off the axis, throws three times its size."""
    small = np.full(3, 0.35)  # from 0.15 to 0.55 in the two other directions, around 1 in this one
    small[axis] = sign
    eye, up = np.zeros(3), np.zeros(3)
    eye[axis], up[(axis + 1) % 3] = 1.5 * sign, 1.0
    target = eye.copy()
    target[axis] = 3.0 * sign
    size = dict.fromkeys(("width", "height", "depth"), 0.4)
    size[("width", "height", "depth")[axis]] = 1e-3
    room = {"mesh": {"type": "box", "width": 6, "height": 6, "depth": 6}, "surface": MATT}
    body = {
        "camera": {
            "type": "orthographic",
            "height": 6.0,
            "pose": {"eye": eye.tolist(), "target": target.tolist(), "up": up.tolist()},
        },
        "lights": [{"type": "point", "position": [0, 0, 0], "shadow": {"resolution": 512}}],
        "nodes": [
            room,
            {"mesh": {"type": "box", **size}, "transform": {"translation": small.tolist()}},
        ],
    }
    drawn = studio.draw(body, (60, 60))[..., 0]

    along = ((np.arange(60) + 0.5) / 60 - 0.5) * 6
    right = np.cross(target - eye, up)[(axis + 2) % 3]
    across, upwards = np.meshgrid(along * np.sign(right), -along)
    inside = np.minimum.reduce(
        [part for place in (across, upwards) for part in (place - 0.45, 1.65 - place)]
    )
    # Texels are 6 / 500 wide there; the edge fades over four of them, and is moved by one.
    assert (drawn[inside > 0.06] == 0).all()
    assert (drawn[inside < -0.06] > 0.01).all()
    assert (inside > 0.06).sum() > 50
