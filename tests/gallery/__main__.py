"""Draws every example into tests/gallery, for the README and for the eye.

`make gallery`; each picture is the example's own request, run by the executor of the service.
"""

import os
import sys
import tempfile
from pathlib import Path

from tests.examples import examples
from worker.jobs.environment import child_environment

ROOT = Path(__file__).resolve().parents[2]
GALLERY = Path(__file__).parent


def main() -> None:
    """Draw all examples, or those named on the command line."""
    os.environ |= child_environment(
        ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
    )
    # Only now: numba, OpenBLAS and Mesa read their environment when they are loaded.
    from tests.run_example import run_example  # noqa: PLC0415

    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[1:] or examples():
            path = GALLERY / f"{name}.png"
            facts = run_example(name, path, Path(folder), format="png")
            sys.stdout.write(f"{path.relative_to(ROOT)}  {facts['width']} x {facts['height']}\n")


if __name__ == "__main__":
    main()
