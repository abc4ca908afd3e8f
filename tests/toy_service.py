"""The real job engine with children that make pictures of one pixel at once."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from worker.jobs.engine import EmbeddedEngine
from worker.jobs.forkserver import start_forkserver

EXECUTORS = str(Path(__file__).parent / "service" / "executors")


@contextmanager
def toy_executors() -> Iterator[None]:
    """Let children find the executors by name: they get the path of modules from this process."""
    sys.path.insert(0, EXECUTORS)
    start_forkserver()
    yield
    sys.path.remove(EXECUTORS)


@contextmanager
def toy_engine(
    folder: Path, *, executor: str = "toy_executor", **options: int
) -> Iterator[EmbeddedEngine]:
    """Start an engine, and drain it in the end."""
    engine = EmbeddedEngine(folder, executor=executor, measurer="toy_measurer", **options)
    engine.start()
    yield engine
    engine.drain(0)


def warmed(engine: EmbeddedEngine) -> EmbeddedEngine:
    """Wait until every child is warm."""
    while engine.ready().warm_slots < engine.ready().slots:
        time.sleep(0.01)
    return engine
