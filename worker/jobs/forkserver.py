"""The one process from which all children are forked: small, single-threaded, started early."""

import multiprocessing
import threading
from multiprocessing import forkserver

CONTEXT = multiprocessing.get_context("forkserver")

_started = threading.Event()


def start_forkserver() -> None:
    """Start the forkserver; call this from the main thread before the first slot starts.

    The forkserver asks the kernel to be killed when the *thread* that started it ends, so only the
    main thread will do. Calling again, from any thread, does nothing.
    """
    if _started.is_set():
        return
    if threading.current_thread() is not threading.main_thread():
        raise RuntimeError("start_forkserver() must be called from the main thread first")
    CONTEXT.set_forkserver_preload(["worker.jobs.preload"])
    forkserver.ensure_running()
    _started.set()
