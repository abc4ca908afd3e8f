"""Contours from a picture of one row (T13), and palettes of cartoons, on balls of known size."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SIDE = 512
AXIS = (np.arange(SIDE) + 0.5 - SIDE / 2) * 2 * np.tan(np.pi / 6) / SIDE
X, Y = np.meshgrid(AXIS, -AXIS)
RADIUS_OF_SILHOUETTE = 156.767343538  # pixels: R = 1, d = 3, 60 degrees over 512 (T13)


def ball(studio: Studio, coordinates, picture, lights=(), **mesh):
    """A unit ball seen from 3 away with a vertical angle of 60 degrees."""
    sphere = {"type": "sphere", "segments": 512, "rings": 256, **mesh}
    color = {
        "texture": picture,
        "coordinates": coordinates,
        "filter": "bilinear",
        "wrap": ["clamp", "clamp"],
    }
    scene = {
        "camera": {"type": "perspective", "fov_y": np.pi / 3, "pose": {"eye": [0.0, 0.0, 3.0]}},
        "lights": list(lights),
        "nodes": [{"mesh": sphere, "surface": {"technique": "unlit", "color": color}}],
    }
    return studio.draw(scene, (SIDE, SIDE))


def meeting():
    """Where rays through the middles of the pixels meet the ball: points, directions, mask."""
    rays = np.stack([X, Y, -np.ones_like(X)], axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    eye = np.array([0.0, 0.0, 3.0])
    along = rays @ -eye
    inside = along**2 - 8
    points = eye + rays * (along - np.sqrt(np.maximum(inside, 0)))[..., None]
    # Away from the rim, where the facets of the mesh are seen edge on
    return points, -rays, inside > 0.01


def ramp_along(studio, axis):
    """A picture whose texels are their own coordinate, so that reading it tells where."""
    values = (np.arange(256) + 0.5) / 256
    return studio.texture(np.tile(values, (2, 1)) if axis == "u" else values[::-1, None])


def test_t13_u_is_half_of_one_and_the_cosine(studio: Studio):
    drawn = ball(studio, {"technique": "facing"}, ramp_along(studio, "u"))[..., 0]
    points, towards_eye, inside = meeting()
    # Nothing can be read beyond the middle of the last texel.
    expected = np.minimum((1 + np.sum(points * towards_eye, axis=-1)) / 2, 1 - 0.5 / 256)
    # Of the facets: a chord of 2 pi / 512 lies 2e-5 below the ball, seen at a slant of 10.
    np.testing.assert_allclose(drawn[inside], expected[inside], atol=3e-4)


def test_a18_the_dark_band_is_a_ring_at_the_silhouette(studio: Studio):
    # Dark from 1/2 to 0.52: n.r < 0.04, which ends where the impact parameter is sqrt(1 - .04^2).
    row = np.ones(200)
    row[96:104] = 0.0
    drawn = ball(studio, {"technique": "facing"}, studio.texture(np.tile(row, (2, 1))))
    covered = drawn[..., 3] > 0.5
    # The radius from the area that is covered
    assert np.sqrt(covered.sum() / np.pi) == pytest.approx(RADIUS_OF_SILHOUETTE, abs=1)
    bright = drawn[..., 0] > 0.5
    impact = np.sqrt(1 - 0.04**2)
    inner = SIDE / 2 / np.tan(np.pi / 6) * impact / np.sqrt(9 - impact**2)
    assert np.sqrt(bright.sum() / np.pi) == pytest.approx(inner, abs=1)
    assert (covered & ~bright).sum() > 50


def test_t13_the_inside_lies_beyond_the_contour(studio: Studio):
    color = {
        "texture": ramp_along(studio, "u"),
        "coordinates": {"technique": "facing"},
        "wrap": ["clamp", "clamp"],
    }
    turned = {"rotation": [0.0, 1.0, 0.0, 0.0]}
    drawn = studio.poster({"technique": "unlit", "color": color}, transform=turned)
    # n.r = -1: u = 0, the first texel
    np.testing.assert_allclose(drawn[..., 0], 0.5 / 256, atol=1e-6)


LAMP = {"type": "directional", "direction": [-0.6, 0.0, -0.8]}


@pytest.mark.parametrize("detail", ["facing", "highlight", "distance"])
def test_toon_reads_tone_and_detail(studio: Studio, detail):
    coordinates = {"technique": "toon", "detail": detail, "power": 2.0, "near": 2.0, "far": 3.0}
    tone = ball(studio, coordinates, ramp_along(studio, "u"), [LAMP])[..., 0]
    row = ball(studio, coordinates, ramp_along(studio, "v"), [LAMP])[..., 0]
    normals, towards_eye, inside = meeting()
    lamp = np.array([0.6, 0.0, 0.8])
    facing = np.maximum(normals @ lamp, 0)
    inside &= facing > 0.05
    if detail == "distance":
        far = np.linalg.norm(normals - [0.0, 0.0, 3.0], axis=-1)
        expected = 1 - np.log(far / 2) / np.log(1.5)
    else:
        mirrored = 2 * facing[..., None] * normals - lamp
        axis = normals if detail == "facing" else mirrored
        expected = np.clip(np.sum(axis * towards_eye, axis=-1), 0, 1) ** 2
    # Half a texel at either end cannot be read between
    np.testing.assert_allclose(tone[inside], np.clip(facing, 0.002, 0.998)[inside], atol=6e-4)
    np.testing.assert_allclose(row[inside], np.clip(expected, 0.002, 0.998)[inside], atol=2e-3)


@pytest.mark.parametrize("filter_name", ["nearest", "bilinear", "trilinear", "anisotropic", "ewa"])
@pytest.mark.parametrize("shape", [(1, 1), (1, 2)])
def test_a_picture_of_one_row_may_be_as_short_as_one_texel(studio: Studio, shape, filter_name):
    # It has one value everywhere; there is nothing to divide by the room between texels
    color = {
        "texture": studio.texture(np.full((*shape, 3), 0.4)),
        "coordinates": {"technique": "facing"},
        "filter": filter_name,
        "wrap": ["clamp", "clamp"],
    }
    drawn = studio.poster({"technique": "unlit", "color": color}, (8, 8))
    np.testing.assert_allclose(drawn[..., :3], 0.4, rtol=1e-6)
