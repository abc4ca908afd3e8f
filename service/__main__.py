"""`python -m service` serves until it is told to stop, and then finishes what is running."""

import logging
import sys
from typing import Final

from service.settings import Settings
from worker.jobs import log_lines
from worker.jobs.environment import child_environment
from worker.jobs.forkserver import EXECUTOR, start_forkserver

SWITCH_SECONDS: Final = 0.0005
"""A thread that wants the interpreter waits so long for one that computes: ten times less than
Python's own patience, since answers pass through several threads."""


def main() -> int:
    """Serve; the answer is the exit code."""
    settings = Settings()
    log_lines.install(settings.log_level)
    logging.getLogger("alembic").setLevel(logging.WARNING)
    sys.setswitchinterval(SWITCH_SECONDS)
    data = settings.data.resolve()
    start_forkserver(
        EXECUTOR, child_environment(data, gl=settings.gl, native_cpu=settings.native_cpu)
    )
    # Only now: it takes a second, and the forkserver loads the worker meanwhile.
    from service.server import serve  # noqa: PLC0415

    return serve(settings)


if __name__ == "__main__":
    sys.exit(main())
