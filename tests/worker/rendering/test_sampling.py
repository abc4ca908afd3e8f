"""How one texture is read: against bilinear interpolation written out in numpy."""

import numpy as np
import pytest

from tests.worker.rendering.studio import Studio

pytestmark = pytest.mark.gl

SMOOTH = ("bilinear", "trilinear", "anisotropic")
WRAPS = ("repeat", "mirror", "clamp", "border")
BORDER = [0.25, -2.0, 7.5, 1.0]


def texel_index(wrap: str, index: np.ndarray, length: int) -> np.ndarray:
    """The texel an index means; -1 is the border."""
    match wrap:
        case "repeat":
            return index % length
        case "mirror":
            folded = index % (2 * length)
            return np.where(folded < length, folded, 2 * length - 1 - folded)
        case "clamp":
            return np.clip(index, 0, length - 1)
    return np.where((index < 0) | (index >= length), -1, index)


def bilinear(array: np.ndarray, u: np.ndarray, v: np.ndarray, wrap: tuple[str, str]) -> np.ndarray:
    """x = u W - 1/2, the four neighbours each wrapped; v is up, row 0 is the top."""
    height, width, _ = array.shape
    x, y = u * width - 0.5, v * height - 0.5
    left, low = np.floor(x).astype(int), np.floor(y).astype(int)
    total = 0
    for i, across in ((0, 1 - (x - left)), (1, x - left)):
        for j, up in ((0, 1 - (y - low)), (1, y - low)):
            column = texel_index(wrap[0], left + i, width)
            row = texel_index(wrap[1], low + j, height)
            texel = array[height - 1 - np.maximum(row, 0), column]
            outside = (column < 0) | (row < 0)
            texel = np.where(outside[..., None], BORDER[: array.shape[2]], texel)
            total = total + texel * (across * up)[..., None]
    return np.asarray(total)


@pytest.mark.parametrize("filter_name", SMOOTH)
def test_bilinear_values_of_the_reference(studio: Studio, filter_name: str) -> None:
    # T42: [[0, 1], [2, 4]] with the first row at v = 1/4; arithmetic in float32
    picture = studio.texture([[2, 4], [0, 1]])

    values = [
        studio.read(picture, u, v, filter=filter_name)[0]
        for u, v in [(0.5, 0.5), (0.25, 0.25), (0.9, 0.3)]
    ]

    np.testing.assert_allclose(values, [1.75, 0, 0.97], rtol=3e-7)


def test_nearest_reads_the_covering_texel(studio: Studio) -> None:
    picture = studio.texture([[2, 4], [0, 1]])

    values = [
        studio.read(picture, u, v, filter="nearest")[0]
        for u, v in [(0.49, 0.01), (0.51, 0.49), (0.1, 0.51), (0.99, 0.99), (-0.01, 1.01)]
    ]

    assert values == [0, 1, 2, 4, 1]


def test_minus_a_quarter_is_three_quarters(studio: Studio) -> None:
    # T17
    picture = studio.texture(np.random.default_rng(0).random((5, 7, 3)))

    np.testing.assert_array_equal(
        studio.read(picture, -0.25, 0.375), studio.read(picture, 0.75, 0.375)
    )


@pytest.mark.parametrize("tiles", [-3, 1, 1000, 10**6 - 1])
def test_whole_tiles_do_not_change_a_bit(studio: Studio, tiles: int) -> None:
    # T17: u a multiple of 2^-20. The sum is exact in float64, in which the offset is reduced.
    picture = studio.texture(np.random.default_rng(1).random((6, 5, 3)))
    u = 715827 / 2**20

    np.testing.assert_array_equal(
        studio.read(picture, u + tiles, 0.4, wrap=["repeat", "repeat"]),
        studio.read(picture, u, 0.4, wrap=["repeat", "repeat"]),
    )


def test_half_a_million_tiles_away_a_large_picture_is_still_read(studio: Studio) -> None:
    # 499999.25 tiles of 8192 texels are more texels than a 32-bit integer counts.
    picture = studio.texture(np.arange(8192, dtype=np.float32)[None, :])

    drawn = studio.poster(
        {
            "technique": "unlit",
            "color": {
                "texture": picture,
                "filter": "nearest",
                "transform": {"scale": [999998.5, 1.0]},
            },
        },
        (1, 1),
    )

    assert drawn[0, 0, 0] == 2048


@pytest.mark.parametrize("wrap_u", WRAPS)
@pytest.mark.parametrize("wrap_v", WRAPS)
@pytest.mark.parametrize("shape", [(4, 8, 3), (5, 3, 4), (1, 1, 3)], ids=str)
def test_every_wrap_against_numpy(
    studio: Studio, wrap_u: str, wrap_v: str, shape: tuple[int, int, int]
) -> None:
    array = np.random.default_rng(2).random(shape).astype(np.float32)
    if shape[2] == 4:
        array[..., 3] = 1
    side = 53
    place = (np.arange(side) + 0.5) / side * 6 - 2.5
    u, v = np.meshgrid(place, place[::-1])

    drawn = studio.poster(
        {
            "technique": "unlit",
            "color": {
                "texture": studio.texture(array),
                "filter": "bilinear",
                "wrap": [wrap_u, wrap_v],
                "border_color": BORDER,
                "transform": {"scale": [6.0, 6.0], "offset": [-2.5, -2.5]},
            },
        },
        (side, side),
    )

    expected = bilinear(array.astype(np.float64), u, v, (wrap_u, wrap_v))[..., :3]
    # u has errors of a few 2^-24 of its range 6, times 8 texels, times texel differences up to 10.
    np.testing.assert_allclose(drawn[..., :3], expected, atol=2e-4)


@pytest.mark.parametrize("wrap", WRAPS)
def test_smaller_levels_wrap_like_the_first(studio: Studio, wrap: str) -> None:
    # A row of 64 texels whose means over four are again a picture, read at lambda = 2 exactly.
    row = np.random.default_rng(3).random(16).astype(np.float32)
    fine = np.repeat(row, 4)[None, :, None].repeat(64, axis=0)
    side = 48  # pixels for 3 tiles of 64 texels: four texels per pixel

    drawn = studio.poster(
        {
            "technique": "unlit",
            "color": {
                "texture": studio.texture(fine),
                "filter": "trilinear",
                "wrap": [wrap, "repeat"],
                "border_color": BORDER,
                "transform": {"scale": [3.0, 3.0], "offset": [-1.0, 0.0]},
            },
        },
        (side, side),
    )

    u = (np.arange(side) + 0.5) / side * 3 - 1
    expected = bilinear(row[None, :, None].astype(float), u, u * 0 + 0.5, (wrap, "clamp"))
    np.testing.assert_allclose(drawn[7, :, 0], expected[:, 0], atol=1e-4)


def test_a_two_texel_8_bit_ramp_has_more_than_500_values_on_512_pixels(studio: Studio) -> None:
    ramp = studio.texture(np.array([[10, 245]]) / 255)

    drawn = studio.poster(
        {
            "technique": "unlit",
            "color": {"texture": ramp, "wrap": ["clamp", "clamp"], "transform": RAMP_ONLY},
        },
        (512, 1),
    )

    assert len(np.unique(drawn[0, :, 0])) >= 500


RAMP_ONLY = {"scale": [0.5, 1.0], "offset": [0.25, 0.0]}  # between the two texels' centres


@pytest.mark.parametrize(
    ("channels", "expected"),
    [(1, (0.1, 0.1, 0.1)), (2, (0.1, 0.1, 0.1)), (3, (0.1, 0.2, 0.3)), (4, (0.1, 0.2, 0.3))],
)
def test_grey_pictures_read_as_three_equal_channels(
    studio: Studio, channels: int, expected: tuple[float, ...]
) -> None:
    array = np.tile(np.float32([0.1, 0.2, 0.3, 1.0])[:channels], (2, 2, 1))

    read = studio.read(studio.texture(array), 0.3, 0.3)

    np.testing.assert_array_equal(read[:3], np.float32(expected))


@pytest.mark.parametrize(("channel", "expected"), [("r", 0.1), ("g", 0.2), ("b", 0.3), ("a", 0.4)])
def test_a_number_map_reads_its_channel_alone(
    studio: Studio, channel: str, expected: float
) -> None:
    texel = np.full(4, np.inf, dtype=np.float32)
    texel["rgba".index(channel)] = expected

    drawn = studio.poster(
        {
            "technique": "phong",
            "ambient_color": [1.0, 1.0, 1.0],
            "ambient_weight": {
                "texture": studio.texture(texel[None, None]),
                "channel": channel,
                "scale": 2.0,
                "bias": -0.125,
            },
        },
        lights=[{"type": "ambient", "radiance": [1.0, 1.0, 1.0]}],
    )

    assert (drawn[..., 0] == np.float32(expected) * 2 - np.float32(0.125)).all()


def test_values_far_above_one_and_below_zero_are_kept(studio: Studio) -> None:
    picture = studio.texture(np.float32([[[1e6, -3.5, 4.0]]]))

    np.testing.assert_array_equal(studio.read(picture, 0.5, 0.5)[:3], np.float32([1e6, -3.5, 4]))
