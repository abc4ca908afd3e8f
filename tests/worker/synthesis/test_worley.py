"""Cell noise against all distances, and against what chance theory expects of Poisson points."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.textures.worley import WorleySpec
from worker.stages import silent
from worker.synthesis.worley import (
    distances,
    distances_at,
    scatter,
    synthesize,
    synthesize_volume,
)

METRICS = ["euclidean", "manhattan", "chebyshev"]
ORDERS = {"euclidean": 2, "manhattan": 1, "chebyshev": np.inf}


def spec(**fields):
    return WorleySpec(technique="worley", **fields)


def picture(size, **fields):
    return synthesize(spec(**fields), size, {}, silent).pixels[..., 0]


def solid(size, **fields):
    return synthesize_volume(spec(**fields), size, {}, silent).voxels[..., 0]


def all_distances(worley, size, copies):
    """Every pixel's or voxel's distances to the points of the tile and of its copies, sorted."""
    axes, side = len(size), worley.frequency
    points = scatter(worley, axes)
    cells = np.repeat(np.arange(side**axes), np.diff(points.starts))
    corners = np.stack([cells // side**axis % side for axis in range(axes)], axis=-1)
    shifts = np.arange(-copies, copies + 1) * side
    tiles = np.stack(np.meshgrid(*[shifts] * axes), axis=-1).reshape(-1, 1, axes)
    places = (tiles + corners + points.places[:, :axes]).reshape(-1, axes)
    centres = [(np.arange(count) + 0.5) / count for count in size]
    centres[1] = centres[1][::-1]
    pixels = side * np.stack(np.meshgrid(*centres[::-1], indexing="ij")[::-1], axis=-1)
    apart = pixels[..., np.newaxis, :] - places
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


@pytest.mark.parametrize("metric", METRICS)
@pytest.mark.parametrize("points", ["one", "poisson"])
def test_a_voxel_is_the_smallest_of_all_distances_in_space(points, metric):
    worley = spec(frequency=2, points=points, metric=metric, seed=3)
    expected = all_distances(worley, (5, 4, 3), copies=2)

    for nth, output in enumerate(("f1", "f2")):
        found = solid(
            (5, 4, 3), **worley.model_dump(exclude={"technique", "output"}), output=output
        )
        assert found == pytest.approx(expected[..., nth], abs=1e-6)


def test_points_of_the_plane_and_of_space_are_what_grids_show():
    for axes, made in ((2, picture), (3, solid)):
        size = (6, 5, 4)[:axes]
        fields = {"frequency": 3, "points": "poisson", "output": "difference", "seed": 8}
        centres = [(np.arange(count) + 0.5) / count for count in size]
        centres[1] = centres[1][::-1]
        places = np.stack(np.meshgrid(*centres[::-1], indexing="ij")[::-1], axis=-1)

        found = distances_at(spec(**fields), places.reshape(-1, axes) - 2)

        assert found == pytest.approx(made(size, **fields).ravel(), abs=1e-6)


def test_poisson_points_in_space_are_as_far_as_chance_theory_says():
    nearest = solid((64, 64, 64), frequency=32, points="poisson", seed=7)

    # Gamma(4/3) (4 pi / 3)^(-1/3) (X08); about 32768 independent cells deviating by .2
    assert nearest.mean(dtype=np.float64) == pytest.approx(0.553960278, abs=0.005)


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

    pixels = distances(worley, [np.arange(2 * width), np.arange(3 * height)], (width, height))

    tile = pixels[:height, :width].tobytes()
    for up in range(3):
        for across in range(2):
            copy = pixels[up * height : (up + 1) * height, across * width :][:, :width]
            assert copy.tobytes() == tile


def test_pixels_do_not_depend_on_the_number_of_threads(with_threads):
    one = with_threads(1, lambda: picture((300, 200), frequency=20))
    two = with_threads(2, lambda: picture((300, 200), frequency=20))

    assert one.tobytes() == two.tobytes()
