"""Picture files: written from the top, some rows at a time, or in tiles and at every size."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Self

import numpy as np
import OpenImageIO
from numpy.typing import NDArray

from worker.images.png_chunks import is_whole_png

TILE = 64


class Scanlines:
    """An open file; use it in a `with` statement, whose end completes the file."""

    def __init__(self, format_name: str, path: Path, spec: OpenImageIO.ImageSpec) -> None:
        """Open the file and write its header.

        Args:
            format_name: OpenImageIO's, "png" or "openexr".
            path: Where the file goes.
            spec: Of the whole picture.

        Raises:
            OSError: The file cannot be written.
        """
        self._format = format_name
        self._path = path
        self._bytes = spec.image_bytes(True)
        self._next = 0
        file = OpenImageIO.ImageOutput.create(format_name)
        if file is None:
            raise OSError(f"this OpenImageIO cannot write {format_name}")
        self._file = file
        if not self._file.open(str(path), spec):
            raise self._failure()

    def write(self, pixels: NDArray[Any]) -> None:
        """Add the next rows, of shape (rows, width, channels).

        Raises:
            OSError: They cannot be written.
        """
        start, self._next = self._next, self._next + len(pixels)
        rows = np.ascontiguousarray(pixels)
        if not self._file.write_scanlines(start, self._next, 0, rows):
            raise self._failure()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        closed = self._file.close()
        if kind is None and not (closed and (self._format != "png" or is_whole_png(self._path))):
            raise self._failure()

    def _failure(self) -> OSError:
        return _failure_of(self._file, self._format, self._path, self._bytes)


def write_levels(
    path: Path, spec: OpenImageIO.ImageSpec, levels: Sequence[NDArray[np.float32]]
) -> None:
    """Write a mip chain, the largest picture first.

    Args:
        path: Where the file goes.
        spec: Of the largest picture, for lines; it is changed.
        levels: (height, width, channels) each, a side of n pixels followed by max(1, n // 2).

    Raises:
        OSError: The file cannot be written.
    """
    room = 2 * spec.image_bytes(True)
    spec.tile_width = spec.tile_height = TILE
    spec.tile_depth = 1
    # These make OpenImageIO keep room for levels, and caches repeat the picture.
    spec.attribute("textureformat", "Plain Texture")
    spec.attribute("wrapmodes", "periodic,periodic")
    file = OpenImageIO.ImageOutput.create("openexr")
    if file is None:
        raise OSError("this OpenImageIO cannot write openexr")
    for index, level in enumerate(levels):
        spec.height, spec.width = spec.full_height, spec.full_width = level.shape[:2]
        opened = file.open(str(path), spec, "AppendMIPLevel" if index else "Create")
        if not (opened and file.write_image(np.ascontiguousarray(level))):
            raise _failure_of(file, "openexr", path, room)
    if not file.close():
        raise _failure_of(file, "openexr", path, room)


def write_parts(
    path: Path, specs: Sequence[OpenImageIO.ImageSpec], pictures: Sequence[NDArray[np.float32]]
) -> None:
    """Write an EXR of several parts, each a picture (height, width, channels) with its own spec.

    Raises:
        OSError: The file cannot be written.
    """
    file = OpenImageIO.ImageOutput.create("openexr")
    if file is None:
        raise OSError("this OpenImageIO cannot write openexr")
    room = sum(spec.image_bytes(True) for spec in specs)
    opened = file.open(str(path), list(specs))
    for index, (spec, pixels) in enumerate(zip(specs, pictures, strict=True)):
        if index:
            opened = file.open(str(path), spec, "AppendSubimage")
        if not (opened and file.write_image(np.ascontiguousarray(pixels))):
            raise _failure_of(file, "openexr", path, room)
    if not file.close():
        raise _failure_of(file, "openexr", path, room)


def _failure_of(file: OpenImageIO.ImageOutput, format_name: str, path: Path, room: int) -> OSError:
    """Return why a file of up to `room` bytes cannot be written.

    Raises:
        OSError: The disk is full.
    """
    if path.parent.is_dir():  # nobody says why; asking for room tells of a full disk
        with path.open("ab") as rest:
            os.posix_fallocate(rest.fileno(), 0, room)
    return OSError(f"cannot write the {format_name} file: {file.geterror()}")
