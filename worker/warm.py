"""Compiles everything once, into the caches in the data folder that the service's children read.

`python -m worker.warm` heeds the service's own settings TEXLOOM_DATA, TEXLOOM_GL and
TEXLOOM_NATIVE_CPU.
"""

import os
import sys
import time
from pathlib import Path

from pydantic import TypeAdapter

from worker.jobs.environment import child_environment


def main() -> None:
    """Warm up in this process, and say how far it is."""
    data = Path(os.environ.get("TEXLOOM_DATA", "data")).resolve()
    os.environ |= child_environment(
        data,
        gl=os.environ.get("TEXLOOM_GL", "osmesa"),
        native_cpu=TypeAdapter(bool).validate_python(os.environ.get("TEXLOOM_NATIVE_CPU", "false")),
    )
    for cache in ("NUMBA_CACHE_DIR", "MESA_SHADER_CACHE_DIR"):
        Path(os.environ[cache]).mkdir(parents=True, exist_ok=True)
    # Only now: numba, OpenBLAS and Mesa read their environment when they are loaded.
    from worker import run_job  # noqa: PLC0415
    from worker.models import formats  # noqa: PLC0415

    began = time.monotonic()

    def report(share: float, name: str) -> None:
        sys.stderr.write(f"  {share:4.0%}  {time.monotonic() - began:5.1f} s  {name}\n")

    report(0.0, "readers of models")
    formats.warm()
    run_job.warm(report)


if __name__ == "__main__":
    main()
