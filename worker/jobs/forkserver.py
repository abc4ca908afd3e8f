"""The one process from which all children are forked: single-threaded, started early.

What it has loaded, its children share: they start sooner, and its pages count once.
"""

import multiprocessing
import os
import threading
from collections.abc import Mapping
from multiprocessing import forkserver
from types import MappingProxyType
from typing import Final

EXECUTOR: Final = "worker.run_job"
"""Name of the module that does jobs; nothing in this package imports it."""

CONTEXT = multiprocessing.get_context("forkserver")

_started = threading.Event()


def start_forkserver(
    executor: str | None = None, environment: Mapping[str, str] = MappingProxyType({})
) -> None:
    """Start the forkserver; call this from the main thread before the first slot starts.

    The forkserver asks the kernel to be killed when the *thread* that started it ends, so only the
    main thread will do. Calling again, from any thread, does nothing.

    Args:
        executor: A module for it to load. Loading it must start no thread: a fork beside threads
            may wait for ever for a lock that one of them held.
        environment: That of the children, where an executor is given: what it loads reads it. It
            becomes part of this process's own, for a forkserver that was killed is started again.
    """
    if _started.is_set():
        return
    if threading.current_thread() is not threading.main_thread():
        raise RuntimeError("start_forkserver() must be called from the main thread first")
    os.environ.update(environment)
    loaded = ["worker.jobs.preload", *([executor] if executor else []), "worker.jobs.preloaded"]
    CONTEXT.set_forkserver_preload(loaded)
    forkserver.ensure_running()
    _started.set()
