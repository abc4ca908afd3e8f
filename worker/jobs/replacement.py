"""A fresh child that becomes warm in the background while the old one goes on working."""

import logging
import threading
from typing import Any

from worker.jobs.errors import SlotError
from worker.jobs.slot import Slot

log = logging.getLogger(__name__)


class Replacement:
    """Starts the child of a slot in a thread of its own.

    Args:
        slot: not yet started; the caller's once `is_warming` is over.
        turn: held while the child warms up, since it needs memory and a core beside the others.
    """

    def __init__(self, slot: Slot, turn: threading.Lock) -> None:
        self.slot = slot
        self.facts: dict[str, Any] | None = None
        self._turn = turn
        self._thread = threading.Thread(target=self._start, name="replacement", daemon=True)
        self._thread.start()

    @property
    def is_warming(self) -> bool:
        """Whether it is too early to ask for `facts`, which stay None if the child failed."""
        return self._thread.is_alive()

    def close(self) -> None:
        """Kill the child, from any thread, and wait for that."""
        self.slot.close()
        self._thread.join()
        self.slot.kill()

    def _start(self) -> None:
        with self._turn:
            try:
                self.facts = self.slot.start()
            except SlotError as error:
                log.info("no replacement: %s", error)
