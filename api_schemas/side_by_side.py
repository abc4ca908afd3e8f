"""Where several exemplars lie in the one picture that pixels are copied from."""

from collections.abc import Mapping, Sequence

from api_schemas.own_size import Size

_LEAST_GAP = 48
"""Twice as far as what is measured of a picture reaches: outlines are looked for within 19."""


def gap(sizes: Sequence[Size]) -> int:
    """Return how many columns lie between exemplars of (width, height).

    A quarter of the longest side: so much is left of it at the coarsest size they are compared at.
    """
    return max(_LEAST_GAP, max(max(size) for size in sizes) // 4)


def corners(sizes: Sequence[Size]) -> list[int]:
    """Return the first column of each exemplar; all begin in the first row."""
    found, column = [], 0
    for width, _ in sizes:
        found.append(column)
        column += width + gap(sizes)
    return found


def whole(sizes: Sequence[Size]) -> Size:
    """Return width and height of the picture they lie in."""
    return (corners(sizes)[-1] + sizes[-1][0], max(height for _, height in sizes))


def together(sides: Mapping[str, Size]) -> dict[str, Size]:
    """Return the sizes of the textures in a spec, with that of all its exemplars as one."""
    exemplars = [size for name, size in sides.items() if name.rpartition("/")[2] == "exemplar"]
    return {**sides, "exemplar": whole(exemplars)}
