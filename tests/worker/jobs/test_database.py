import errno
import os
import sqlite3
import threading
import time
from pathlib import Path

import pytest
from sqlalchemy import insert, select, text
from sqlalchemy.exc import OperationalError

from worker.jobs.errors import StorageFullError
from worker.jobs.schema import assets

ROW = {"tenant": "a", "facts": {}, "bytes": 1, "created": 0.0}


@pytest.fixture
def flushes(monkeypatch, tmp_path):
    """The files that are flushed, with how long each was at that time."""
    seen = []
    fsync = os.fsync

    def note(descriptor):
        path = Path(f"/proc/self/fd/{descriptor}").readlink()
        seen.append((path.name, path.stat().st_size))
        fsync(descriptor)

    monkeypatch.setattr(os, "fsync", note)
    return seen


def write(database, sha256, **options):
    with database.writing(**options) as connection:
        connection.execute(insert(assets).values(ROW | {"sha256": sha256}))


def test_a_commit_is_on_the_disk_before_it_is_answered(database, flushes, tmp_path):
    """The write-ahead log holds all of it when it is flushed, and it is flushed."""
    log = tmp_path / "jobs.sqlite-wal"
    before = log.stat().st_size
    write(database, "x")
    assert log.stat().st_size > before
    assert flushes == [(log.name, log.stat().st_size)]
    with database.reading() as connection:
        assert connection.execute(text("PRAGMA journal_mode")).scalar() == "wal"
        assert connection.execute(text("PRAGMA foreign_keys")).scalar() == 1


def test_what_need_not_survive_a_power_cut_is_not_flushed(database, flushes):
    write(database, "x", durably=False)
    assert flushes == []
    database.flush()
    assert len(flushes) == 1


def test_a_flush_holds_up_no_writer_and_serves_all_who_wait_for_the_next(database, monkeypatch):
    begun, go_on, count = threading.Event(), threading.Event(), []

    def slow(_descriptor):
        count.append(1)
        begun.set()
        assert go_on.wait(10)

    monkeypatch.setattr(os, "fsync", slow)
    threads = [threading.Thread(target=write, args=(database, str(n))) for n in range(9)]
    threads[0].start()
    assert begun.wait(10)
    for thread in threads[1:]:
        thread.start()
    deadline = time.monotonic() + 10
    while rows(database) < 9:
        assert time.monotonic() < deadline
    time.sleep(0.05)  # the last one to commit has yet to ask for its flush
    go_on.set()
    for thread in threads:
        thread.join()
    assert len(count) == 2


def test_a_flush_that_fails_is_told_to_everybody(database, monkeypatch):
    def full(_descriptor):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    for _ in range(2):
        with pytest.raises(StorageFullError):
            database.flush()


def rows(database):
    with database.reading() as connection:
        return len(connection.execute(select(assets)).all())


def test_readers_do_not_wait_for_a_writer_and_see_what_was_committed(database):
    with database.writing() as writer:
        writer.execute(insert(assets).values(ROW | {"sha256": "x"}))
        with database.reading() as reader:
            assert reader.execute(select(assets)).all() == []
    with database.reading() as reader:
        assert len(reader.execute(select(assets)).all()) == 1


def test_writers_take_turns(database):
    def write(number):
        for step in range(10):
            with database.writing() as connection:
                connection.execute(insert(assets).values(ROW | {"sha256": f"{number}-{step}"}))

    threads = [threading.Thread(target=write, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with database.reading() as connection:
        assert len(connection.execute(select(assets)).all()) == 80


def test_a_block_that_raises_changes_nothing(database):
    def write_and_fail():
        with database.writing() as connection:
            connection.execute(insert(assets).values(ROW | {"sha256": "x"}))
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        write_and_fail()
    with database.reading() as connection:
        assert connection.execute(select(assets)).all() == []


def test_a_full_disk_is_told_as_such_and_changes_nothing(database):
    with database.writing() as connection:
        pages = connection.execute(text("PRAGMA page_count")).scalar()
        connection.execute(text(f"PRAGMA max_page_count = {pages}"))
    with pytest.raises(StorageFullError), database.writing() as connection:
        connection.execute(insert(assets).values(ROW | {"sha256": "x", "facts": {"a": "b" * 9999}}))
    with database.reading() as connection:
        assert connection.execute(select(assets)).all() == []


@pytest.mark.parametrize("code", [sqlite3.SQLITE_IOERR_WRITE, sqlite3.SQLITE_IOERR_SHMSIZE])
def test_a_quota_is_a_full_disk_too(database, code):
    """SQLite knows no quota, and calls it an input or output error."""
    error = sqlite3.OperationalError("disk I/O error")
    error.sqlite_errorcode = code
    with pytest.raises(StorageFullError), database.reading():
        raise OperationalError("", {}, error)
