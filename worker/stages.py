"""Where a job is, and where its time went."""

import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Generic, TypeVar

T = TypeVar("T")
Report = Callable[[float, str], None]
"""Told the share of something that is done, 0..1, and the name of its stage."""


def silent(share: float, stage: str, preview: object = None) -> None:
    """Tell nobody."""


class Timed(Generic[T]):
    """Passes things on and adds up the time it takes to make them.

    Attributes:
        seconds: Spent so far.
    """

    def __init__(self, things: Iterable[T]) -> None:
        """Take what is made while it is read."""
        self._things = iter(things)
        self.seconds = 0.0

    def __iter__(self) -> Iterator[T]:
        """Make one after the other."""
        return self

    def __next__(self) -> T:
        """Make the next one."""
        start = time.perf_counter()
        try:
            return next(self._things)
        finally:
            self.seconds += time.perf_counter() - start


class Stages:
    """Tells the share of a job that is done, and times each stage."""

    def __init__(self, report: Report) -> None:
        """Begin a job whose progress goes to `report`."""
        self._report = report
        self.timings: dict[str, float] = {}
        """Milliseconds by stage, as `<stage>_ms`."""

    @contextmanager
    def stage(self, name: str, start: float, end: float) -> Iterator[Report]:
        """Run one stage, which takes the job's share from `start` to `end`.

        Yields:
            A report for the stage's own share, 0..1; the names of its parts are not passed on.
        """
        self._report(start, name)
        began = time.perf_counter()
        yield lambda share, _part: self._report(start + (end - start) * share, name)
        self.timings[f"{name}_ms"] = round((time.perf_counter() - began) * 1000, 3)
