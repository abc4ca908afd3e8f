"""The layers of an example look as they did; tests/worker/rendering/test_layers.py says why."""

from typing import Any, get_args

import numpy as np
import pytest

from api_schemas.output import Layer
from tests.run_example import run_example
from tests.worker.images.exr_bytes import parse_exr
from worker.images.image import Image

CHANNELS = {
    "depth": ["Z"],
    "position": ["P.X", "P.Y", "P.Z"],
    "normal": ["N.X", "N.Y", "N.Z"],
    "geometric_normal": ["Ng.X", "Ng.Y", "Ng.Z"],
    "tangent": ["T.X", "T.Y", "T.Z"],
    "uv": ["uv.U", "uv.V"],
    "albedo": ["albedo.R", "albedo.G", "albedo.B", "albedo.A"],
    "object_id": ["object_id"],
    "material_id": ["material_id"],
    "coverage": ["coverage"],
    "footprint": [f"footprint.{letter}" for letter in "XYZW"],
    "texel_density": ["texel_density"],
    "shading_difference": [f"shading_difference.{letter}" for letter in "RGB"],
    "light_visibility": ["light_visibility"],
    "crypto_object": [f"CryptoObject.{letter}" for letter in "RGB"],
    "crypto_material": [f"CryptoMaterial.{letter}" for letter in "RGB"],
}


@pytest.fixture(scope="module")
def channels(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    folder = tmp_path_factory.mktemp("layers")
    output = {"size": [96, 64], "format": "exr", "exr_type": "float"}
    run_example("layers", folder / "picture", folder / "assets", **output)
    return parse_exr((folder / "picture").read_bytes()).channels


@pytest.mark.golden
@pytest.mark.gl
@pytest.mark.parametrize("layer", get_args(Layer))
def test_a_layer_looks_as_it_did(
    layer: str, channels: dict[str, Any], compare_with_golden: Any
) -> None:
    pixels = np.stack([channels[name] for name in CHANNELS[layer]], axis=2)
    meaning = "colour" if layer in ("albedo", "shading_difference") else "data"

    compare_with_golden(Image(pixels, meaning), f"layers/{layer}")  # type: ignore[arg-type]
