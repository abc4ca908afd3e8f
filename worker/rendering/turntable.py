"""Frames of a scene that turns: where things stand in each, and how they become one file."""

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from api_schemas.turntable import Turntable
from worker.geometry.transforms import Matrix
from worker.images.image import Image
from worker.rendering.bands import Band
from worker.rendering.packing import PICTURE


def turns_of(turntable: Turntable | None) -> list[Matrix]:
    """Return how all things are moved in each frame that is drawn: not at all without a turntable.

    Frame n of n is frame 0, to the last bit.
    """
    if turntable is None:
        return [np.eye(4)]
    return [_turn(number / turntable.frames, turntable.pivot) for number in turntable.drawn]


def _turn(share: float, pivot: Sequence[float]) -> Matrix:
    cosine, sine = math.cos(2 * math.pi * share), math.sin(2 * math.pi * share)
    matrix = np.eye(4)
    matrix[0, 0] = matrix[2, 2] = cosine
    matrix[0, 2], matrix[2, 0] = sine, -sine
    middle = np.array(pivot, dtype=np.float64)
    matrix[:3, 3] = middle - matrix[:3, :3] @ middle
    return matrix


def sheet(frames: Iterable[Iterable[Band]], columns: int) -> Iterator[Band]:
    """Lay frames beside each other, row by row; what is left over is 0.

    Args:
        frames: The bands of each, all of one size; drawn while they are read.
        columns: Frames in a row.
    """
    rest = iter(frames)
    while row := [_whole(bands) for bands in itertools.islice(rest, columns)]:
        empty = {
            name: Image(np.zeros_like(image.pixels), image.meaning)
            for name, image in row[0].items()
        }
        row += [empty] * (columns - len(row))
        yield {
            name: Image(np.concatenate([frame[name].pixels for frame in row], axis=1), kind.meaning)
            for name, kind in row[0].items()
        }


def layers(frames: Iterable[Iterable[Band]]) -> Iterator[Band]:
    """Give the first frame, and beside it all frames and their layers as layers with a number."""
    wholes = [_whole(bands) for bands in frames]
    yield wholes[0] | {
        f"frame_{number:04d}" if name == PICTURE else f"frame_{number:04d}.{name}": image
        for number, frame in enumerate(wholes)
        for name, image in frame.items()
    }


def _whole(bands: Iterable[Band]) -> dict[str, Image]:
    """Put the bands of one frame together."""
    found = list(bands)
    return {
        name: Image(np.concatenate([band[name].pixels for band in found]), image.meaning)
        for name, image in found[0].items()
    }
