"""SQLite as a queue needs it: durable, one writer at a time, readers never blocked."""

import sqlite3
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.exc import OperationalError

from worker.jobs.errors import StorageFullError

PRAGMAS: Final = (
    "journal_mode = WAL",
    "busy_timeout = 10000",
    "foreign_keys = ON",
)


class Database:
    """The records of one data folder; usable from any thread."""

    def __init__(self, path: Path) -> None:
        # SQLite's own wait for a lock sleeps up to 100 ms; in one process a lock is fair and wakes.
        self._write_lock = threading.Lock()
        self._heard: list[Callable[[], None]] = []
        self._readers = _engine(path, "FULL", "BEGIN")
        self._writer = _engine(path, "FULL", "BEGIN IMMEDIATE")
        self._quick_writer = _engine(path, "NORMAL", "BEGIN IMMEDIATE")

    def on_write(self, hear: Callable[[], None]) -> None:
        """Have something called after every transaction that changed the records, by its thread."""
        self._heard.append(hear)

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """One consistent view of the records."""
        with self._readers.begin() as connection:
            yield connection

    @contextmanager
    def writing(self, *, durably: bool = True) -> Iterator[Connection]:
        """One transaction, on the disk when the block ends and undone when it raises.

        Args:
            durably: otherwise the next durable one takes it to the disk, and a power cut before
                that undoes it; no crash of a process does.

        Raises:
            StorageFullError: the disk is full; nothing was changed.
        """
        with self._write_lock:
            try:
                with (self._writer if durably else self._quick_writer).begin() as connection:
                    yield connection
            except OperationalError as error:
                if getattr(error.orig, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
                    raise StorageFullError("the disk is full") from error
                raise
        for hear in self._heard:
            hear()

    def close(self) -> None:
        """Close every connection; the last one folds the write-ahead log into the database."""
        for engine in (self._readers, self._quick_writer, self._writer):
            engine.dispose()


def _engine(path: Path, synchronous: str, begin: str) -> Engine:
    engine = create_engine(f"sqlite:///{path}", pool_size=8, max_overflow=56)

    @event.listens_for(engine, "connect")
    def prepare(connection: Any, _record: object) -> None:
        connection.isolation_level = None  # sqlite3 would begin by itself, and too late
        for pragma in (*PRAGMAS, f"synchronous = {synchronous}"):
            connection.execute(f"PRAGMA {pragma}")

    @event.listens_for(engine, "begin")
    def begin_at_once(connection: Connection) -> None:
        connection.exec_driver_sql(begin)

    return engine
