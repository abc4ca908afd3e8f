"""A service reduced to its engine and one job: argv is the data folder and what the job does.

It prints the job's id. SIGTERM drains and prints the job's state and attempt; SIGUSR1 just ends.
"""

import signal
import sys
from pathlib import Path
from queue import SimpleQueue

from worker.jobs.engine import EmbeddedEngine


def main():
    data = Path(sys.argv[1])
    # Handlers, not a blocked mask: a mask holds for one thread, and a signal that comes before this
    # thread waits for it would end the process through another.
    signals: SimpleQueue[int] = SimpleQueue()
    for expected in (signal.SIGTERM, signal.SIGUSR1):
        signal.signal(expected, lambda number, _: signals.put(number))
    engine = EmbeddedEngine(data, slots=1, memory_limit_bytes=1 << 30, executor="trial_executor")
    engine.start()
    body = {
        "do": sys.argv[2],
        "marker": str(data / "marker"),
        "note_pid": str(data / "pids"),
        "seconds": 1.0,
        "variables": [],
    }
    job = engine.submit("texture", body, "d" * 64, tenant="local")
    sys.stdout.write(f"{job.id}\n")
    sys.stdout.flush()
    if signals.get() == signal.SIGTERM:
        engine.drain(30)
        job = engine.get("local", job.id)
        sys.stdout.write(f"{job.state} {job.attempt}\n")


if __name__ == "__main__":
    main()
