"""Other renderers' pictures of the same models from the same place."""

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.model_files import ModelFiles
from worker.images import image_io

pytestmark = [pytest.mark.corpus, pytest.mark.gl]

Mask = NDArray[np.bool_]
F3D = (
    "khronos/AlphaBlendModeTest.glb",
    "khronos/NormalTangentTest.glb",
    "khronos/TextureTransformTest/TextureTransformTest.gltf",
    "khronos/BoxTextured.glb",
    "khronos/CesiumMilkTruck.glb",
    "khronos/MorphPrimitivesTest/glTF/MorphPrimitivesTest.gltf",
    "khronos/Cameras/Cameras.gltf",
    "meshes/spot.obj",
    "pyrender/fuze.obj",
)


@pytest.fixture
def files(tmp_path: Path) -> ModelFiles:
    return ModelFiles(tmp_path)


def overlap(a: Mask, b: Mask) -> float:
    """Intersection over union."""
    return float((a & b).sum() / (a | b).sum())


@pytest.mark.parametrize("name", F3D)
def test_the_outline_is_that_of_f3d(corpus: Path, files: ModelFiles, name: str) -> None:
    folder = corpus / "5_reference/f3d_renders"
    seen = json.loads((folder / "CAMERAS.json").read_text())[name]
    white = image_io.read(folder / seen["image"], "linear", "data").pixels[..., :3]
    camera = {
        "type": "perspective",
        "fov_y": math.radians(seen["view_angle_deg_vertical"]),
        "pose": {"eye": seen["position"], "target": seen["focal_point"], "up": seen["view_up"]},
    }

    drawn = files.draw(
        {"camera": camera, "nodes": [{"mesh": files.mesh(corpus / "1_models" / name)}]},
        (512, 512),
        supersampling=1,  # as theirs: a pixel is what its middle is
    )

    theirs = (white < 1).any(axis=2)
    assert overlap(drawn[..., 3] > 0.5, theirs) >= 0.99


def pytorch3d(corpus: Path, picture: str) -> NDArray[np.float32]:
    path = corpus / "5_reference/pytorch3d" / picture
    return image_io.read(path, "linear", "data").pixels


EYE: dict[str, Any] = {
    "type": "perspective",
    "fov_y": math.radians(60),
    "pose": {"eye": [0, 0, 2.7]},
}


def test_a_sphere_is_as_large_as_that_of_pytorch3d(corpus: Path, files: ModelFiles) -> None:
    theirs = pytorch3d(corpus, "test_simple_sphere_light_phong_FoVPerspectiveCameras.png")
    ball = {"mesh": {"type": "sphere", "segments": 256, "rings": 128}}

    drawn = files.draw({"camera": EYE, "nodes": [ball]}, (512, 512))

    def radius(coverage: Any) -> float:
        return math.sqrt(float(np.sum(coverage)) / math.pi)

    ours = radius(drawn[..., 3])
    # The outline of a unit ball from 2.7 away: 256 / tan 30 degrees * tan asin(1 / 2.7).
    assert ours == pytest.approx(256 * math.sqrt(3) / math.sqrt(2.7**2 - 1), abs=0.1)
    assert ours == pytest.approx(radius((theirs > 0).any(axis=2)), abs=1.0)


def test_the_cow_is_where_pytorch3d_sees_it(corpus: Path, files: ModelFiles) -> None:
    theirs = pytorch3d(corpus, "test_texture_map_back_MeshRasterizer.png")[..., :3]
    cow = files.mesh(corpus / "5_reference/pytorch3d/cow.obj")
    scene = {"camera": EYE, "nodes": [{"mesh": cow}], "lights": [{"type": "ambient"}]}

    drawn = files.draw(scene, (512, 512))

    assert overlap(drawn[..., 3] > 0.5, (theirs < 1).any(axis=2)) >= 0.99
