"""A picture file that is written from the top, some rows at a time."""

import os
from pathlib import Path
from typing import Any, Self

import numpy as np
import OpenImageIO
from numpy.typing import NDArray

from worker.images.png_chunks import is_whole_png


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
        if self._path.parent.is_dir():  # nobody says why; asking for room tells of a full disk
            with self._path.open("ab") as rest:
                os.posix_fallocate(rest.fileno(), 0, self._bytes)
        return OSError(f"cannot write the {self._format} file: {self._file.geterror()}")
