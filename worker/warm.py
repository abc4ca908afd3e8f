"""Compiles everything once, into the caches in the data folder that the service's children read.

`python -m worker.warm` heeds the service's own settings TEXLOOM_DATA, TEXLOOM_GL and
TEXLOOM_NATIVE_CPU.
"""

import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

from pydantic import TypeAdapter

from worker.jobs.environment import child_environment

SHADERS, READERS = "shaders", "readers of models"


def main() -> None:
    """Warm up on all cores, and say how far it is."""
    data = Path(os.environ.get("TEXLOOM_DATA", "data")).resolve()
    os.environ |= child_environment(
        data,
        gl=os.environ.get("TEXLOOM_GL", "osmesa"),
        native_cpu=TypeAdapter(bool).validate_python(os.environ.get("TEXLOOM_NATIVE_CPU", "false")),
    )
    for cache in ("NUMBA_CACHE_DIR", "MESA_SHADER_CACHE_DIR"):
        Path(os.environ[cache]).mkdir(parents=True, exist_ok=True)
    # Only now: numba, OpenBLAS and Mesa read their environment when they are loaded.
    from worker import synthesis  # noqa: PLC0415

    began = time.monotonic()
    parts = [SHADERS, READERS, *synthesis.techniques()]
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(len(os.sched_getaffinity(0)), context) as pool:
        names = {pool.submit(_compile, part): part for part in parts}
        for done, future in enumerate(as_completed(names), 1):
            future.result()
            seconds = time.monotonic() - began
            sys.stderr.write(f"  {done / len(parts):4.0%}  {seconds:5.1f} s  {names[future]}\n")


def _compile(part: str) -> None:
    from worker import run_job, synthesis  # noqa: PLC0415
    from worker.models import formats  # noqa: PLC0415

    if part == SHADERS:
        run_job.warm_shaders(lambda _share, _name: None)
    elif part == READERS:
        formats.warm()
    else:
        synthesis.compile_kernels(part)


if __name__ == "__main__":
    main()
