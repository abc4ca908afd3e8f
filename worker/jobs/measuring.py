"""Uploads are decoded in a child of their own, so that the one that kills it kills nothing else."""

import threading
from pathlib import Path
from typing import Any, Final

from worker.jobs.errors import MeasuringError, failure
from worker.jobs.files import half_file
from worker.jobs.slot import Slot

ATTEMPTS: Final = 2


class Measuring:
    """One slot that measures files one after another, started when the first one comes."""

    def __init__(self, slot: Slot, scratch: Path) -> None:
        self._slot = slot
        self._scratch = scratch
        self._turn = threading.Lock()

    def measure(
        self, path: Path, time_limit_seconds: float, media_type: str = ""
    ) -> dict[str, Any]:
        """The facts of a file, which its uploader calls `media_type`; callable from any thread.

        Raises:
            MeasuringError: the file is unusable, or measuring it took too much time or memory.
            SlotError: no child could be started.
        """
        request = {"path": str(path), "media_type": media_type}
        with self._turn:
            for _ in range(ATTEMPTS):
                if not self._slot.is_alive():
                    self._slot.start()
                scratch = half_file(self._scratch)
                try:
                    outcome = self._slot.run(
                        request, scratch, time_limit_seconds=time_limit_seconds
                    )
                finally:
                    scratch.unlink(missing_ok=True)
                if outcome.facts is not None:
                    return outcome.facts
                if outcome.status == "failed" and outcome.failure is not None:
                    raise MeasuringError(outcome.failure)
                if outcome.status != "crashed":
                    break
        reason = outcome.failure["message"] if outcome.failure else outcome.status
        raise MeasuringError(failure("asset_unusable", f"the file could not be read: {reason}"))

    def close(self) -> None:
        """Kill the child, even while it measures."""
        self._slot.close()
        with self._turn:
            self._slot.kill()
