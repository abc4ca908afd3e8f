"""Pictures whose edges run through the middles of their outermost texels."""

import numpy as np
import pytest

from worker.images.edges import with_whole_edges


def test_a_linear_picture_is_read_where_its_texels_are_now() -> None:
    # Texel i of n stands for i / (n - 1), and afterwards for (i + 1/2) / n.
    rows, columns = np.arange(5) / 4, np.arange(9) / 8
    picture = np.stack(np.meshgrid(columns, rows), axis=-1).astype(np.float32)

    whole = with_whole_edges(picture)

    rows, columns = (np.arange(5) + 0.5) / 5, (np.arange(9) + 0.5) / 9
    np.testing.assert_allclose(whole, np.stack(np.meshgrid(columns, rows), axis=-1), atol=1e-7)


@pytest.mark.parametrize("shape", [(1, 1, 3), (1, 7, 1), (6, 1, 4), (2, 2, 3)])
def test_a_constant_stays_constant_at_any_size(shape: tuple[int, int, int]) -> None:
    whole = with_whole_edges(np.full(shape, 0.7, np.float32))

    assert whole.shape == shape
    assert whole.dtype == np.float32
    np.testing.assert_allclose(whole, np.float32(0.7), rtol=2e-7)
