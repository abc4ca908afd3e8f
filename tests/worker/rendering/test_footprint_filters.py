"""T41: what EWA, ripmaps and summed areas read of a footprint."""

import itertools
from typing import Any

import numpy as np
import pytest

from tests.worker.rendering.glsl_probe import evaluate
from tests.worker.rendering.studio import Studio
from worker.geometry.mesh import Mesh, grid_triangles
from worker.images.ripmap import ripmap

pytestmark = pytest.mark.gl

WRAPS = ("repeat", "mirror", "clamp", "border")
BORDER = [0.3, -0.6, 0.1, 1.0]
SIDE = 4


def read(
    studio: Studio,
    picture: dict[str, Any],
    jacobian: Any,
    middle: tuple[float, float] = (0.5, 0.5),
    **how: Any,
) -> np.ndarray:
    """The colour of a pixel round `middle`, in tiles, that reaches J (1, 0) and J (0, 1) texels."""
    height, width = studio.array(picture).shape[:2]
    corners = np.array([[0, 0], [1, 0], [0, 1], [1, 1]], float)
    pixels = corners * SIDE - 1.5  # from the middle of the second pixel from the lower left
    uv = np.array(middle) + pixels @ np.array(jacobian, float).T / [width, height]
    positions = np.append(2 * corners - 1, np.zeros((4, 1)), axis=1)
    mesh = Mesh(positions, np.tile([0.0, 0.0, 1.0], (4, 1)), (uv,), grid_triangles(1, 1))
    drawn = studio.draw(
        {
            "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 2.0]}},
            "nodes": [
                {
                    "mesh": studio.mesh(mesh),
                    "surface": {"technique": "unlit", "color": {"texture": picture, **how}},
                }
            ],
        },
        (SIDE, SIDE),
    )
    return drawn[SIDE - 2, 1, :3]


def test_a15_the_ellipse_of_a_footprint(studio: Studio) -> None:
    # (ux, vx, uy, vy) = (8, 1, 0, 2), as REFERENCE has it; axes by its singular values.
    studio.poster({"technique": "unlit"})
    axes = np.linalg.svd([[8.0, 0.0], [1.0, 2.0]])

    ellipse = evaluate(
        "lib/sample_ewa.glsl",
        "vec4(e.a, e.b, e.c, e.f)",
        "Ellipse e = ellipse_of(vec2(8.0, 1.0), vec2(0.0, 2.0));",
    )
    found = evaluate(
        "lib/sample_ewa.glsl",
        "vec4(a.major, a.minor, a.along)",
        "Axes a = axes_of(vec2(8.0, 1.0), vec2(0.0, 2.0));",
    )

    assert ellipse.tolist() == [5.0, -16.0, 64.0, 256.0]
    np.testing.assert_allclose(found[:2], [8.06631908, 1.98355655], rtol=1e-6)
    along = axes.U[:, 0] * np.sign(axes.U[0, 0])
    np.testing.assert_allclose(found[2:] * np.sign(found[2]), along, atol=1e-6)


@pytest.mark.parametrize(
    "jacobian",
    [[[8, 0], [1, 2]], [[2, 0], [0, 9]], [[5, 5], [-4, 4]], [[3, 0], [0, 3]], [[7, 6], [6, 7]]],
    ids=str,
)
def test_ewa_spreads_as_far_as_the_ellipse(studio: Studio, jacobian: list[list[float]]) -> None:
    # Of exp(-2 r^2), cut at r = 1, each axis has the variance (1 - 3 e^-2) / (1 - e^-2) / 4 of its
    # squared semi-axis; a texel of level l adds 4^l / 12, for which the semi-axes are shorter.
    x, y = np.meshgrid(np.arange(256) - 128.0, np.arange(256)[::-1] - 128.0)
    picture = studio.texture(np.stack([x * x, x * y, y * y], axis=2))
    place = (128.5 / 256, 128.5 / 256)
    lengths = np.linalg.svd(np.array(jacobian, float)).S
    axes = np.array(jacobian, float) @ np.array(jacobian, float).T
    level = int(np.log2(max(lengths[1], lengths[0] / 16)))
    cut = (1 - 3 * np.exp(-2)) / (1 - np.exp(-2)) / 4
    spread = cut * (axes - np.eye(2) * 4**level / 3) + np.eye(2) * (4**level - 1) / 12

    found = read(studio, picture, jacobian, place, filter="ewa")

    # Few texels lie in an ellipse of few, and which of them do moves its moments by up to so much.
    expected = [spread[0, 0], spread[0, 1], spread[1, 1]]
    np.testing.assert_allclose(found, expected, atol=0.16 * lengths[0] ** 2 * cut)


def test_ewa_without_an_ellipse_is_trilinear(studio: Studio) -> None:
    picture = studio.texture(np.random.default_rng(3).random((32, 32, 3)))
    nothing, endless = np.zeros((2, 2)), np.full((2, 2), 1e30)
    for jacobian in (nothing, endless):
        ewa, trilinear = (
            read(studio, picture, jacobian, (0.3, 0.7), filter=name)
            for name in ("ewa", "trilinear")
        )

        np.testing.assert_array_equal(ewa, trilinear)


@pytest.mark.parametrize("size", [(64, 64), (1, 64), (64, 1), (33, 7), (1, 1)])
def test_footprints_without_area_give_numbers(studio: Studio, size: tuple[int, int]) -> None:
    picture = studio.texture(np.random.default_rng(3).random((*size, 3)))
    for filter_name, jacobian in itertools.product(
        ("ewa", "ripmap", "summed_area"),
        (
            [[9, 0], [0, 0]],
            [[0, 0], [0, 300]],
            [[5, 5], [5, 5]],
            [[1e7, 1], [1, 0]],
            [[0, 1e20], [0, 0]],
        ),
    ):
        found = read(studio, picture, jacobian, filter=filter_name)

        assert np.isfinite(found).all(), (filter_name, jacobian)
        assert (found > -1e-5).all()
        assert (found < 1 + 1e-5).all()


@pytest.mark.parametrize("filter_name", ["ewa", "ripmap", "summed_area"])
@pytest.mark.parametrize("wrap", WRAPS[:3])
def test_a_constant_picture_stays_what_it_is(studio: Studio, filter_name: str, wrap: str) -> None:
    picture = studio.texture(np.full((24, 40, 3), 0.3))
    for jacobian in ([[0.2, 0], [0, 0.3]], [[8, 1], [0, 2]], [[90, 3], [-5, 700]]):
        found = read(studio, picture, jacobian, (1.9, -0.4), filter=filter_name, wrap=[wrap] * 2)

        np.testing.assert_array_equal(found, np.float32(0.3))


def covered(low: float, high: float, count: int, wrap: str) -> np.ndarray:
    """How much of each texel, and then of the border, an interval of texels holds."""
    whole = np.arange(np.floor(low), np.ceil(high)).astype(int)
    parts = np.minimum(whole + 1, high) - np.maximum(whole, low)
    places = {
        "repeat": whole % count,
        "mirror": np.where(whole % (2 * count) < count, whole, -1 - whole) % count,
        "clamp": np.clip(whole, 0, count - 1),
        "border": np.where((whole >= 0) & (whole < count), whole, count),
    }[wrap]
    return np.bincount(places, parts, count + 1)


@pytest.mark.parametrize("wrap", list(itertools.product(WRAPS, WRAPS[:2])), ids=str)
def test_summed_areas_are_exact_for_upright_footprints(studio: Studio, wrap: list[str]) -> None:
    height, width = 19, 30
    pixels = np.random.default_rng(8).random((height, width, 3)).astype(np.float32)
    picture = studio.texture(pixels)
    bordered = np.zeros((height + 1, width + 1, 3))
    bordered[:] = BORDER[:3]
    bordered[:height, :width] = pixels[::-1]
    random = np.random.default_rng(9)
    for _ in range(6):
        reach = 2 ** random.uniform(0, 6.5, 2)
        middle = random.uniform(-1.5, 2.5, 2)
        texel = middle * [width, height]
        along_u = covered(*(texel[0] + reach[0] * np.array([-0.5, 0.5])), width, wrap[0])
        along_v = covered(*(texel[1] + reach[1] * np.array([-0.5, 0.5])), height, wrap[1])
        expected = np.einsum("y,x,yxc->c", along_v, along_u, bordered) / reach.prod()

        found = read(
            studio,
            picture,
            np.diag(reach),
            tuple(middle),
            filter="summed_area",
            wrap=list(wrap),
            border_color=BORDER,
        )

        # Coordinates of up to three tiles are good to 4e-7 of one, edges to 3e-5 of a texel.
        np.testing.assert_allclose(found, expected, atol=4e-5 / min(reach) + 2e-6)


def test_sums_of_a_large_picture_keep_their_digits(studio: Studio) -> None:
    # A white half and a black one: sums reach 2^17, and one float32 would be off by 2^-7 there.
    picture = studio.texture(np.repeat([1.0, 0.0], 512)[None, :] * np.ones((1024, 1)) * 0.9)
    for u, expected in ((300.5, 0.9), (511.5, 0.9), (512.5, 0.0), (512.0, 0.45)):
        place = (u / 1024, 700.5 / 1024)
        found = read(studio, picture, np.eye(2), place, filter="summed_area")

        np.testing.assert_allclose(found, expected, atol=1e-4)


def test_a_ripmap_of_256_squared_has_511_squared_texels() -> None:
    rows = ripmap(np.zeros((256, 256, 1), np.float32))

    assert sum(item.size for row in rows for item in row) == 261121


@pytest.mark.parametrize("halvings", [(0, 0), (1, 2), (3, 0), (0, 6), (3, 2)], ids=str)
def test_a_ripmap_reads_the_box_of_powers_of_two(studio: Studio, halvings: tuple[int, int]) -> None:
    pixels = np.random.default_rng(4).random((64, 64, 3)).astype(np.float32)
    picture = studio.texture(pixels)
    width, height = (2**power for power in halvings)
    box = pixels[::-1][:height, width : 2 * width].mean(axis=(0, 1), dtype=np.float64)
    place = (1.5 * width / 64, 0.5 * height / 64)

    found = read(studio, picture, np.diag([width, height]), place, filter="ripmap")

    np.testing.assert_allclose(found, box, atol=2e-5)


@pytest.mark.parametrize("wrap", list(itertools.product(WRAPS, WRAPS[1:3])), ids=str)
def test_a_small_footprint_reads_bilinear_beyond_every_edge(
    studio: Studio, wrap: tuple[str, str]
) -> None:
    picture = studio.texture(np.random.default_rng(5).random((6, 5, 3)))
    how = {"wrap": list(wrap), "border_color": BORDER}
    for place in itertools.product((-0.05, 0.02, 0.5, 0.99, 1.04, 1.7), (-0.4, 0.03, 0.96, 1.3)):
        bilinear, ripmap_read = (
            read(studio, picture, np.eye(2) * 0.1, place, filter=name, **how)
            for name in ("bilinear", "ripmap")
        )

        np.testing.assert_allclose(ripmap_read, bilinear, atol=1e-5)
