"""Copies that are too long, and that grown textures have none."""

import numpy as np
import pytest

from tests.growing import grow, noise, sources
from worker.synthesis.by_example.copies import continued, copied_so_far
from worker.synthesis.by_example.filling import unmoved
from worker.synthesis.by_example.long_copies import late


def test_what_comes_after_the_longest_line_is_late():
    found = late(unmoved((5, 9)), (5, 6), wraps=False)

    assert (found == (np.arange(9) >= 6)).all()
    assert late(unmoved((5, 9)), (3, 9), wraps=False).sum() == 2 * 9


def test_a_line_ends_where_the_source_jumps():
    place = unmoved((4, 12))
    place[:, 6:, 1] += 1

    assert not late(place, (4, 6), wraps=False).any()
    assert late(place, (4, 5), wraps=False).sum() == 2 * 4


def test_lines_go_on_around_the_edges_where_it_wraps():
    # Twelve columns of a source, begun in the middle: each row is one line around the edge
    place = np.roll(unmoved((3, 12)), 5, axis=1)

    assert not late(place, (3, 11), wraps=False).any()
    assert late(place, (3, 11), wraps=True).sum() == 3


@pytest.mark.parametrize("tileable", [True, False])
@pytest.mark.parametrize("shape", [(64, 64), (40, 90)])
def test_no_line_longer_than_half_the_exemplar_is_copied(shape, tileable):
    # Of noise, the exemplar itself is what fits best by far
    exemplar = noise(*shape)

    made = grow("texture_optimization", exemplar, (160, 130), tileable=tileable, seed=1)

    place = np.stack(sources(made, exemplar), axis=-1)
    across, down = continued(place)
    assert copied_so_far(across).max() <= shape[1] / 2
    assert copied_so_far(down.T).max() <= shape[0] / 2
