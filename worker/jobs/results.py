"""The files that finished work leaves behind, one for each, until they are evicted."""

import os
import shutil
import threading
import time
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from worker.jobs.files import HALF, make_folder, settle, sweep_halves

GRACE_SECONDS: Final = 60.0
"""What was made or used so recently stays: somebody is about to fetch it."""


@dataclass(frozen=True, slots=True)
class Limits:
    """How much may be kept and for how long; `free_bytes` are to be left on the disk."""

    bytes: int = 10 << 30
    seconds: float = 30 * 86400.0
    free_bytes: int = 512 << 20


@dataclass(slots=True)
class _File:
    bytes: int
    used: float  # on a clock that never jumps; before the start of it if it was used before


class Results:
    """A folder of result files, named by the id of the work; usable from any thread.

    The least recently used go first. When a file was last used is its time of modification, so that
    the order is known after a restart. Ages are told by a clock that never jumps, and while the
    service does not run nothing ages: a wrong clock at the start takes nothing away.
    """

    def __init__(self, folder: Path, limits: Limits | None = None) -> None:
        self._folder = make_folder(folder)
        self._limits = limits or Limits()
        self._lock = threading.Lock()
        self._files: OrderedDict[str, _File] = OrderedDict()
        self._bytes = 0

    @property
    def bytes(self) -> int:
        """What all results take together."""
        return self._bytes

    @property
    def count(self) -> int:
        """How many results there are."""
        return len(self._files)

    def sweep(self, expected: Mapping[str, int]) -> list[str]:
        """Bring the folder in step with the records, after whatever ended the service.

        Half files, files of the wrong length and files nobody knows are removed.

        Args:
            expected: the lengths of all results there should be, by the id of their work.

        Returns:
            The ids of those that are missing now.
        """
        sweep_halves(self._folder)
        found = []
        with os.scandir(self._folder) as entries:
            for entry in entries:
                facts = entry.stat()
                if expected.get(entry.name) == facts.st_size:
                    found.append((facts.st_mtime, entry.name, facts.st_size))
                else:
                    Path(entry).unlink()
        now = time.monotonic()
        newest = max(found, default=(0.0, "", 0))[0]
        with self._lock:
            for modified, name, length in sorted(found):
                self._files[name] = _File(length, now - (newest - modified))
                self._bytes += length
        return sorted(expected.keys() - self._files.keys())

    def half(self, work_id: str, attempt: int) -> Path:
        """Where one attempt at the work writes."""
        return self._folder / f"{work_id}.{attempt}{HALF}"

    def preview(self, work_id: str) -> Path:
        """Where the work may leave a picture of how far it is."""
        return self._folder / f"{work_id}.preview{HALF}"

    def settle(self, half: Path) -> None:
        """Bring a written file to the disk.

        Raises:
            StorageFullError: it did not fit.
        """
        settle(half)

    def publish(self, half: Path, work_id: str) -> None:
        """Make a settled file the result of the work.

        The new name is on the disk before the record of it: both are of one file system, whose
        journal keeps their order. Where it does not, the file is found missing at the next start.
        """
        length = half.stat().st_size
        half.replace(self._folder / work_id)
        with self._lock:
            self._forget(work_id)
            self._files[work_id] = _File(length, time.monotonic())
            self._bytes += length

    def find(self, work_id: str) -> Path | None:
        """The result of the work, from now on the most recently used; None if there is none."""
        path = self._folder / work_id
        with self._lock:
            file = self._files.get(work_id)
            if file is None:
                return None
            try:
                os.utime(path)
            except FileNotFoundError:
                self._forget(work_id)
                return None
            file.used = time.monotonic()
            self._files.move_to_end(work_id)
        return path

    def evict(self) -> list[str]:
        """Remove what is beyond the limits; answers the ids of the work."""
        evicted = []
        free = shutil.disk_usage(self._folder).free
        with self._lock:
            now = time.monotonic()
            while self._files:
                work_id, file = next(iter(self._files.items()))
                unused = now - file.used
                is_too_much = self._bytes > self._limits.bytes or free < self._limits.free_bytes
                if unused < GRACE_SECONDS or not (is_too_much or unused > self._limits.seconds):
                    break
                (self._folder / work_id).unlink(missing_ok=True)
                self._forget(work_id)
                free += file.bytes
                evicted.append(work_id)
        return evicted

    def remove(self, work_id: str) -> None:
        """Remove a result that could not be recorded."""
        with self._lock:
            self._forget(work_id)
        (self._folder / work_id).unlink(missing_ok=True)

    def _forget(self, work_id: str) -> None:
        file = self._files.pop(work_id, None)
        if file is not None:
            self._bytes -= file.bytes
