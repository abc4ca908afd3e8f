"""The executor by itself: a normalised request in, a file and its facts out."""

import hashlib
import json
from pathlib import Path
from typing import Any, get_args

import numpy as np
import PIL.Image
import pytest

from api_schemas.digest import digest
from api_schemas.normalise import normalise
from api_schemas.output import Layer
from api_schemas.requests import REQUESTS, Kind
from tests.worker.images.exr_bytes import parse_exr
from worker import result_file, run_job
from worker.errors import AssetMissingError, RenderError
from worker.images import image_io
from worker.images.image import Image

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
        "preview": "no such folder/preview",
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


def table() -> dict[str, Any]:
    """A sheet at depth 3 on the left half, straight on."""
    sheet = {
        "mesh": {"type": "plane", "width": 1.0, "height": 2.0},
        "transform": {"translation": [-0.5, 0.0, 1.0]},
        "surface": {"technique": "unlit", "color": [0.25, 0.5, 4.0]},
    }
    return {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0, 0, 4]}},
        "nodes": [{"children": [sheet]}],
    }


SQUARE = {"size": [4, 4], "supersampling": 2}


@pytest.mark.gl
def test_an_exr_holds_the_layers_as_other_programs_name_them(tmp_path: Path) -> None:
    out = tmp_path / "picture"
    # The others are no other program's: their names are their own, with their channels behind.
    ours = {"light_visibility", "texel_density", "footprint", "shading_difference"}
    ours |= {"crypto_object", "crypto_material"}
    layers = [layer for layer in get_args(Layer) if layer not in ours]

    run(out, "render", table(), format="exr", layers=layers, **SQUARE)

    channels = parse_exr(out.read_bytes()).channels
    kinds = {name: str(values.dtype) for name, values in channels.items()}
    half = [*"RGBA", *(f"albedo.{name}" for name in "RGBA")]
    vectors = [f"{name}.{axis}" for name in ("P", "N", "Ng", "T") for axis in "XYZ"]
    full = ["Z", *vectors, "uv.U", "uv.V", "object_id", "material_id", "coverage"]
    assert kinds == dict.fromkeys(half, "float16") | dict.fromkeys(full, "float32")
    left, right = ({name: values[0, x].item() for name, values in channels.items()} for x in (1, 3))
    unmentioned = dict.fromkeys(kinds, 0.0)
    color = {"R": 0.25, "G": 0.5, "B": 4.0, "A": 1.0}
    assert right == unmentioned | {"Z": 1e10}
    assert left == unmentioned | color | {f"albedo.{name}": color[name] for name in "RGBA"} | {
        "Z": 3.0,
        "P.X": -0.375,  # of the first of four samples
        "P.Y": 0.625,
        "P.Z": 1.0,
        "N.Z": 1.0,
        "Ng.Z": 1.0,
        "T.X": 1.0,
        "uv.U": 0.625,
        "uv.V": 0.8125,
        "object_id": 1.0,
        "material_id": 1.0,
        "coverage": 1.0,
    }


@pytest.mark.gl
@pytest.mark.parametrize(
    ("layer", "bits", "left", "right"),
    [
        ("depth", 8, 64, 0),  # 255 / (1 + 3) = 63.75
        ("depth", 16, 16384, 0),  # 65535 / 4 = 16383.75
        ("normal", 8, (128, 128, 255), (128, 128, 128)),
        ("geometric_normal", 8, (128, 128, 255), (128, 128, 128)),
        ("tangent", 8, (255, 128, 128), (128, 128, 128)),
        ("position", 8, (0, 159, 255), (0, 0, 0)),
        ("uv", 8, (159, 207, 0), (0, 0, 0)),
        ("albedo", 8, (137, 188, 255, 255), (0, 0, 0, 0)),  # sRGB of .25 and .5
        ("object_id", 8, 1, 0),
        ("object_id", 16, 1, 0),
        ("material_id", 8, 1, 0),
        ("coverage", 8, 255, 0),
    ],
)
def test_a_png_of_one_layer_shows_it(
    tmp_path: Path, layer: str, bits: int, left: Any, right: Any
) -> None:
    out = tmp_path / "picture"

    run(out, "render", table(), layers=[layer], png_bits=bits, **SQUARE)

    with PIL.Image.open(out) as picture:
        assert (picture.getpixel((1, 0)), picture.getpixel((3, 0))) == (left, right)


@pytest.mark.gl
@pytest.mark.parametrize(
    "output", [{"format": "png"}, {"format": "exr", "layers": ["depth", "uv"]}]
)
def test_a_picture_written_in_bands_has_the_bytes_of_one_written_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, output: dict[str, Any]
) -> None:
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    scene, size = poster({"specular_weight": 0.4}), [37, 45]
    request = order("render", scene, **{"size": size, "supersampling": 2} | output)
    drawn: list[Any] = []
    write = result_file.write

    def keep(bands: Any, *rest: Any) -> str:
        drawn.extend(bands)
        return write(drawn, *rest)

    monkeypatch.setattr(result_file, "write", keep)
    run_job.run(request, whole, lambda share, stage: None)
    (band,) = drawn
    rows = [
        {name: Image(image.pixels[start:end], image.meaning) for name, image in band.items()}
        for start, end in ((0, 7), (7, 8), (8, 32), (32, 45))
    ]
    body = REQUESTS["render"].model_validate(request["body"])
    write(rows, body.output, request["digest"], cut)

    assert cut.read_bytes() == whole.read_bytes()


@pytest.mark.gl
def test_what_cannot_be_drawn_leaves_no_engine_behind(tmp_path: Path) -> None:
    nowhere = poster({}) | {"camera": {"type": "perspective", "pose": {"eye": [0, 1, 0]}}}
    with pytest.raises(RenderError):
        run(tmp_path / "picture", "render", nowhere)
    with pytest.raises(OSError, match="cannot write"):
        run(tmp_path / "no" / "picture", "render", poster({}), layers=["depth"])

    run(tmp_path / "picture", "render", poster({}))

    assert codes(tmp_path / "picture").any()
