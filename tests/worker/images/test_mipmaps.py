"""X18: a tiled EXR with a full chain of sizes, as an independent reader finds it."""

import numpy as np
import OpenImageIO
import pytest

from api_schemas.feasibility import obstacles
from api_schemas.output import TextureOutput
from api_schemas.requests import TextureRequest
from worker.images import image_io
from worker.images.image import Image
from worker.rendering.packing import PICTURE
from worker.result_file import write


def levels_of(path):
    """Return the pixels of every level, and the tile sizes."""
    file = OpenImageIO.ImageInput.open(str(path))
    found, tiles = [], set()
    while file.seek_subimage(0, len(found)):
        spec = file.spec(0, len(found))
        tiles.add((spec.tile_width, spec.tile_height))
        found.append(np.asarray(file.read_image(0, len(found), 0, spec.nchannels, "float")))
    file.close()
    return found, tiles


def written(tmp_path, pixels, **fields):
    path = tmp_path / "picture.exr"
    height, width = pixels.shape[:2]
    output = TextureOutput(
        size=[width, height], format="exr", exr_type="float", mipmaps=True, **fields
    )
    write([{PICTURE: Image(pixels, "colour")}], output, "0" * 64, path)
    return path


@pytest.mark.parametrize("size", [(128, 128), (200, 75), (1, 9), (64, 1)])
def test_x18_every_level_halves_down_to_one_pixel_and_keeps_the_mean(tmp_path, size):
    pixels = np.random.default_rng(0).random((size[1], size[0], 3)).astype(np.float32)

    levels, tiles = levels_of(written(tmp_path, pixels))

    assert tiles == {(64, 64)}
    assert len(levels) == int(np.log2(max(size))) + 1
    width, height = size
    for level in levels:
        assert level.shape == (height, width, 3)
        assert level.mean(axis=(0, 1)) == pytest.approx(pixels.mean(axis=(0, 1)), abs=1e-5)
        width, height = max(1, width // 2), max(1, height // 2)
    assert levels[0].tobytes() == pixels.tobytes()


def test_x18_a_level_is_the_box_mean_of_the_one_before(tmp_path):
    pixels = np.random.default_rng(1).random((32, 64, 3)).astype(np.float32)

    levels, _ = levels_of(written(tmp_path, pixels))

    assert levels[2] == pytest.approx(pixels.reshape(8, 4, 16, 4, 3).mean(axis=(1, 3)), abs=1e-6)


def test_it_is_read_back_as_an_upload_and_says_that_it_repeats(tmp_path):
    pixels = np.random.default_rng(2).random((16, 16, 3)).astype(np.float32)
    path = written(tmp_path, pixels)

    file = OpenImageIO.ImageInput.open(str(path))

    assert file.spec().getattribute("wrapmodes") == "periodic,periodic"
    assert file.spec().getattribute("textureformat") == "Plain Texture"
    assert image_io.read(path, "linear", "colour").pixels.tobytes() == pixels.tobytes()


def test_equal_pictures_give_equal_bytes(tmp_path):
    pixels = np.random.default_rng(3).random((70, 90, 3)).astype(np.float32)

    first = written(tmp_path, pixels).read_bytes()

    assert written(tmp_path, pixels).read_bytes() == first


def test_a_file_that_cannot_be_written_says_so(tmp_path):
    output = TextureOutput(size=[4, 4], format="exr", mipmaps=True)
    picture = {PICTURE: Image(np.zeros((4, 4, 3), np.float32), "colour")}

    with pytest.raises(OSError, match="cannot write the openexr file"):
        write([picture], output, "0" * 64, tmp_path / "missing" / "picture.exr")


@pytest.mark.parametrize(("file_format", "codes"), [("exr", []), ("png", ["mipmaps_need_exr"])])
def test_a_png_has_no_levels(file_format, codes):
    body = {"texture": {"technique": "perlin"}, "output": {"mipmaps": True, "format": file_format}}

    found = obstacles(TextureRequest.model_validate(body))

    assert [obstacle.code for obstacle in found] == codes
    assert [obstacle.pointer for obstacle in found] == ["/output/mipmaps"] * len(codes)
