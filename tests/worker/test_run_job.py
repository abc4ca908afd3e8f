"""The executor by itself: a normalised request in, a file and its facts out."""

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np
import PIL.Image
import pytest

from api_schemas.digest import digest
from api_schemas.normalise import normalise
from api_schemas.requests import REQUESTS, Kind
from worker import run_job
from worker.errors import AssetMissingError
from worker.images import image_io

PERLIN = {"technique": "perlin", "frequency": 3, "seed": 4}
RED = {"technique": "constant", "value": [0.25, 0.0, 0.0]}


def order(kind: Kind, content: dict[str, Any], **output: Any) -> dict[str, Any]:
    """What the service would hand to the executor."""
    field = {"texture": "texture", "render": "scene"}[kind]
    body = {field: content, "output": {"size": [24, 16], "format": "png", **output}}
    request = REQUESTS[kind].model_validate(body)
    settled = normalise(request, body["output"]["format"], {})
    return {
        "kind": kind,
        "body": settled.model_dump(mode="json"),
        "digest": digest(settled),
        "assets": "no such folder",
    }


def run(out: Path, *request: Any, **output: Any) -> tuple[dict[str, Any], list[tuple[float, str]]]:
    reports: list[tuple[float, str]] = []
    facts = run_job.run(
        order(*request, **output), out, lambda share, stage: reports.append((share, stage))
    )
    return facts, reports


def poster(surface: dict[str, Any]) -> dict[str, Any]:
    return {
        "camera": {"type": "orthographic", "pose": {"eye": [0, 0, 2]}},
        "lights": [{"type": "directional", "direction": [0.5, -0.5, -1]}],
        "nodes": [{"mesh": {"type": "sphere"}, "surface": {"technique": "phong", **surface}}],
    }


def codes(path: Path) -> np.ndarray:
    with PIL.Image.open(path) as picture:
        return np.asarray(picture)


def test_the_facts_are_those_of_the_file(tmp_path: Path) -> None:
    out = tmp_path / "picture"

    facts, _ = run(out, "texture", PERLIN)

    assert facts["sha256"] == hashlib.sha256(out.read_bytes()).hexdigest()
    assert facts["bytes"] == out.stat().st_size
    assert (facts["media_type"], facts["width"], facts["height"]) == ("image/png", 24, 16)
    assert set(facts["timings"]) == {"find_ms", "synthesise_ms", "encode_ms", "hash_ms"}
    assert json.loads(json.dumps(facts, allow_nan=False)) == facts


@pytest.mark.gl
def test_progress_never_falls_and_every_stage_is_told(tmp_path: Path) -> None:
    facts, reports = run(tmp_path / "picture", "render", poster({}))

    shares = [share for share, _ in reports]
    assert shares == sorted(shares)
    assert 0 <= shares[0] <= shares[-1] <= 1
    assert list(dict.fromkeys(stage for _, stage in reports)) == ["find", "render", "hash"]
    parts = ("build_ms", "draw_ms", "jit_ms")
    assert {"render_ms", "encode_ms", *parts} <= set(facts["timings"])
    assert sum(facts["timings"][part] for part in parts) <= facts["timings"]["render_ms"]
    assert facts["counts"]["triangles"] == 2 * 64 * 31


def test_a_picture_that_is_gone_is_named_with_its_place(tmp_path: Path) -> None:
    image = {"technique": "image", "asset": "a" * 64, "encoding": "srgb"}
    ramp = {"technique": "ramp", "input": image, "stops": [{"position": 0, "color": [1, 1, 1]}]}

    with pytest.raises(AssetMissingError) as caught:
        run(tmp_path / "picture", "texture", ramp)

    assert caught.value.pointer == "/texture/input/asset"
    assert not (tmp_path / "picture").exists()


def test_data_goes_into_a_png_as_it_is_and_light_through_the_curve(tmp_path: Path) -> None:
    out = tmp_path / "picture"
    half = {"technique": "constant", "value": 0.5}
    noise = {**PERLIN, "frequency": 64}  # too fine for 24 pixels: its mean, one half, everywhere

    run(out, "texture", half)
    assert (codes(out) == 188).all()  # 255 (1.055 0.5^(1/2.4) - 0.055) = 187.5
    run(out, "texture", noise, exposure=1.0)
    assert (codes(out) == 128).all()
    run(out, "texture", half, exposure=-1.0)
    assert (codes(out) == 137).all()  # the same of 0.25: 136.96


@pytest.mark.gl
@pytest.mark.parametrize(
    ("name", "value", "texture"),
    [
        ("diffuse_color", [0.25, 0.0, 0.0], RED),
        ("exponent", 0.7, {"technique": "constant", "value": 0.7}),
        ("emission", [0.1, 0.1, 0.1], {"technique": "constant", "value": 0.1}),
    ],
)
def test_a_map_of_the_technique_constant_is_the_constant_bit_for_bit(
    tmp_path: Path, name: str, value: Any, texture: dict[str, Any]
) -> None:
    # T03
    shown = []
    for given in (value, {"texture": texture}):
        path = tmp_path / "picture.exr"
        surface = {"specular_weight": 0.3, name: given}
        run(path, "render", poster(surface), format="exr", exr_type="float")
        shown.append(image_io.read(path, "linear", "colour").pixels)

    assert shown[0].any()
    np.testing.assert_array_equal(shown[1], shown[0])
