"""Where slot threads meet work: they wait for it, take it, and hear that it was cancelled."""

import threading

from worker.jobs.claims import Claim, Claims


class Line:
    """The waiting and the running work of one engine, as its threads see it."""

    def __init__(self, claims: Claims) -> None:
        self._claims = claims
        self._arrived = threading.Condition()
        self._arrivals = 0
        self._taking = threading.Lock()
        self._running: dict[str, threading.Event] = {}

    @property
    def arrivals(self) -> int:
        """A number that changes whenever there may be something to take."""
        return self._arrivals

    def announce(self) -> None:
        """Tell all waiting threads that there may be something to take."""
        with self._arrived:
            self._arrivals += 1
            self._arrived.notify_all()

    def wait(self, seen: int, timeout_seconds: float) -> None:
        """Wait until something was announced after `arrivals` read `seen`."""
        with self._arrived:
            self._arrived.wait_for(lambda: self._arrivals != seen, timeout_seconds)

    def take(self) -> tuple[Claim, threading.Event] | None:
        """The next work, with the event that is set when it is cancelled."""
        # Under one lock: work that is recorded as running can always be found by `cancel`.
        with self._taking:
            claim = self._claims.claim()
            if claim is None:
                return None
            cancelled = self._running[claim.work_id] = threading.Event()
        return claim, cancelled

    def done(self, work_id: str) -> None:
        """Forget taken work."""
        with self._taking:
            del self._running[work_id]

    def cancel(self, work_id: str) -> None:
        """Set the event of taken work; call this after recording the cancellation."""
        with self._taking:
            cancelled = self._running.get(work_id)
        if cancelled is not None:
            cancelled.set()
