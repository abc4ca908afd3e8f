"""One warm child process, owned by one thread: the only place in which native code runs.

Whatever the code does, the slot's owner gets an `Outcome`: time limit, cancellation and memory
limit are kept by SIGKILL, which no native call can refuse.
"""

import atexit
import json
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

from worker.errors import Failure
from worker.jobs.child import serve
from worker.jobs.errors import SlotError, failure
from worker.jobs.forkserver import CONTEXT
from worker.jobs.heap import resident_bytes
from worker.stages import Report

if TYPE_CHECKING:
    from multiprocessing.process import BaseProcess

Status = Literal["ok", "failed", "crashed", "timed_out", "memory_exceeded", "cancelled"]

TICK_SECONDS: Final = 0.025
LONGEST_ANSWER_BYTES: Final = 64 << 20
"""Facts name every node and material of a model: 20 000 names of 256 characters at 6 bytes each,
as JSON escapes them, are 30 MB."""
RESERVABLE: Final = 2


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a request ended; `facts` with `ok`, `failure` with all others but `cancelled`."""

    status: Status
    facts: dict[str, Any] | None = None
    failure: Failure | None = None


class Slot:
    """A child that is started, asked and killed by the thread that owns it.

    Args:
        module: name of the executor module, imported by the child alone.
        environment: variables set in the child before that import.
        memory_limit_bytes: resident memory beyond which the child is killed. It may reserve
            twice that, so that one huge allocation fails instead of outrunning the watch.
        warm_limit_seconds: time a child may take to become warm.
    """

    def __init__(
        self,
        module: str,
        environment: Mapping[str, str],
        *,
        memory_limit_bytes: int,
        warm_limit_seconds: float = 900,
    ) -> None:
        self._module = module
        self._environment = dict(environment)
        self._memory_limit_bytes = memory_limit_bytes
        self._warm_limit_seconds = warm_limit_seconds
        self._process: BaseProcess | None = None
        self._connection: Connection | None = None
        self._changing = threading.Lock()
        self._closed = False
        self._warm = False
        # multiprocessing's own exit hook, registered earlier and so run later, sends SIGTERM and
        # then waits: with a child that ignores SIGTERM, for ever.
        atexit.register(self.close)

    @property
    def is_warm(self) -> bool:
        """Whether a child became warm and was not seen dead since; for any thread to ask."""
        return self._warm

    def is_alive(self) -> bool:
        """Whether a warm child is there to be asked, looked up by the owner."""
        return self._warm and self._process is not None and self._process.is_alive()

    def start(self) -> dict[str, Any]:
        """Fork a child and wait until it is warm; answers what its `warm` answered.

        Raises:
            SlotError: the slot is closed, or the child failed, died or took too long.
        """
        self.kill()
        ours, theirs = CONTEXT.Pipe()
        with self._changing:
            if self._closed:
                raise SlotError("the slot is closed")
            reservable = RESERVABLE * self._memory_limit_bytes
            arguments = (theirs, self._module, self._environment, reservable)
            process = CONTEXT.Process(target=serve, args=arguments, daemon=True)
            try:
                process.start()
            except (OSError, EOFError) as error:  # the forkserver was killed, or cannot fork
                ours.close()
                raise SlotError(f"no process could be forked: {error}") from error
            finally:
                theirs.close()
            self._process, self._connection = process, ours
        outcome = self._listen("warm", self._warm_limit_seconds)
        if outcome.facts is None:
            self.kill()
            reason = outcome.failure["message"] if outcome.failure else outcome.status
            raise SlotError(f"{self._module} did not become warm: {reason}")
        self._warm = True
        return outcome.facts

    def run(
        self,
        request: dict[str, Any],
        out: Path,
        *,
        time_limit_seconds: float,
        cancelled: threading.Event | None = None,
        report: Report | None = None,
    ) -> Outcome:
        """Have the child do one request; unless it answered, the child is dead afterwards."""
        if self._connection is None:
            return _crash("there was no child")
        try:
            self._connection.send_bytes(json.dumps([request, str(out)]).encode())
        except OSError:
            outcome = self._crash()
        else:
            try:
                outcome = self._listen("ok", time_limit_seconds, cancelled, report)
            except BaseException:
                self.kill()  # it would answer the next request with this one's result
                raise
        if outcome.status not in ("ok", "failed"):
            self.kill()
        return outcome

    def kill(self) -> None:
        """End the child at once, whatever it is doing."""
        self._warm = False
        with self._changing:
            process, connection = self._process, self._connection
            self._process = self._connection = None
        if process is not None and connection is not None:
            process.kill()
            process.join()
            connection.close()

    def close(self) -> None:
        """Kill the child from any thread and never start another; the owner sees a crash."""
        atexit.unregister(self.close)
        with self._changing:
            self._closed = True
            if self._process is not None:
                self._process.kill()

    def _listen(
        self,
        success: str,
        limit_seconds: float,
        cancelled: threading.Event | None = None,
        report: Report | None = None,
    ) -> Outcome:
        """Hear the child out until its answer, its death or the end of our patience."""
        process, connection = self._process, self._connection
        assert process is not None
        assert connection is not None
        deadline = time.monotonic() + limit_seconds
        next_look = 0.0
        while True:
            now = time.monotonic()
            patience = max(0.0, min(TICK_SECONDS, deadline - now))
            heard = wait([connection, process.sentinel], patience)
            if connection in heard:
                try:
                    kind, *content = json.loads(connection.recv_bytes(LONGEST_ANSWER_BYTES))
                except (EOFError, OSError, ValueError, TypeError):
                    return self._crash()
                if kind == success:
                    return Outcome("ok", facts=content[0])
                if kind == "failed":
                    return Outcome("failed", failure=content[0])
                if kind == "memory_exceeded":
                    return self._over_memory()
                if report is not None:
                    report(*content)
            elif heard:
                return self._crash()
            if cancelled is not None and cancelled.is_set():
                return Outcome("cancelled")
            now = time.monotonic()
            if now >= deadline:
                message = f"stopped at its time limit of {limit_seconds:g} seconds"
                return Outcome("timed_out", failure=failure("timed_out", message))
            if now >= next_look:
                next_look = now + TICK_SECONDS
                if resident_bytes(process.pid) > self._memory_limit_bytes:
                    return self._over_memory()

    def _crash(self) -> Outcome:
        process = self._process
        if process is None:
            return _crash("the child was taken away")
        process.join(1)
        return _crash(f"the worker process ended with exit code {process.exitcode}")

    def _over_memory(self) -> Outcome:
        message = f"needed more than {self._memory_limit_bytes} bytes of memory"
        return Outcome("memory_exceeded", failure=failure("memory_exceeded", message))


def _crash(message: str) -> Outcome:
    return Outcome("crashed", failure=failure("worker_lost", message))
