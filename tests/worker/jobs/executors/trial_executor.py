"""An executor that does what the request's body says: sleep, crash, get stuck, and worse."""

import ctypes
import errno
import mmap
import os
import signal
import sys
import time
from pathlib import Path


class _NoFileError(Exception):
    """Ends a run with success and without a result."""


class RefusedError(Exception):
    def as_failure(self):
        return {"code": "refused", "message": "no", "pointer": "/texture"}


def warm(report):
    report(0.5, "warming up")
    return {"fingerprint": os.environ.get("TRIAL_FINGERPRINT", "trial")}


def run(request, out, report):
    body = request["body"]
    if note := body.get("note_pid"):
        with Path(note).open("a") as file:
            file.write(f"{os.getpid()}\n")
    try:
        facts = _DO[body["do"]](body | {"request": request}, out, report) or {}
    except _NoFileError:
        return {}
    if not out.exists():
        out.write_bytes(b"result")
    return facts | {"bytes": out.stat().st_size}


def _nothing(body, out, report):
    pass


def _describe(body, out, report):
    os.write(1, b"noise on stdout\n")
    return {
        "environment": {name: os.environ.get(name) for name in body["variables"]},
        "loaded": sorted(
            {name.partition(".")[0] for name in sys.modules}
            & {"sqlalchemy", "alembic", "fastapi", "pytest", "numpy", "numba"}
        ),
        "oom_score_adj": int(Path("/proc/self/oom_score_adj").read_text()),
        "stdout_is_stderr": os.fstat(1).st_ino == os.fstat(2).st_ino,
        "request": {name: body["request"][name] for name in ("kind", "digest", "assets")},
    }


def _show(body, out, report):
    """Leave a preview, and wait until it was seen."""
    Path(body["request"]["preview"]).write_bytes(b"half a picture")
    while not Path(body["seen"]).exists():
        time.sleep(0.01)


def _sleep(body, out, report):
    end = time.monotonic() + body["seconds"]
    while (left := end - time.monotonic()) > 0:
        report(1 - left / body["seconds"], "sleeping")
        time.sleep(min(left, 0.02))


def _burn(body, out, report):
    end = time.monotonic() + body["seconds"]
    while time.monotonic() < end:
        pass


def _wait(body, out, report):
    """Until the test opens the gate."""
    while not Path(body["gate"]).exists():
        time.sleep(0.005)


def _sleep_once(body, out, report):
    """Slow the first time, quick when repeated."""
    marker = Path(body["marker"])
    if not marker.exists():
        marker.touch()
        time.sleep(60)


def _stuck_once(body, out, report):
    marker = Path(body["marker"])
    if not marker.exists():
        marker.touch()
        _stuck(body, out, report)


def _segfault(body, out, report):
    out.write_bytes(b"half")
    ctypes.string_at(0)


def _stuck(body, out, report):
    """In a native call that holds the interpreter's lock, deaf to all that can be blocked."""
    out.write_bytes(b"half")
    signal.pthread_sigmask(signal.SIG_BLOCK, range(1, 32))
    ctypes.PyDLL(None).sleep(3600)


def _refuse(body, out, report):
    raise RefusedError


def _stumble(body, out, report):
    raise KeyError("/secret/path")


def _exhaust(body, out, report):
    raise MemoryError


def _hog(body, out, report):
    held = []
    for _ in range(400):
        held.append(b"\1" * (10 << 20))
        time.sleep(0.005)


_KEPT = []


def _holes(body, out, report):
    """Leave a heap of which one block in a hundred is in use."""
    blocks = [bytes(2000) for _ in range(body["bytes"] // 2000)]
    _KEPT.extend(blocks[::100])


def _reserve(body, out, report):
    """Much at once, and none of it touched: nobody who looks at resident memory sees it."""
    held = mmap.mmap(-1, body["bytes"], flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    time.sleep(0.2)
    held.close()


def _fill_disk(body, out, report):
    raise OSError(errno.ENOSPC, "No space left on device")


def _no_file(body, out, report):
    raise _NoFileError


def _not_json(body, out, report):
    return {"bad": float("nan")}


def _flood(body, out, report):
    for step in range(2000):
        report(step / 2000, "flooding")


def _write(body, out, report):
    out.write_bytes(b"\7" * body["bytes"])


def _say(body, out, report):
    return {"said": "\u4e00" * body["letters"]}


_DO = {
    "nothing": _nothing,
    "describe": _describe,
    "show": _show,
    "sleep": _sleep,
    "burn": _burn,
    "wait": _wait,
    "sleep once": _sleep_once,
    "stuck once": _stuck_once,
    "segfault": _segfault,
    "stuck": _stuck,
    "refuse": _refuse,
    "stumble": _stumble,
    "exhaust": _exhaust,
    "hog": _hog,
    "holes": _holes,
    "reserve": _reserve,
    "fill disk": _fill_disk,
    "no file": _no_file,
    "not json": _not_json,
    "flood": _flood,
    "write": _write,
    "say": _say,
}
