"""Whether a PNG file is whole: its chunks follow each other and the last one is the end.

libpng's output in OpenImageIO does not notice that a disk is full, so the file is looked at after.
"""

from pathlib import Path

SIGNATURE_BYTES = 8
OVERHEAD_BYTES = 12


def is_whole_png(path: Path) -> bool:
    """Walk over the lengths of the chunks to IEND, which ends where the file does."""
    size = path.stat().st_size
    place = SIGNATURE_BYTES
    with path.open("rb") as file:
        while place + OVERHEAD_BYTES <= size:
            file.seek(place)
            header = file.read(8)
            place += int.from_bytes(header[:4], "big") + OVERHEAD_BYTES
            if header[4:] == b"IEND":
                return place == size
            if not header[4:].isalpha():
                return False
    return False
