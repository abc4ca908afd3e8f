"""X20: frames of a scene that turns; frame n of n is frame 0, to the last bit."""

import json
import math
from typing import Any

import numpy as np
import pytest

from api_schemas.digest import digest
from api_schemas.feasibility import obstacles
from api_schemas.normalise import normalise
from api_schemas.output import RenderOutput
from api_schemas.requests import RenderRequest
from api_schemas.scene import Scene
from tests.worker.rendering.studio import Studio

SIZE = (24, 16)
CAMERA = {"type": "perspective", "pose": {"eye": [0.5, 2.0, 5.0], "target": [0.0, 0.0, 0.0]}}
SUN = {"type": "directional", "direction": [-1.0, -1.0, -0.5], "shadow": {"resolution": 256}}


def scene(angle: float = 0.0) -> dict[str, Any]:
    """A box beside a ball on a floor, all turned about the upright axis through (0.25, 0, 0)."""
    turned = {"rotation": [0.0, math.sin(angle / 2), 0.0, math.cos(angle / 2)]}
    there = {"translation": [0.25, 0.0, 0.0]}
    floor = {"mesh": {"type": "plane", "facing": "+y", "width": 4, "height": 3}}
    box = {
        "mesh": {"type": "box", "width": 0.6},
        "transform": {"translation": [1.0, 0.5, 0.0], "scale": [1.0, 0.5, 0.4]},
    }
    ball = {"mesh": {"type": "sphere", "radius": 0.4}, "transform": {"translation": [-1, 0.4, 0]}}
    around = {"transform": turned, "children": [floor, box, ball]}
    return {
        "camera": CAMERA,
        "lights": [SUN],
        "nodes": [{"transform": there, "children": [around]}],
    }


def drawn(
    studio: Studio, body: dict[str, Any], layers: Any = (), **turntable: Any
) -> dict[str, Any]:
    """Draw a turntable; every layer whole."""
    from worker.rendering.renderer import render  # noqa: PLC0415  needs OpenGL

    output = {"size": list(SIZE), "supersampling": 2, "layers": list(layers)}
    output["turntable"] = {"pivot": [0.25, 0.0, 0.0], **turntable}
    rendering = render(
        Scene.model_validate_json(json.dumps(body)),
        RenderOutput.model_validate(output),
        studio.make,
        lambda mesh: studio.models[mesh.asset],
        lambda fraction, stage: studio.reports.append((fraction, stage)),
    )
    bands = list(rendering.bands)
    return {name: np.concatenate([band[name].pixels for band in bands]) for name in bands[0]}


@pytest.mark.gl
@pytest.mark.parametrize("frames", [1, 3, 7])
def test_x20_frame_n_is_frame_0_to_the_last_bit(studio: Studio, frames: int) -> None:
    first, last, none = (
        drawn(studio, scene(), ["depth", "light_visibility"], frames=frames, **number)
        for number in ({"frame": 0}, {"frame": frames}, {"frame": 0})
    )
    plain = studio.layers(scene(), ["depth"], SIZE, 2)

    for name in first:
        assert first[name].tobytes() == last[name].tobytes() == none[name].tobytes()
    assert first["picture"].tobytes() == plain["picture"].tobytes()


@pytest.mark.gl
@pytest.mark.parametrize("frame", [1, 2, 5])
def test_x20_a_frame_is_the_scene_turned(studio: Studio, frame: int) -> None:
    """By 2 pi k / n, counter-clockwise from above; light and eye stay, shadows turn."""
    turned = drawn(studio, scene(), frames=6, frame=frame)["picture"]

    by_hand = studio.draw(scene(2 * math.pi * frame / 6), SIZE, 2)

    # Matrices are rounded differently: edges and shadows may turn a sample.
    error = np.abs(turned - by_hand).max(axis=2)
    assert np.median(error) < 1e-5
    assert (error > 0.3).mean() < 0.01
    assert np.abs(turned - drawn(studio, scene(), frames=6, frame=0)["picture"]).max() > 0.2


@pytest.mark.gl
def test_x20_a_sheet_shows_the_frames_in_rows(studio: Studio) -> None:
    sheet = drawn(studio, scene(), ["object_id", "crypto_object"], frames=5)
    columns = round(math.sqrt(5 * SIZE[1] / SIZE[0]))
    rows = math.ceil(5 / columns)

    assert sheet["picture"].shape == (rows * SIZE[1], columns * SIZE[0], 4)
    for number in range(5):
        frame = drawn(studio, scene(), ["object_id", "crypto_object"], frames=5, frame=number)
        top, left = number // columns * SIZE[1], number % columns * SIZE[0]
        for name, pixels in frame.items():
            cell = sheet[name][top : top + SIZE[1], left : left + SIZE[0]]
            np.testing.assert_array_equal(cell, pixels, err_msg=f"{name} of {number}")
    rest = 5 % columns
    assert not sheet["picture"][-SIZE[1] :, rest * SIZE[0] :].any() or rest == 0


@pytest.mark.gl
def test_x20_frames_as_layers_are_the_frames(studio: Studio) -> None:
    layers = drawn(studio, scene(), ["depth"], frames=3, arrangement="layers")

    assert list(layers) == ["picture", "depth"] + [
        f"frame_000{number}{layer}" for number in range(3) for layer in ("", ".depth")
    ]
    for number in range(3):
        frame = drawn(studio, scene(), ["depth"], frames=3, frame=number)
        np.testing.assert_array_equal(layers[f"frame_000{number}"], frame["picture"])
        np.testing.assert_array_equal(layers[f"frame_000{number}.depth"], frame["depth"])
    np.testing.assert_array_equal(layers["picture"], layers["frame_0000"])


@pytest.mark.gl
def test_x20_a_camera_that_frames_sees_all_frames_from_one_place(studio: Studio) -> None:
    long = {"mesh": {"type": "box", "width": 6.0}, "surface": {"technique": "unlit"}}
    body = {"camera": {"type": "framed", "margin": 0.1}, "lights": [], "nodes": [long]}
    frames = [
        drawn(studio, body, frames=4, frame=number, pivot=[0, 0, 0])["picture"][..., 3]
        for number in range(4)
    ]
    sheet = drawn(studio, body, frames=4, pivot=[0, 0, 0])["picture"][..., 3]

    top = sheet[: SIZE[1], : SIZE[0]]
    for alpha in (top, sheet[-SIZE[1] :, -SIZE[0] :]):
        edges = [alpha[0], alpha[-1], alpha[:, 0], alpha[:, -1]]
        assert not np.concatenate(edges).any()
    assert top.sum() < frames[0].sum()  # one frame alone is framed alone


def request(**output: Any) -> RenderRequest:
    return RenderRequest.model_validate({"scene": scene(), "output": output})


def test_frame_n_is_the_same_work_as_frame_0() -> None:
    names = {
        digest(normalise(request(turntable={"frames": 12, "frame": frame}), "png", {}))
        for frame in (0, 12, 24, 36)
    }
    other = normalise(request(turntable={"frames": 12, "frame": 1}), "png", {})

    assert len(names) == 1
    assert digest(other) not in names


@pytest.mark.parametrize(
    ("output", "code", "pointer"),
    [
        (
            {"format": "png", "turntable": {"arrangement": "layers"}},
            "layers_need_exr",
            "/output/turntable/arrangement",
        ),
        (
            {"size": [4096, 4096], "turntable": {"frames": 36}},
            "atlas_too_large",
            "/output/turntable/frames",
        ),
        ({"format": "exr", "turntable": {"arrangement": "layers"}}, None, None),
        ({"size": [4096, 4096], "turntable": {"frames": 36, "frame": 7}}, None, None),
    ],
)
def test_what_cannot_be_laid_out_is_told(output: Any, code: str | None, pointer: str) -> None:
    found = [(obstacle.code, obstacle.pointer) for obstacle in obstacles(request(**output))]

    assert found == ([] if code is None else [(code, pointer)])


@pytest.mark.parametrize(
    "turntable", [{"frames": 0}, {"frames": 361}, {"frames": 2.5}, {"frame": -1}]
)
def test_strange_numbers_of_frames_are_refused(turntable: Any) -> None:
    with pytest.raises(ValueError, match="turntable"):
        request(turntable=turntable)
