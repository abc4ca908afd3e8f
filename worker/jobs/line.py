"""Where slot threads meet work: they wait for it, take it, and hear that it was cancelled."""

import threading

from worker.jobs.claims import Claim, Claims


class Line:
    """The waiting and the running work of one engine, as its threads see it."""

    def __init__(self, claims: Claims) -> None:
        self._claims = claims
        self._arrived = threading.Condition()
        self._arrivals = 0
        self._found_empty: int | None = None
        self._taking = threading.Lock()
        self._running: dict[str, tuple[Claim, threading.Event]] = {}

    @property
    def arrivals(self) -> int:
        """A number that changes whenever there may be something to take."""
        return self._arrivals

    def announce(self, count: int = 1) -> None:
        """Tell as many waiting threads that there may be something to take."""
        with self._arrived:
            self._arrivals += 1
            self._arrived.notify(count)

    def wait(self, seen: int, timeout_seconds: float) -> None:
        """Wait until something was announced after `arrivals` read `seen`."""
        with self._arrived:
            if not self._arrived.wait_for(lambda: self._arrivals != seen, timeout_seconds):
                self._found_empty = None  # look for oneself, now and then

    def take(self) -> tuple[Claim, threading.Event] | None:
        """The next work, with the event that is set when it is cancelled."""
        # Under one lock: work that is recorded as running can always be found by `cancel`.
        with self._taking:
            seen = self._arrivals
            if seen == self._found_empty:
                return None  # the records need not be asked again
            claim = self._claims.claim()
            if claim is None:
                self._found_empty = seen
                return None
            cancelled = threading.Event()
            self._running[claim.work_id] = claim, cancelled
        return claim, cancelled

    def done(self, work_id: str) -> None:
        """Forget taken work."""
        with self._taking:
            claim, _ = self._running.pop(work_id)
            if claim.priority == "batch":
                self._found_empty = None  # what waits may have waited for this very slot

    def cancel(self, work_id: str) -> None:
        """Set the event of taken work; call this after recording the cancellation."""
        with self._taking:
            taken = self._running.get(work_id)
        if taken is not None:
            taken[1].set()
