"""The life of a child process: become expendable, warm up, then answer one request after another.

Requests and answers cross the pipe as JSON and never as pickles: a child decodes what strangers
upload, so nothing it says may be executed by the service. An answer is a list whose first item is
its kind: `["report", progress, stage]`, `["warm", facts]`, `["ok", facts]`, `["failed", failure]`,
`["memory_exceeded", null]`.
"""

import ctypes
import errno
import faulthandler
import importlib
import json
import logging
import multiprocessing
import os
import resource
import signal
import sys
from collections.abc import Mapping
from multiprocessing import parent_process
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Protocol, cast

from worker.jobs import log_lines
from worker.jobs.heap import Heap
from worker.stages import Report

PR_SET_PDEATHSIG = 1
FULL_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)

log = logging.getLogger(__name__)


class Executor(Protocol):
    """The module that does the work, known to the rest of this package by name only."""

    def warm(self, report: Report) -> dict[str, Any]:
        """Load and compile everything once; the answer holds at least `fingerprint`."""

    def run(self, request: dict[str, Any], out: Path, report: Report) -> dict[str, Any]:
        """Do one request, write its file at `out`, answer JSON-able facts."""


def serve(
    connection: Connection, module: str, environment: Mapping[str, str], reservable_bytes: int
) -> None:
    """Warm the executor named `module` up and answer requests until the pipe closes."""
    become_expendable()
    heap = Heap()
    log_lines.install("warning")
    # Not RLIMIT_AS: a shader compiler maps far more than it touches.
    resource.setrlimit(resource.RLIMIT_DATA, (reservable_bytes, reservable_bytes))
    os.environ.update(environment)
    # A child starts no processes. Locks that libraries make under this method (numba makes one) are
    # nameless; those of a forkserver would outlive a killed child and be reported as leaked.
    multiprocessing.set_start_method("fork", force=True)

    def report(progress: float, stage: str) -> None:
        _send(connection, "report", progress, stage)

    try:
        executor = cast("Executor", importlib.import_module(module))
        facts = executor.warm(report)
    except Exception as error:
        log.exception("could not warm %s up", module)
        _send(connection, "failed", _failure_of(error))
        return
    heap.tidy()
    _send(connection, "warm", facts)
    while True:
        try:
            request, out = json.loads(connection.recv_bytes())
        except (EOFError, OSError):
            return
        with log_lines.telling(work=Path(out).name.partition(".")[0]):
            _send(connection, *_answer(executor, request, Path(out), report))
        heap.tidy()


def become_expendable() -> None:
    """Make this process die with its parent, and be the first to die when memory runs out."""
    die_with_parent()
    parent = parent_process()
    if parent is not None and not parent.is_alive():
        os._exit(1)
    for ignored in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ignored, signal.SIG_IGN)
    try:
        Path("/proc/self/oom_score_adj").write_text("900")
    except OSError:
        log.debug("oom_score_adj may not be set here")
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.dup2(2, 1)  # libraries print to stdout; the service's stdout is not theirs
    faulthandler.enable()
    if "worker.jobs.preload" not in sys.modules:
        log.warning("worker.jobs.preload was not loaded: processes may outlive the service")


def die_with_parent() -> None:
    """Ask the kernel for SIGKILL as soon as the thread that forked this process is gone."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def _answer(
    executor: Executor, request: dict[str, Any], out: Path, report: Report
) -> tuple[str, Any]:
    """Run one request; whatever goes wrong becomes data."""
    try:
        facts = executor.run(request, out, report)
        json.dumps(facts, allow_nan=False)
    except MemoryError:
        log.exception("out of memory")
        return "memory_exceeded", None
    except Exception as error:
        return "failed", _failure_of(error)
    return "ok", facts


def _failure_of(error: Exception) -> dict[str, Any]:
    """The failure to answer; what was not foreseen is told to the log and to nobody else."""
    as_failure = getattr(error, "as_failure", None)
    if callable(as_failure):
        return cast("dict[str, Any]", as_failure())
    if isinstance(error, OSError) and error.errno in FULL_DISK:
        return {"code": "storage_full", "message": "the disk is full", "pointer": None}
    log.error("the executor failed", exc_info=error)
    return {"code": "internal_error", "message": "the worker failed unexpectedly", "pointer": None}


def _send(connection: Connection, *answer: object) -> None:
    """Tell the parent; without a parent there is nothing left to do."""
    try:
        connection.send_bytes(json.dumps(answer).encode())
    except OSError:
        os._exit(1)
