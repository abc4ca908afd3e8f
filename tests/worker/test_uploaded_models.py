"""A model is its file and those beside it, whatever was read before."""

import hashlib

import pytest

from api_schemas.model_mesh import ModelMesh
from worker.errors import AssetMissingError
from worker.uploaded_models import UploadedModels
from worker.uploaded_pictures import UploadedPictures

TRIANGLE = b"mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n"
RED, BLUE = (b"newmtl paint\nKd %s\n" % colour for colour in (b"0.75 0 0", b"0 0 0.75"))


@pytest.fixture
def models(tmp_path):
    """Stores files as assets, and reads the triangle with some of them beside it."""

    def store(content):
        name = hashlib.sha256(content).hexdigest()
        path = tmp_path / name[:2] / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
        return name

    uploads = UploadedModels(tmp_path, UploadedPictures(tmp_path))

    def read(**files):
        stored = {name.replace("_", "."): store(content) for name, content in files.items()}
        mesh = {"type": "model", "asset": store(TRIANGLE), "files": stored}
        return uploads.read(ModelMesh.model_validate(mesh))

    return read


def colour(model):
    return model.surfaces[0].surface.model_dump()["diffuse_color"]


def test_the_same_file_with_another_beside_it_is_another_model(models):
    red, blue = colour(models(paint_mtl=RED)), colour(models(paint_mtl=BLUE))

    assert red[0] > 0 == red[2]
    assert blue[2] > 0 == blue[0]


def test_a_file_that_is_not_in_the_set_is_missing_even_after_it_was_once_there(models):
    models(paint_mtl=RED)

    with pytest.raises(AssetMissingError, match=r"paint\.mtl"):
        models()
