import struct
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.worker.images.measuring_child import MeasuringChild


@pytest.fixture(scope="module")
def child() -> Iterator[MeasuringChild]:
    """A process that measures files under a limit on its memory, replaced when it dies."""
    with MeasuringChild() as running:
        yield running


@pytest.fixture
def png_file(tmp_path: Path) -> Callable[..., Path]:
    """Write a PNG chunk by chunk, with right checksums: `png_file(("IHDR", data), ...)`."""

    def write(*chunks: tuple[str, bytes]) -> Path:
        path = tmp_path / "chunks.png"
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(png_chunk(*chunk) for chunk in chunks))
        return path

    return write


def png_chunk(name: str, data: bytes) -> bytes:
    body = name.encode() + data
    return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
