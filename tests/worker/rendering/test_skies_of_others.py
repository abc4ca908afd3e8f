"""Which way round the skies of others are: told by what is written and drawn in them."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.layouts.latlong import LatlongSpec
from api_schemas.members import Texture
from api_schemas.textures.image import ImageSpec
from tests.worker.rendering.coded import shown
from tests.worker.rendering.studio import Studio
from worker import layouts
from worker.images import image_io
from worker.images.edges import with_whole_edges
from worker.images.image import Image
from worker.stages import silent
from worker.synthesis import six_faces
from worker.uploaded_pictures import UploadedPictures

pytestmark = pytest.mark.corpus

AXES = {
    "X": np.array([1.0, 0.0, 0.0]),
    "Y": np.array([0.0, 1.0, 0.0]),
    "Z": np.array([0.0, 0.0, 1.0]),
}
SIDE = 256
PHOTOGRAPHS = {"front": "-z", "right": "+x", "back": "+z", "left": "-x", "top": "+y"}


def picture(path: Path) -> np.ndarray:
    return np.ascontiguousarray(image_io.read(path, "linear", "colour").pixels[..., :3])


def looking(studio: Studio, texture: dict[str, Any], forward: np.ndarray) -> np.ndarray:
    """What the eye in the middle sees in a quarter turn, y upwards."""
    pose = {"eye": [0.0, 0.0, 0.0], "target": forward.tolist()}
    camera = {"type": "perspective", "fov_y": math.pi / 2, "pose": pose}
    scene = {"camera": camera, "environment": {"texture": texture}, "nodes": []}
    return studio.draw(scene, (SIDE, SIDE), 2)[..., :3]


def lightness(pixels: np.ndarray, row: int, column: int) -> float:
    """Of the darkest pixel near by; there is blue text as well, which is not dark."""
    return float(pixels[row - 2 : row + 3, column - 2 : column + 3].max(axis=-1).min())


def darkness(seen: np.ndarray, forward: np.ndarray, towards: np.ndarray) -> float:
    """How dark a line from the middle of a view towards an axis is: the median along it.

    The eye's right is forward x up, in a right-handed world; lines are some three pixels wide.
    """
    right, up = np.cross(forward, AXES["Y"]), AXES["Y"]
    found = []
    for slope in np.linspace(0.06, 0.3, 25):
        x, y = slope * (towards @ right), slope * (towards @ up)
        column, row = round((x + 1) / 2 * SIDE - 0.5), round((1 - y) / 2 * SIDE - 0.5)
        found.append(lightness(seen, row, column))
    return 1 - float(np.median(found))


@pytest.mark.gl
@pytest.mark.parametrize("face", ["+X", "-X", "+Z", "-Z"])
def test_t21_ilms_axes_are_drawn_where_the_world_has_them(
    studio: Studio, corpus: Path, face: str
) -> None:
    # The picture names the direction in the middle of each view, and draws the other two axes
    # from there: a mirror or another roll of the picture would turn a line to where none is.
    texture = studio.texture(picture(corpus / "2_envmaps/openexr/OrientationLatLong.exr"))
    forward = (1 if face[0] == "+" else -1) * AXES[face[1]]
    level = "Z" if face[1] == "X" else "X"

    seen = looking(studio, texture, forward)

    drawn = {
        (name, sign): darkness(seen, forward, sign * AXES[name])
        for name in ("Y", level)
        for sign in (1, -1)
    }
    assert min(drawn["Y", 1], drawn[level, 1]) > 0.5
    assert max(drawn["Y", -1], drawn[level, -1]) < 0.3


def test_t21_in_the_bare_file_x_is_a_quarter_from_the_left(corpus: Path) -> None:
    pixels = picture(corpus / "2_envmaps/openexr/OrientationLatLong.exr")
    layout = LatlongSpec(technique="latlong")
    height, width, _ = pixels.shape

    def drawn(forward: np.ndarray, towards: np.ndarray) -> float:
        way = forward + np.linspace(0.06, 0.3, 25)[:, None] * towards
        at = (layouts.place(layout, way) * [width, -height] + [0, height]).astype(int)
        return 1 - float(np.median([lightness(pixels, row, column) for column, row in at]))

    np.testing.assert_allclose(layouts.place(layout, AXES["X"][None]), [[0.25, 0.5]], atol=1e-12)
    for face, level in (("X", "Z"), ("Z", "X")):
        assert drawn(AXES[face], AXES[level]) > 0.6 > 0.5 > drawn(AXES[face], -AXES[level])
        assert drawn(AXES[face], AXES["Y"]) > 0.6 > 0.5 > drawn(AXES[face], -AXES["Y"])
    assert drawn(-AXES["X"], AXES["Z"]) > 0.6 > 0.5 > drawn(-AXES["X"], -AXES["Z"])


def faces_of(folder: Path) -> dict[str, Image]:
    found = {
        name: image_io.read(folder / f"{name}.jpg", "srgb", "colour")
        for name in PHOTOGRAPHS
        if (folder / f"{name}.jpg").is_file()
    }
    return found | {"bottom": Image(np.zeros((512, 512, 3), np.float32), "colour")}


def test_t08_photographs_of_an_evening_join_at_their_edges(corpus: Path) -> None:
    # Five photographs and none of the ground, which whoever sends them is told to add.
    inputs = faces_of(corpus / "2_envmaps/three-d/skybox_evening")
    names = {name: {"technique": "checkerboard"} for name in inputs}
    spec = TypeAdapter(Texture).validate_python({"technique": "six_faces", **names})
    pixels = six_faces.synthesize(spec, (512, 3072), inputs, silent).pixels
    sides = [
        np.array(axis, float) * sign
        for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        for sign in (1, -1)
        if (axis, sign) != ((0, 1, 0), -1)
    ]

    def read(directions: np.ndarray) -> np.ndarray:
        u, v = layouts.place(spec.layout, directions).T
        return pixels[((1 - v) * 3072).astype(int), (u * 512).astype(int)]

    along = (np.arange(512) + 0.5) / 256 - 1
    steps = []
    for first in sides:
        for second in sides:
            if first @ second == 0:
                edge = along[:, None] * np.cross(first, second)
                near = 1 - 1 / 512
                this, other = first + near * second + edge, near * first + second + edge
                error = read(this) - read(other)
                steps.append(np.sqrt((error**2).mean()))

    assert len(steps) == 16
    # Of eight bits and two compressed pictures; the right one and the back one met less well
    assert np.median(steps) < 0.01
    assert max(steps) < 0.035


def test_halved_edge_texels_are_those_of_openexr(corpus: Path, tmp_path: Path) -> None:
    # The cube was made of the same lines, and its texels are halved by the edges of faces as well
    files = {
        name: corpus / f"2_envmaps/openexr/WavyLines{name}.exr" for name in ("LatLong", "Cube")
    }
    ids = {name: str(index) * 64 for index, name in enumerate(files)}
    for name, file in files.items():
        (tmp_path / ids[name][:2]).mkdir()
        (tmp_path / ids[name][:2] / ids[name]).write_bytes(file.read_bytes())
    pictures = UploadedPictures(tmp_path)

    def flat(edges: str) -> np.ndarray:
        spec = ImageSpec(technique="image", asset=ids["LatLong"], edge_texels=edges)
        return pictures.read(spec, "colour").pixels

    cube = picture(files["Cube"]).reshape(6, 256, 256, 3)
    s, t = np.meshgrid(*[2 * np.arange(16, 240) / 255 - 1] * 2)  # within the first face, +x
    towards = np.stack([np.ones_like(s), -t, s], axis=-1).reshape(-1, 3)
    u, v = layouts.place(LatlongSpec(technique="latlong"), towards).T
    errors = {}
    for edges in ("whole", "halved"):
        pixels = flat(edges)[..., 0]
        x, y = u * 1024 - 0.5, (1 - v) * 512 - 0.5
        left, top = np.floor(x).astype(int), np.floor(y).astype(int)
        across, down = x - left, y - top
        upper = (1 - across) * pixels[top, left] + across * pixels[top, left + 1]
        lower = (1 - across) * pixels[top + 1, left] + across * pixels[top + 1, left + 1]
        error = (1 - down) * upper + down * lower - cube[0, 16:240, 16:240, 0].ravel()
        errors[edges] = np.sqrt((error**2).mean())
    assert errors["halved"] < 0.7 * errors["whole"] < 0.035


@pytest.mark.gl
@pytest.mark.parametrize("layout", ["latlong", "cube"])
def test_show_2_wavy_lines_on_a_globe_are_ilms_own_picture_of_them(
    studio: Studio, corpus: Path, layout: str
) -> None:
    # The picture says of its camera only that it is outside. Found once by correlation, to 0.1
    # degrees: parallel rays, a ball of 9/10 of the height, these axes.
    right = np.array([-0.5, 0.5, math.sqrt(0.5)])
    tilt = math.radians(10)
    up = math.cos(tilt) * np.array([1, 1, 0]) / math.sqrt(2)
    up += math.sin(tilt) * np.array([0.5, -0.5, math.sqrt(0.5)])
    eye = 4 * np.cross(right, up)
    camera = {
        "type": "orthographic",
        "height": 2 / 0.9,
        "pose": {"eye": eye.tolist(), "target": [0.0, 0.0, 0.0], "up": up.tolist()},
    }
    name = {"latlong": "LatLong", "cube": "Cube"}[layout]
    pixels = picture(corpus / f"2_envmaps/openexr/WavyLines{name}.exr")
    if layout == "latlong":
        pixels = with_whole_edges(pixels)
    else:
        faces = pixels.reshape(6, 256, 256, 3)
        pixels = np.concatenate([with_whole_edges(face) for face in faces])
    ball = {"type": "sphere", "segments": 256, "rings": 128}
    color = {
        "texture": studio.texture(pixels),
        "coordinates": {"technique": "position"},
        "layout": {"technique": layout},
    }

    seen = shown(studio, ball, color, 480, camera=camera)[..., 0]

    wanted = picture(corpus / "2_envmaps/openexr/WavyLinesSphere.exr")[..., 0]
    place = (2 * np.arange(480) + 1) / 480 - 1
    on_it = np.hypot(*np.meshgrid(place, place)) < 0.9 * 0.95
    error = (seen - wanted)[on_it]
    # Lines of 0.1 to 1, four pixels wide, whose filter is not known; turned or mirrored, or read a
    # face wrong, the pictures have nothing in common.
    assert np.corrcoef(seen[on_it], wanted[on_it])[0, 1] > 0.97
    assert np.sqrt((error**2).mean()) < 0.06
    assert np.corrcoef(seen[:, ::-1][on_it], wanted[on_it])[0, 1] < 0.2
