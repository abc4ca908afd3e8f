"""Everything outside a request that decides its pixels, in one line."""

import os
from importlib.metadata import version

from worker.images import image_io
from worker.rendering import renderer


def fingerprint() -> str:
    """Name the libraries and the processor target; OSMesa and EGL draw alike and are not in it."""
    cpu = os.environ.get("NUMBA_CPU_NAME", "native")
    parts = [
        renderer.fingerprint(),
        f"numpy {version('numpy')}",
        f"numba {version('numba')}",
        image_io.version(),
        f"cpu {cpu}",
    ]
    return "; ".join(parts)
