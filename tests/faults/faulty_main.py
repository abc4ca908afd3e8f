"""`python -m service` on a clock that jumps, with another executor.

argv is a file that holds by how many seconds the clock is wrong, and the name of the executor. Only
what the service calls the time of day jumps. What it measures with a clock that cannot jump,
it does not notice, which is the point.
"""

import sys
import threading
import time
from contextlib import suppress
from functools import partial
from pathlib import Path

from service import app
from service.__main__ import main

LOOK_SECONDS = 0.05


def jump(offsets: Path) -> None:
    """Have the time of day jump whenever the file changes."""
    true_time = time.time
    offset = 0.0

    def read() -> None:
        nonlocal offset
        while True:
            with suppress(ValueError):  # it is being written
                offset = float(offsets.read_text())
            time.sleep(LOOK_SECONDS)

    threading.Thread(target=read, daemon=True).start()
    time.time = lambda: true_time() + offset


if __name__ == "__main__":
    clock, executor = sys.argv[1:]
    jump(Path(clock))
    app.EmbeddedEngine = partial(app.EmbeddedEngine, executor=executor)
    sys.exit(main())
