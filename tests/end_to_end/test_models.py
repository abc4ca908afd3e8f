"""Models go in over HTTP and come out as pictures, however they are packed."""

import base64
import io
import json

import numpy as np
import pytest
from PIL import Image

from tests import small_models

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

FACING = {"type": "orthographic", "height": 4, "pose": {"eye": [0, 0, 5]}}
SIZE = {"size": [64, 64]}
KINDS = {"bin": "application/gltf-buffer", "mtl": "model/mtl"}


@pytest.fixture
def client(service):
    with service.client() as client:
        yield client


@pytest.fixture
def upload(client):
    """Uploads a file under the name it has on a disk, and returns its facts."""

    def upload(content, name):
        media_type = KINDS.get(name.rpartition(".")[2], "application/octet-stream")
        answer = client.post("/v1/assets", content=content, headers={"Content-Type": media_type})
        assert answer.status_code in (200, 201), answer.text
        return answer.json()

    return upload


@pytest.fixture
def pixels(client):
    """Renders a model, and returns its job and its picture, (height, width, 4) codes."""

    def pixels(mesh, camera=FACING, **scene):
        scene = {"camera": camera, "nodes": [{"mesh": {"type": "model", **mesh}}], **scene}
        answer = client.post(
            "/v1/renders",
            json={"scene": scene, "output": SIZE},
            headers={"Accept": "image/png"},
        )
        assert answer.status_code == 200, answer.text
        return np.asarray(Image.open(io.BytesIO(answer.content)).convert("RGBA"))

    return pixels


def shows_a_red_square(picture):
    """The middle half of each side, exactly: the square is 2 wide where the camera sees 4."""
    expected = np.zeros((64, 64, 4), np.uint8)
    expected[16:48, 16:48] = (255, 0, 0, 255)
    return np.array_equal(picture, expected)


@pytest.mark.parametrize("packed", [small_models.glb(), small_models.gltf()], ids=["glb", "gltf"])
def test_a_red_square_is_drawn_as_its_file_says(upload, pixels, packed):
    facts = upload(packed, "square")

    assert (facts["kind"], facts["triangles"]) == ("model", 2)
    assert (facts["bounds_min"], facts["bounds_max"]) == ([-1, -1, 0], [1, 1, 0])
    assert (facts["materials"], facts["nodes"], facts["files"]) == (["red"], ["square"], [])
    assert shows_a_red_square(pixels({"asset": facts["sha256"]}))


def test_a_buffer_beside_a_gltf_file_is_asked_for_and_found(client, upload, pixels):
    model = upload(small_models.gltf(uri="the%20numbers.bin"), "square.gltf")
    buffer = upload(small_models.BINARY, "the numbers.bin")
    assert model["files"] == ["the numbers.bin"]

    alone = {"scene": {"nodes": [{"mesh": {"type": "model", "asset": model["sha256"]}}]}}
    refused = client.post("/v1/renders", json=alone)
    assert (refused.status_code, refused.json()["code"]) == (409, "asset_file_missing")
    assert "the numbers.bin" in refused.json()["detail"]

    files = {"the numbers.bin": buffer["sha256"]}
    assert shows_a_red_square(pixels({"asset": model["sha256"], "files": files}))


def test_an_obj_file_wears_its_material_library(client, upload, pixels):
    model = upload(small_models.OBJ, "square.obj")
    library = upload(small_models.MTL, "square.mtl")
    assert (model["files"], library["kind"]) == (["square.mtl"], "material_library")

    files = {"square.mtl": library["sha256"]}
    light = {"type": "ambient", "radiance": [1, 1, 1]}
    picture = pixels({"asset": model["sha256"], "files": files}, lights=[light])
    inner, outer = picture[17:47, 17:47], picture[:15]

    assert inner[..., 0].min() > 100
    assert inner[..., 1:3].max() < 80
    assert outer.max() == 0


@pytest.mark.parametrize(
    ("packed", "name"), [(small_models.PLY, "square.ply"), (small_models.STL, "square.stl")]
)
def test_a_mesh_without_materials_is_grey(upload, pixels, packed, name):
    facts = upload(packed, name)
    picture = pixels({"asset": facts["sha256"]})

    assert (facts["format"], facts["triangles"]) == (name[-3:], 2)
    assert (picture[17:47, 17:47, 3] == 255).all()
    assert np.ptp(picture[..., :3], axis=2).max() == 0
    assert picture[:15].max() == 0


def test_names_and_indices_reach_the_same_parts(upload, pixels):
    asset = upload(small_models.glb(), "square.glb")["sha256"]
    green = {"technique": "unlit", "color": [0, 1, 0]}
    pictures = [
        pixels({"asset": asset, **change})
        for change in (
            {"materials": [{"material": "red", "surface": green}]},
            {"materials": [{"material": 0, "surface": green}]},
            {"nodes": [{"node": "square", "surface": green}]},
            {"nodes": [{"node": 0, "surface": green}]},
        )
    ]

    assert (pictures[0][32, 32] == (0, 255, 0, 255)).all()
    assert all(np.array_equal(pictures[0], picture) for picture in pictures[1:])
    assert pixels({"asset": asset, "nodes": [{"node": 0, "visible": False}]}).max() == 0


def test_a_part_that_is_not_there_is_a_problem_with_its_place(client, upload):
    asset = upload(small_models.glb(), "square.glb")["sha256"]
    mesh = {"type": "model", "asset": asset, "nodes": [{"node": "circle"}]}
    answer = client.post("/v1/renders", json={"scene": {"nodes": [{"mesh": mesh}]}})

    assert (answer.status_code, answer.json()["code"]) == (409, "model_part_unknown")
    assert answer.json()["pointer"] == "/scene/nodes/0/mesh/nodes/0/node"


def test_one_of_a_files_scenes_is_drawn_and_others_are_not_there(client, upload, pixels):
    """The second scene has a smaller square, of a quarter of the area."""
    nodes = [{"mesh": 0}, {"mesh": 0, "scale": [0.5, 0.5, 0.5]}]
    content = small_models.glb(nodes=nodes, scenes=[{"nodes": [0]}, {"nodes": [1]}])
    facts = upload(content, "square.glb")
    drawn = [
        int((pixels({"asset": facts["sha256"], "scene": scene})[..., 3] > 0).sum())
        for scene in (None, 0, 1)
    ]
    mesh = {"type": "model", "asset": facts["sha256"], "scene": 2}
    refused = client.post("/v1/renders", json={"scene": {"nodes": [{"mesh": mesh}]}})

    assert facts["scenes"] == 2
    assert drawn == [1024, 1024, 256]
    assert (refused.status_code, refused.json()["code"]) == (409, "model_part_unknown")
    assert refused.json()["pointer"] == "/scene/nodes/0/mesh/scene"


def repacked(embedded):
    """Pack a glTF file with everything inside anew: as GLB, and with everything beside it."""
    document = json.loads(embedded)
    (buffer,), (image,) = document["buffers"], document["images"]
    numbers, picture = (base64.b64decode(it.pop("uri").partition(",")[2]) for it in (buffer, image))
    beside = json.loads(json.dumps(document))
    beside["buffers"][0]["uri"], beside["images"][0]["uri"] = "a/box.bin", "the%20logo.png"
    start = len(numbers) + -len(numbers) % 4
    view = {"buffer": 0, "byteOffset": start, "byteLength": len(picture)}
    image |= {"bufferView": len(document["bufferViews"]), "mimeType": "image/png"}
    document["bufferViews"].append(view)
    buffer["byteLength"] = start + len(picture)
    within = small_models.packed(document, numbers.ljust(start, b"\0") + picture)
    files = {"a/box.bin": (numbers, ".bin"), "the logo.png": (picture, ".png")}
    return within, json.dumps(beside).encode(), files


@pytest.mark.corpus
def test_one_box_in_three_packagings_is_one_picture(corpus, upload, pixels):
    """The corpus has three of its own, but with other pictures and other samplers."""
    embedded = (corpus / "1_models/khronos/BoxTextured-embedded/BoxTextured.gltf").read_bytes()
    within, beside, contents = repacked(embedded)
    files = {name: upload(*content)["sha256"] for name, content in contents.items()}
    pictures = []
    for packed in (embedded, within, beside):
        facts = upload(packed, "box")
        given = files if facts["files"] else {}
        assert set(facts["files"]) == set(given)
        pictures.append(pixels({"asset": facts["sha256"], "files": given}, camera=None))

    assert len({tuple(colour) for colour in pictures[0].reshape(-1, 4)}) > 50
    assert np.array_equal(pictures[0], pictures[1])
    assert np.array_equal(pictures[0], pictures[2])


@pytest.mark.corpus
def test_the_boxes_of_the_corpus_have_one_outline(corpus, upload, pixels):
    folder = corpus / "1_models/khronos"
    beside = folder / "BoxTextured-separate"
    files = {
        path.name: upload(path.read_bytes(), path.name)["sha256"]
        for path in (beside / "BoxTextured0.bin", beside / "CesiumLogoFlat.png")
    }
    outlines = []
    for path in (
        folder / "BoxTextured.glb",
        folder / "BoxTextured-embedded/BoxTextured.gltf",
        beside / "BoxTextured.gltf",
    ):
        facts = upload(path.read_bytes(), path.name)
        assert facts["triangles"] == 12
        assert facts["bounds_min"] == [-0.5] * 3
        assert facts["bounds_max"] == [0.5] * 3
        mesh = {"asset": facts["sha256"]} | ({"files": files} if facts["files"] else {})
        outlines.append(pixels(mesh, camera=None)[..., 3])

    assert 0.2 < (outlines[0] > 0).mean() < 0.9
    assert all(np.array_equal(outlines[0], other) for other in outlines[1:])
