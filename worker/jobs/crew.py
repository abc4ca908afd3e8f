"""All slots of one engine: started together, and stopped together in good time."""

import time
from collections.abc import Callable

from worker.jobs.settling import Desk
from worker.jobs.slot import Slot
from worker.jobs.slot_thread import SlotThread
from worker.jobs.status import SlotStatus


class Crew:
    """The threads that do the work.

    Args:
        slots: how many.
        make_slot: makes a slot, not yet started.
        desk: what they share.
        recycle_after: how many jobs a child does before a fresh one takes its place.
    """

    def __init__(
        self, slots: int, make_slot: Callable[[], Slot], desk: Desk, recycle_after: int
    ) -> None:
        self._line = desk.line
        self._threads = [
            SlotThread(f"slot-{number}", make_slot, desk, recycle_after) for number in range(slots)
        ]

    def __len__(self) -> int:
        """How much work is done at a time."""
        return len(self._threads)

    @property
    def warm(self) -> int:
        """How many could start on work at once, or are at it."""
        return sum(thread.is_warm for thread in self._threads)

    @property
    def fingerprint(self) -> str | None:
        """The platform of the children, once one is warm."""
        return next((one.fingerprint for one in self._threads if one.fingerprint), None)

    def status(self) -> tuple[SlotStatus, ...]:
        """How each of them is."""
        return tuple(thread.status() for thread in self._threads)

    def start(self) -> None:
        """Warm up and begin to work."""
        for thread in self._threads:
            thread.start()

    def drain(self, timeout_seconds: float) -> None:
        """Finish what is running and stop; what takes longer goes back into the queue."""
        for thread in self._threads:
            thread.stop()
        self._line.announce(len(self._threads))
        deadline = time.monotonic() + timeout_seconds
        for thread in self._threads:
            thread.join(max(0.0, deadline - time.monotonic()))
        for thread in self._threads:
            thread.abandon()
        for thread in self._threads:
            thread.join()
