"""SQLite as a queue needs it: durable, one writer at a time, readers never blocked.

Commits go to the write-ahead log, which survives the death of any process at once. Those that must
survive a power cut are then flushed, outside the lock of the writers: one flush serves all that
were committed before it began.
"""

import sqlite3
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.exc import DatabaseError, OperationalError

from worker.jobs.errors import RecordsBusyError, RecordsError, StorageFullError
from worker.jobs.files import settle

PATIENCE_SECONDS: Final = 10
PRAGMAS: Final = (
    "journal_mode = WAL",
    "synchronous = NORMAL",
    f"busy_timeout = {1000 * PATIENCE_SECONDS}",
    "foreign_keys = ON",
)
# A quota or a limit of file sizes is an input or output error to SQLite, which knows ENOSPC only.
NO_ROOM: Final = (
    sqlite3.SQLITE_FULL,
    sqlite3.SQLITE_IOERR_WRITE,
    sqlite3.SQLITE_IOERR_FSYNC,
    sqlite3.SQLITE_IOERR_SHMSIZE,
    sqlite3.SQLITE_IOERR_SHMMAP,
    sqlite3.SQLITE_IOERR_TRUNCATE,
)


class Database:
    """The records of one data folder; usable from any thread."""

    def __init__(self, path: Path) -> None:
        # SQLite's own wait for a lock sleeps up to 100 ms; in one process a lock is fair and wakes.
        self._write_lock = threading.Lock()
        self._heard: list[Callable[[], None]] = []
        self._path = path
        self._log = path.with_name(f"{path.name}-wal")
        self._flush_lock = threading.Lock()
        self._flushes_begun = 0
        self._last_good_flush = 0
        self._readers = _engine(path, "BEGIN")
        self._writer = _engine(path, "BEGIN IMMEDIATE")

    def on_write(self, hear: Callable[[], None]) -> None:
        """Have something called after every transaction that changed the records, by its thread."""
        self._heard.append(hear)

    def check(self) -> None:
        """See that the records can be read and written.

        Raises:
            RecordsError: they cannot.
        """
        try:
            with self.writing(durably=False) as connection:
                found = connection.exec_driver_sql("PRAGMA quick_check(1)").scalar()
        except DatabaseError as error:
            raise RecordsError(f"cannot use {self._path}: {error.orig}") from error
        if found != "ok":
            raise RecordsError(f"{self._path} is damaged: {found}")

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """One consistent view of the records."""
        with _told_apart(), self._readers.begin() as connection:
            yield connection

    @contextmanager
    def writing(self, *, durably: bool = True) -> Iterator[Connection]:
        """One transaction, on the disk when the block has ended and undone when it raises.

        Args:
            durably: otherwise a later flush takes it to the disk, and a power cut before that
                undoes it; no crash of a process does.

        Raises:
            RecordsBusyError: another program does not let go of them; nothing was changed.
            StorageFullError: the disk is full; nothing was changed, unless only the flush did not
                succeed: then a power cut may undo what was.
        """
        with _told_apart():
            if not self._write_lock.acquire(timeout=PATIENCE_SECONDS):
                raise RecordsBusyError("too many write to the records")
            try:
                with self._writer.begin() as connection:
                    yield connection
            finally:
                self._write_lock.release()
            for hear in self._heard:
                hear()
            if durably:
                self.flush()

    def flush(self) -> None:
        """Have everything that was committed reach the disk.

        Raises:
            StorageFullError: it did not fit.
        """
        before = self._flushes_begun
        with self._flush_lock:
            if self._last_good_flush > before:
                return  # somebody else's, which began after our commit
            self._flushes_begun += 1
            number = self._flushes_begun
            try:
                settle(self._log)
            except FileNotFoundError:
                return  # folded into the database, which was flushed
            self._last_good_flush = number

    def close(self) -> None:
        """Close every connection; the last one folds the write-ahead log into the database."""
        for engine in (self._readers, self._writer):
            engine.dispose()


@contextmanager
def _told_apart() -> Iterator[None]:
    """Give the errors names that are nobody's mistake."""
    try:
        yield
    except OperationalError as error:
        code = getattr(error.orig, "sqlite_errorcode", None)
        if code in NO_ROOM:
            raise StorageFullError("the disk is full") from error
        if code == sqlite3.SQLITE_BUSY:
            raise RecordsBusyError("another program holds the records") from error
        raise


def _engine(path: Path, begin: str) -> Engine:
    engine = create_engine(f"sqlite:///{path}", pool_size=8, max_overflow=56)

    @event.listens_for(engine, "connect")
    def prepare(connection: Any, _record: object) -> None:
        connection.isolation_level = None  # sqlite3 would begin by itself, and too late
        for pragma in PRAGMAS:
            connection.execute(f"PRAGMA {pragma}")

    @event.listens_for(engine, "begin")
    def begin_at_once(connection: Connection) -> None:
        # Past SQLAlchemy's own way to execute, which costs more than the statement does.
        try:
            connection.connection.cursor().execute(begin)
        except sqlite3.OperationalError as error:
            raise OperationalError(begin, None, error) from error

    return engine
