"""What image_quilting and graph_cut share: squares turned and mirrored, and where they fit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.growing import TEXTURE, grow, noise, sources, upload
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.placing import Placing
from worker.synthesis.by_example.views import Views, turned, turned_normals

SEWN = ("image_quilting", "graph_cut")
ARROW = np.array([[1, 2, 3], [4, 5, 6]])


def exemplar_of(pixels):
    return Exemplar.of({"exemplar": Image(np.asarray(pixels, np.float32), "data")})


@pytest.mark.parametrize(
    ("view", "shown"),
    [
        (0, [[1, 2, 3], [4, 5, 6]]),
        (1, [[3, 6], [2, 5], [1, 4]]),
        (2, [[6, 5, 4], [3, 2, 1]]),
        (3, [[4, 1], [5, 2], [6, 3]]),
        (4, [[3, 2, 1], [6, 5, 4]]),
        (5, [[1, 4], [2, 5], [3, 6]]),
    ],
)
def test_a_view_is_mirrored_then_turned_anticlockwise(view, shown):
    assert turned(ARROW, view).tolist() == shown


@pytest.mark.parametrize("view", range(8))
def test_normals_of_a_turned_relief_are_its_normals_turned(view):
    # A relief with no symmetry; its slopes by differences, rows run down and y up
    rows, columns = np.indices((20, 20)) / 20
    relief = np.sin(3 * columns) + columns * rows**2 + 0.3 * rows

    def normals(height):
        return np.stack(
            [-np.gradient(height, axis=1), np.gradient(height, axis=0), np.ones(height.shape)],
            axis=-1,
        )

    found = turned_normals(turned(normals(relief), view), np.full((20, 20), view))

    assert found == pytest.approx(normals(turned(relief, view)), abs=1e-12)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 5), st.floats(0, 0.999))
def test_the_square_that_fits_best_is_found(seed, side, chance):
    random = np.random.default_rng(seed)
    exemplar = exemplar_of(random.random((11, 9, 2)))
    views = Views.of(exemplar, turns=True, flips=True)
    old = random.integers(0, 256, (side, side, 2))
    over = random.random((side, side)) < 0.5

    view, row, column = Placing(views, side).chosen(old, over, 0.0, chance)

    costs = {}
    for name in range(8):
        shown = turned(exemplar.features, name).astype(int)
        for v, u in np.ndindex(shown.shape[0] - side + 1, shown.shape[1] - side + 1):
            apart = shown[v : v + side, u : u + side] - old
            costs[name, v, u] = (apart[over] ** 2).sum()
    assert costs[view, row, column] == min(costs.values())


@pytest.mark.parametrize("technique", SEWN)
def test_squares_are_used_in_all_ways_that_are_allowed_and_no_others(technique):
    exemplar = noise(30, 40)
    allowed = {
        (False, False): {0}, (True, False): {0, 1, 2, 3}, (False, True): {0, 4},
        (True, True): set(range(8)),
    }  # fmt: skip

    for (turns, flips), ways in allowed.items():
        made = grow(technique, exemplar, (60, 60), block=12, turns=turns, flips=flips, tolerance=2)

        found = set(made.layers["turn"].pixels.ravel())
        assert found <= ways
        assert len(found) >= 0.75 * len(ways)
        assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


@pytest.mark.parametrize("technique", SEWN)
def test_a_mask_that_leaves_single_pixels_of_a_large_picture_is_refused(technique):
    mask = np.indices((8, 8)).sum(axis=0)[..., np.newaxis] % 2

    with pytest.raises(RenderError, match="squares of 1 x 1") as caught:
        grow(technique, noise(8, 8), (1024, 1024), exemplar_mask=mask)

    assert caught.value.code == "exemplar_unusable"


@pytest.mark.parametrize("technique", SEWN)
def test_an_exemplar_that_is_one_thin_line_costs_more_than_a_square_one(technique):
    spec = TEXTURE.validate_python({"technique": technique, "exemplar": upload(0)})

    thin, square = (spec.cost_at({"exemplar": size}, 1) for size in ((4096, 1), (64, 64)))

    assert thin.seconds > 50 * square.seconds


@pytest.mark.parametrize("technique", SEWN)
def test_neighbours_in_a_turned_square_are_neighbours_in_the_exemplar(technique):
    exemplar = noise(40, 40)

    made = grow(technique, exemplar, (60, 60), block=20, turns=True, flips=True)

    rows, columns = sources(made, exemplar)
    views = made.layers["turn"].pixels[..., 0].astype(int)
    # Where one goes to the right in a square, a step in the exemplar goes there
    steps = {0: (0, 1), 1: (1, 0), 2: (0, -1), 3: (-1, 0)}
    mirrored = {0: (0, -1), 1: (1, 0), 2: (0, 1), 3: (-1, 0)}
    agree = 0
    for view, step in {**steps, **{k + 4: v for k, v in mirrored.items()}}.items():
        here = (views[:, :-1] == view) & (views[:, 1:] == view)
        moved = (np.diff(rows, axis=1) == step[0]) & (np.diff(columns, axis=1) == step[1])
        agree += (here & moved).sum()
    # All but those across seams: squares of 20 leave at most one in five of them
    assert agree > 0.8 * views[:, 1:].size
