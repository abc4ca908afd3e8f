"""SQLite as a queue needs it: durable, one writer at a time, readers never blocked."""

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, create_engine, event
from sqlalchemy.exc import OperationalError

from worker.jobs.errors import StorageFullError

PRAGMAS: Final = (
    "journal_mode = WAL",
    "synchronous = FULL",  # a job that was accepted survives a power cut
    "busy_timeout = 10000",
    "foreign_keys = ON",
)


class Database:
    """The records of one data folder; usable from any thread."""

    def __init__(self, path: Path) -> None:
        # SQLite's own wait for a lock sleeps up to 100 ms; in one process a lock is fair and wakes.
        self._write_lock = threading.Lock()
        self._engine = create_engine(f"sqlite:///{path}", pool_size=8, max_overflow=56)
        event.listen(self._engine, "connect", _prepare)
        event.listen(self._engine, "begin", _begin)
        self._writer = self._engine.execution_options(begin="BEGIN IMMEDIATE")

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """One consistent view of the records."""
        with self._engine.begin() as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """One transaction, durable when the block ends and undone when it raises.

        Raises:
            StorageFullError: the disk is full; nothing was changed.
        """
        with self._write_lock:
            try:
                with self._writer.begin() as connection:
                    yield connection
            except OperationalError as error:
                if getattr(error.orig, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
                    raise StorageFullError("the disk is full") from error
                raise

    def close(self) -> None:
        """Close every connection; the last one folds the write-ahead log into the database."""
        self._engine.dispose()


def _prepare(connection: Any, _record: object) -> None:
    connection.isolation_level = None  # sqlite3 would begin by itself, and too late
    for pragma in PRAGMAS:
        connection.execute(f"PRAGMA {pragma}")


def _begin(connection: Connection) -> None:
    connection.exec_driver_sql(connection.get_execution_options().get("begin", "BEGIN"))
