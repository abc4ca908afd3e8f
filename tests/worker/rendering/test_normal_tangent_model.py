"""A model made to show whether normal maps are read as their authors meant."""

from pathlib import Path

import numpy as np
import pytest

from api_schemas.textures.image import ImageSpec
from tests.worker.rendering.studio import Studio
from worker.images import image_io
from worker.models.formats import read_model

pytestmark = [pytest.mark.gl, pytest.mark.corpus]


def test_a_ball_in_a_normal_map_reads_as_the_ball_beside_it(
    studio: Studio, corpus: Path, tmp_path: Path
) -> None:
    # Khronos' NormalTangentTest: without tangents; on the left real balls, on the right pictures of
    # them on flat squares whose uv are turned.
    file = corpus / "1_models/khronos/NormalTangentTest.glb"
    model = read_model(file.read_bytes(), {})
    normal = model.surfaces[0].surface.normal
    assert normal is not None
    assert isinstance(normal.texture, ImageSpec)
    picture = tmp_path / "normals.png"
    picture.write_bytes(model.pictures[normal.texture.asset])
    held = studio.texture(image_io.read(picture, "linear", "data").pixels)
    surface = {"technique": "unlit", "normal": {"texture": held}}
    camera = {"type": "orthographic", "height": 2.4, "pose": {"eye": [0.0, 0.0, 2.0]}}
    node = {"mesh": studio.mesh(model.parts[0].mesh), "surface": surface}

    seen = studio.layers({"camera": camera, "nodes": [node]}, ["normal"], (1200, 1200))["normal"]

    reach = 40  # of the balls' 50 pixels
    inside = np.hypot(*np.mgrid[-reach : reach + 1, -reach : reach + 1]) < reach
    for x in (-0.96, -0.16, 0.64):
        for y in (-0.8, -0.4, 0.0, 0.4, 0.8):
            row, column = round((1.2 - y) * 500), round((x + 1.2) * 500)
            rows = slice(row - reach, row + reach + 1)
            real = seen[rows, column - reach : column + reach + 1][inside]
            flat = seen[rows, column + 160 - reach : column + 160 + reach + 1][inside]
            # Eight bits are 1/255, and half a pixel in where a square lies is 1/100 of the ball.
            assert np.abs(flat - real).max() < 0.02
