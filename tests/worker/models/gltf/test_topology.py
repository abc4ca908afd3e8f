"""Strings of vertices as triangles, lines and points, after glTF 2.0, section 3.7.2.1."""

import numpy as np
import pytest

from worker.models.gltf.topology import assemble


@pytest.mark.parametrize(
    ("mode", "expected"),
    [
        (0, [[0], [1], [2], [3], [4]]),
        (1, [[0, 1], [2, 3]]),
        (2, [[0, 1], [1, 2], [2, 3], [3, 4], [4, 0]]),
        (3, [[0, 1], [1, 2], [2, 3], [3, 4]]),
        (4, [[0, 1, 2]]),
        (5, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]),
        (6, [[1, 2, 0], [2, 3, 0], [3, 4, 0]]),
    ],
)
def test_five_vertices_are_strung_together_as_section_3_7_2_1_says(
    mode: int, expected: list[list[int]]
) -> None:
    assert assemble(mode, np.arange(5)).tolist() == expected


@pytest.mark.parametrize("mode", range(7))
@pytest.mark.parametrize("length", [1, 2])
def test_too_few_vertices_give_only_what_is_whole(mode: int, length: int) -> None:
    least = (1, 2, 2, 2, 3, 3, 3)[mode]
    expected = {0: length, 2: 2, 1: 1, 3: 1}.get(mode, 0) if length >= least else 0

    assert len(assemble(mode, np.arange(length))) == expected


def test_a_strip_that_is_stitched_keeps_its_winding_and_loses_the_stitches() -> None:
    # Two squares in one strip, joined by repeating 3 and 4.
    strip = np.array([0, 1, 2, 3, 3, 4, 4, 5, 6, 7])
    positions = np.array(
        [[x, y] for base in (0, 5) for x, y in ((base, 0), (base + 1, 0), (base, 1), (base + 1, 1))]
    )

    triangles = assemble(5, strip)

    corners = positions[triangles]
    one, other = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) / 2
    assert areas.tolist() == [0.5] * 4
