"""Volumes as files: where each slice lies."""

import numpy as np
import OpenImageIO
import pytest
from pydantic import TypeAdapter

from api_schemas.cost import Cost
from api_schemas.estimate import estimate
from api_schemas.members import Texture
from api_schemas.normalise import normalise
from api_schemas.output import TextureOutput
from api_schemas.requests import TextureRequest
from worker import run_job
from worker.images import image_io
from worker.images.volume import Volume
from worker.slices import atlas, slices_in
from worker.synthesis import synthesize_volume

MARBLE = {"technique": "marble", "veins": [1, 0, 2]}


def run(tmp_path, texture, **output):
    request = TextureRequest.model_validate({"texture": texture, "output": output})
    order = {
        "kind": "texture",
        "body": normalise(request, output["format"], {}).model_dump(mode="json"),
        "digest": "0" * 64,
        "assets": str(tmp_path / "assets"),
        "preview": str(tmp_path / "preview.png"),
    }
    return run_job.run(order, tmp_path / "file", lambda share, stage: None)


def test_slices_lie_in_rows_from_the_upper_left():
    voxels = np.arange(5, dtype=np.float32).reshape(5, 1, 1, 1) * np.ones((5, 2, 3, 1), np.float32)

    picture = atlas(Volume(voxels, "data"), 3).pixels[..., 0]

    assert picture.shape == (4, 9)
    assert picture[::2, ::3].tolist() == [[0, 1, 2], [3, 4, 0]]


@pytest.mark.parametrize(
    ("size", "slices", "columns", "file_size"),
    [
        ([8, 8], 16, 4, (32, 32)),
        ([8, 8], 5, 2, (16, 24)),
        ([32, 8], 16, 2, (64, 64)),
        ([8, 512], 4, 4, (32, 512)),
        ([512, 8], 4, 1, (512, 32)),
        ([7, 9], 1, 1, (7, 9)),
    ],
)
def test_an_atlas_is_as_nearly_square_as_can_be(size, slices, columns, file_size):
    output = TextureOutput(size=size, slices=slices)

    assert output.columns == columns
    assert output.file_size == file_size
    assert TextureOutput(size=size, slices=slices, arrangement="layers").file_size == tuple(size)


def test_layers_are_numbered_beside_the_first_slice():
    volume = Volume(np.random.default_rng(0).random((3, 2, 2, 1), np.float32), "data")
    output = TextureOutput(size=[2, 2], slices=3, arrangement="layers")

    pictures = slices_in(volume, output)

    assert list(pictures) == ["picture", "slice_0000", "slice_0001", "slice_0002"]
    assert (pictures["slice_0002"].pixels == volume.voxels[2]).all()
    assert (pictures["picture"].pixels == volume.voxels[0]).all()


def test_a_job_writes_the_atlas_of_a_solid_texture(tmp_path):
    facts = run(tmp_path, MARBLE, size=[16, 12], slices=6, format="exr", exr_type="float")

    written = image_io.read(tmp_path / "file", "linear", "data").pixels[..., 0]
    expected = synthesize_volume(TypeAdapter(Texture).validate_python(MARBLE), (16, 12, 6)).voxels[
        ..., 0
    ]
    assert (facts["width"], facts["height"]) == (32, 36) == written.shape[::-1]
    assert (written[:12, :16] == expected[0]).all()
    assert (written[24:, 16:] == expected[5]).all()


def test_a_job_writes_slices_as_layers(tmp_path):
    facts = run(tmp_path, MARBLE, size=[16, 12], slices=3, arrangement="layers", format="exr")

    assert (facts["width"], facts["height"]) == (16, 12)
    assert b"slice_0002" in (tmp_path / "file").read_bytes()


def test_a_job_writes_slices_as_parts(tmp_path):
    output = {"size": [16, 12], "slices": 3, "arrangement": "parts", "format": "exr"}
    facts = run(tmp_path, MARBLE, **output, exr_type="float")

    texture = TypeAdapter(Texture).validate_python(MARBLE)
    expected = synthesize_volume(texture, (16, 12, 3)).voxels
    assert (facts["width"], facts["height"]) == (16, 12)
    # What another reader sees of the file: three pictures, each with its name and its channels
    (tmp_path / "file.exr").write_bytes((tmp_path / "file").read_bytes())
    file = OpenImageIO.ImageInput.open(str(tmp_path / "file.exr"))
    for index, slice_ in enumerate(expected):
        assert file.seek_subimage(index, 0)
        assert file.spec().get_string_attribute("name") == f"slice_{index:04}"
        assert file.spec().get_string_attribute("texloom:digest")
        channels = file.spec().nchannels
        assert (file.read_image(index, 0, 0, channels, "float") == slice_).all()
    assert not file.seek_subimage(3, 0)


def test_parts_are_the_same_bytes_each_time(tmp_path):
    output = {"size": [8, 8], "slices": 2, "arrangement": "parts", "format": "exr"}
    written = []
    for name in "ab":
        (tmp_path / name).mkdir()
        run(tmp_path / name, MARBLE, **output)
        written.append((tmp_path / name / "file").read_bytes())

    assert written[0] == written[1]


def test_slices_cost_what_their_voxels_do():
    def cost(**output):
        body = {"texture": {"technique": "worley"}, "output": {"size": [64, 64], **output}}
        return estimate(TextureRequest.model_validate(body), {})

    assert cost(slices=64).seconds > 20 * cost().seconds - 0.2
    assert cost(slices=1024, size=[512, 512]).exceeds(Cost(60, 2**31))
