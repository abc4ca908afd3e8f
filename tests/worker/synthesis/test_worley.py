"""Cell noise against all distances, and against what chance theory expects of Poisson points."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.worley import WorleySpec
from worker.stages import silent
from worker.synthesis.worley import distances, scatter, synthesize

METRICS = ["euclidean", "manhattan", "chebyshev"]
ORDERS = {"euclidean": 2, "manhattan": 1, "chebyshev": np.inf}


def spec(**fields):
    return WorleySpec(technique="worley", **fields)


def picture(size, **fields):
    return synthesize(spec(**fields), size, {}, silent).pixels[..., 0]


def all_distances(worley, size, copies):
    """Every pixel's distances to the points of the tile and of its copies, sorted."""
    points = scatter(worley)
    cells = np.repeat(np.arange(worley.frequency**2), np.diff(points.starts))
    corners = np.stack([cells % worley.frequency, cells // worley.frequency], axis=-1)
    shifts = np.arange(-copies, copies + 1) * worley.frequency
    tiles = np.stack(np.meshgrid(shifts, shifts), axis=-1).reshape(-1, 1, 2)
    places = (tiles + corners + points.places).reshape(-1, 2)
    width, height = size
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height)
    pixels = worley.frequency * np.stack([u, v], axis=-1)
    apart = pixels[:, :, np.newaxis] - places
    return np.sort(np.linalg.norm(apart, ORDERS[worley.metric], axis=-1), axis=-1)


@given(
    st.tuples(st.integers(1, 12), st.integers(1, 12)),
    st.fixed_dictionaries(
        {
            "frequency": st.integers(1, 5),
            "points": st.sampled_from(["one", "poisson"]),
            "jitter": st.floats(0, 1),
            "metric": st.sampled_from(METRICS),
            "seed": st.integers(0, 2**32 - 1),
        }
    ),
)
def test_a_pixel_is_the_smallest_of_all_distances(size, fields):
    # A lone point's second nearest is its own copy in a neighbouring tile
    expected = all_distances(spec(**fields), size, copies=2)

    f1, f2, difference = (
        picture(size, **fields, output=output) for output in ("f1", "f2", "difference")
    )

    assert f1 == pytest.approx(expected[..., 0], abs=1e-6)
    assert f2 == pytest.approx(expected[..., 1], abs=1e-6)
    assert difference == pytest.approx(expected[..., 1] - expected[..., 0], abs=1e-6)


@pytest.mark.parametrize(
    ("metric", "f1", "f2"),
    [
        # A ball of radius r has area c r^2: E[F1] = sqrt(pi / c) / 2, E[F2] = 3/2 E[F1]
        ("euclidean", 0.5, 0.75),
        ("manhattan", 0.626657, 0.939986),
        ("chebyshev", 0.443113, 0.664670),
    ],
)
def test_poisson_points_are_as_far_as_chance_theory_says(metric, f1, f2):
    fields = {"frequency": 256, "points": "poisson", "metric": metric, "seed": 7}

    nearest = picture((1024, 1024), **fields)
    second = picture((1024, 1024), **fields, output="f2")

    # About 65536 independent cells, each deviating by .26 or .27: four standard errors are .0042
    assert nearest.mean(dtype=np.float64) == pytest.approx(f1, abs=0.006)
    assert second.mean(dtype=np.float64) == pytest.approx(f2, abs=0.006)
    assert (second >= nearest).all()


def test_poisson_counts_have_mean_and_variance_one():
    counts = np.diff(scatter(spec(frequency=512, points="poisson")).starts)

    # 262144 counts: four standard errors of the mean are .008, of the variance .014
    assert counts.mean() == pytest.approx(1, abs=0.008)
    assert counts.var() == pytest.approx(1, abs=0.014)


def test_a_tile_has_a_point_whatever_chance_says():
    for seed in range(20):
        assert scatter(spec(frequency=1, points="poisson", seed=seed)).starts[-1] >= 1


def test_points_without_jitter_are_the_middles_of_their_cells():
    pixels = picture((8, 8), frequency=2, jitter=0.0)

    # Pixel centres lie 1/8, 3/8 of a cell from the middle in both directions
    assert sorted(set(np.round(pixels.ravel() * 8, 4))) == pytest.approx(
        [2**0.5, 10**0.5, 18**0.5], abs=1e-4
    )


@pytest.mark.parametrize(("width", "height"), [(96, 64), (100, 37)])
@pytest.mark.parametrize("points", ["one", "poisson"])
def test_the_tile_repeats_bit_for_bit(width, height, points):
    worley = spec(frequency=7, points=points, output="difference", seed=5)

    pixels = distances(worley, np.arange(2 * width), width, np.arange(3 * height), height)

    tile = pixels[:height, :width].tobytes()
    for up in range(3):
        for across in range(2):
            copy = pixels[up * height : (up + 1) * height, across * width :][:, :width]
            assert copy.tobytes() == tile


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    one = with_threads(1, lambda: picture((300, 200), frequency=20))
    two = with_threads(2, lambda: picture((300, 200), frequency=20))

    assert one.tobytes() == two.tobytes()
