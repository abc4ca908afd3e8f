"""Memory that the C library keeps for later goes back to the system.

Pictures of all sizes come and go, and leave holes in the heap that the next ones do not fit into.
The C library returns the end of its heap by itself, but not the holes.
"""

import ctypes
import os
from pathlib import Path
from typing import Final

PAGE_BYTES: Final = os.sysconf("SC_PAGE_SIZE")
GROWTH_BYTES: Final = 64 << 20
"""So much more than after the last time, and it is worth looking through the heap again: that takes
1 to 9 ms for every 100 MB, the more the more holes there are."""


class Heap:
    """The heap of this process, tidied between jobs."""

    def __init__(self) -> None:
        self._trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # only glibc has it
        self._kept = resident_bytes()

    def tidy(self) -> None:
        """Return what nobody uses, if the process has grown since."""
        if self._trim is not None and resident_bytes() > self._kept + GROWTH_BYTES:
            self._trim(0)
            self._kept = resident_bytes()


def resident_bytes(pid: int | str | None = "self") -> int:
    """Return how much of a process is in memory now; 0 when it has just ended."""
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE_BYTES
    except (OSError, IndexError):
        return 0
