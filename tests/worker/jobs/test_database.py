import threading

import pytest
from sqlalchemy import insert, select, text

from worker.jobs.errors import StorageFullError
from worker.jobs.schema import assets

ROW = {"tenant": "a", "facts": {}, "bytes": 1, "created": 0.0}


def test_a_commit_is_on_the_disk_before_it_is_answered(database):
    with database.reading() as connection:
        assert connection.execute(text("PRAGMA journal_mode")).scalar() == "wal"
        assert connection.execute(text("PRAGMA synchronous")).scalar() == 2  # FULL
        assert connection.execute(text("PRAGMA foreign_keys")).scalar() == 1


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
