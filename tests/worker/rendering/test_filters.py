"""How many texels become one pixel."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio
from worker.images.pyramids import mip_chain

pytestmark = pytest.mark.gl


@pytest.fixture
def level_coded(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> dict[str, object]:
    """A 256 x 256 texture whose every texel is the number of its level."""
    from worker.images import stored_form  # noqa: PLC0415

    def numbered(pixels: np.ndarray) -> list[np.ndarray]:
        return [np.full_like(level, number) for number, level in enumerate(mip_chain(pixels))]

    monkeypatch.setattr(stored_form, "mip_chain", numbered)
    return studio.texture(np.full((256, 256), -1.0))


def level_read(
    studio: Studio, picture: dict[str, object], jacobian: np.ndarray, filter_name: str
) -> np.ndarray:
    """The level at the middle of a poster on which one pixel spans `jacobian` texels."""
    # uv = (object + 1) / 2 and a pixel is 2 / 64 wide, so the texels per pixel are 4 inv(A).
    matrix = np.eye(4)
    matrix[:2, :2] = 4 * np.linalg.inv(jacobian)
    drawn = studio.poster(
        {"technique": "unlit", "color": {"texture": picture, "filter": filter_name}},
        (64, 64),
        transform={"matrix": matrix.T.ravel().tolist()},
    )
    return drawn[31:33, 31:33, 0]


@pytest.mark.parametrize(
    ("jacobian", "expected"),
    [([[8, 0], [0, 2]], 3.0), ([[3, 1], [4, 0]], 2.321928095), ([[0, 8], [5, 0]], 3.0)],
)
def test_lambda_of_the_reference(
    studio: Studio, level_coded: dict[str, object], jacobian: list[list[float]], expected: float
) -> None:
    # T41: derivatives (8,0),(0,2) give 3; (3,4),(1,0) give log2 5
    level = level_read(studio, level_coded, np.array(jacobian, dtype=float), "trilinear")

    np.testing.assert_allclose(level, expected, atol=1e-5)


def test_lambda_of_any_footprint(studio: Studio, level_coded: dict[str, object]) -> None:
    random = np.random.default_rng(5)
    for _ in range(12):
        turn, _ = np.linalg.qr(random.normal(size=(2, 2)))
        jacobian = turn * 2 ** random.uniform(0.1, 4, 2)
        expected = np.log2(np.linalg.norm(jacobian, axis=0).max())

        level = level_read(studio, level_coded, jacobian, "trilinear")

        np.testing.assert_allclose(level, expected, atol=1e-4)


@pytest.mark.parametrize("up", [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], ids=["below", "to the right"])
def test_lambda_at_every_pixel_of_a_floor(
    studio: Studio, level_coded: dict[str, object], up: list[float]
) -> None:
    # On the floor y = -1 seen at focal length f: z = f / y, and by the quotient rule
    # |dP/dx| = z / f, |dP/dy| = z hypot(1, x / f) / y, in units that are 256 * 0.1 texels long.
    side, focal = 256, 128 / np.tan(0.5)
    drawn = studio.draw(
        {
            "camera": {
                "type": "perspective",
                "fov_y": 1.0,
                "pose": {"eye": [0.0, 1.0, 0.0], "target": [0.0, 1.0, -1.0], "up": up},
            },
            "nodes": [
                {
                    "mesh": {"type": "plane", "facing": "+y", "width": 200.0, "height": 200.0},
                    "surface": {
                        "technique": "unlit",
                        "color": {
                            "texture": level_coded,
                            "filter": "trilinear",
                            "transform": {"scale": [20.0, 20.0]},
                        },
                    },
                }
            ],
        },
        (side, side),
    )
    y, x = np.mgrid[3:128, 0:256] + 0.5
    x -= side / 2
    z = focal / y
    reach = np.maximum(z / focal, z * np.hypot(1, x / focal) / y) * 25.6

    expected = np.clip(np.log2(reach), 0, 8)

    levels = drawn[..., 0] if up[1] else drawn[..., 0].T
    np.testing.assert_allclose(levels[131:], expected, atol=1e-3)


def test_anisotropy_reads_the_level_of_the_shorter_axis(
    studio: Studio, level_coded: dict[str, object]
) -> None:
    # Half a level finer than log2 of the shorter axis, however the footprint is turned.
    for angle in np.linspace(0, np.pi, 7):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        jacobian = turn @ np.diag([16.0, 4.0]) @ turn.T

        level = level_read(studio, level_coded, jacobian, "anisotropic")

        np.testing.assert_allclose(level, 1.5, atol=1e-4)


def test_a_mean_is_kept_by_every_filter_with_levels(studio: Studio) -> None:
    picture = studio.texture(np.random.default_rng(6).random((64, 64)).round())
    mean = float(studio.array(picture).mean())

    for filter_name in ("trilinear", "anisotropic"):
        read = studio.poster(
            {
                "technique": "unlit",
                "color": {
                    "texture": picture,
                    "filter": filter_name,
                    "transform": {"scale": [64.0, 64.0]},
                },
            },
            (16, 16),
        )
        # 256 texels per pixel: the coarsest level, one texel.
        np.testing.assert_allclose(read[..., 0], mean, rtol=1e-6)


def test_a_round_footprint_reads_what_is_there(studio: Studio) -> None:
    # However it lies to the pixels: neither axis is the longer one, but by the last bit.
    white = studio.texture(np.ones((64, 64)))
    rng = np.random.default_rng(1)
    for scale, turn in zip(rng.uniform(1.5, 4, 60), rng.integers(0, 24, 60), strict=True):
        mapped = {
            "texture": white,
            "filter": "anisotropic",
            "transform": {"scale": [scale, scale], "rotation": turn * np.pi / 12},
        }

        drawn = studio.poster({"technique": "unlit", "color": mapped}, (64, 64))

        assert (drawn[..., 0] == 1).all(), (scale, turn)
