"""The store and the records stay in step, through starts and evictions."""

import logging
import sqlite3

import pytest

from worker.jobs import results as results_module
from worker.jobs.errors import RecordsError, StorageFullError
from worker.jobs.results import Limits


@pytest.fixture
def results(tmp_path):
    return tmp_path / "data" / "results"


def evicted(tmp_path):
    records = sqlite3.connect(tmp_path / "data" / "jobs.sqlite")
    count = records.execute("SELECT count(*) FROM work WHERE evicted IS NOT NULL").fetchone()[0]
    records.close()
    return count


def test_an_evicted_result_is_made_again_when_it_is_asked_for(
    make_engine, submit, finish, results, tmp_path, monkeypatch
):
    monkeypatch.setattr(results_module, "GRACE_SECONDS", 0.0)
    engine = make_engine(keep=Limits(bytes=0))
    first = finish(engine, submit(engine, "d" * 64, do="nothing"))
    engine._data._housekeeping.evict()
    assert (engine.result_path(first), evicted(tmp_path)) == (None, 1)
    again = finish(engine, submit(engine, "d" * 64, do="nothing"))
    assert again.work_id != first.work_id
    assert engine.result_path(again).read_bytes() == b"result"


def test_a_result_that_vanished_is_noticed_at_the_start_once(
    make_engine, submit, finish, results, tmp_path, caplog
):
    engine = make_engine()
    lost, kept = (finish(engine, submit(engine, do="nothing")) for _ in range(2))
    engine.drain(5)
    (results / lost.work_id).unlink()
    with caplog.at_level(logging.WARNING):
        engine = make_engine()
    assert "1 results are missing" in caplog.text
    assert engine.result_path(engine.get("local", lost.id)) is None
    assert engine.result_path(engine.get("local", kept.id)) is not None
    engine.drain(5)
    caplog.clear()
    make_engine()
    assert "missing" not in caplog.text


def test_an_upload_that_vanished_has_to_be_sent_again(make_engine, tmp_path, caplog):
    engine = make_engine()
    for name in ("a", "b"):
        upload = engine.assets.new_upload()
        upload.write_bytes(b"picture")
        engine.assets.put("local", upload, name * 64, {})
    engine.drain(5)
    (tmp_path / "data" / "assets" / "aa" / ("a" * 64)).write_bytes(b"pic")
    engine = make_engine()
    assert "1 uploads are missing" in caplog.text
    assert engine.assets.get("local", "a" * 64) is None
    assert engine.assets.get("local", "b" * 64) is not None


def test_uploads_have_a_limit_together_and_are_never_evicted(make_engine):
    engine = make_engine(assets_bytes_limit=10)

    def put(name, tenant="local"):
        upload = engine.assets.new_upload()
        upload.write_bytes(b"123456")
        try:
            engine.assets.put(tenant, upload, name * 64, {})
        finally:
            upload.unlink(missing_ok=True)

    put("a")
    put("a", "other")  # the same bytes take no more room
    with pytest.raises(StorageFullError, match="10 bytes"):
        put("b")
    assert (engine.assets.bytes, engine.assets.get("local", "b" * 64)) == (6, None)
    assert engine.assets.get("local", "a" * 64) is not None


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"this is no database, and long enough to be seen as none" * 99, "not a database"),
        (b"SQLite format 3\0" + b"\xff" * 8000, "jobs.sqlite"),
    ],
)
def test_records_that_are_damaged_are_told_as_such(make_engine, tmp_path, content, why):
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "jobs.sqlite").write_bytes(content)
    with pytest.raises(RecordsError, match=why):
        make_engine()
    assert (tmp_path / "data" / "jobs.sqlite").read_bytes() == content


def test_a_damaged_page_is_found_before_anything_is_done(make_engine, submit, finish, tmp_path):
    engine = make_engine()
    finish(engine, submit(engine, do="nothing"))
    engine.drain(5)
    path = tmp_path / "data" / "jobs.sqlite"
    content = bytearray(path.read_bytes())
    content[4096 * 2 : 4096 * 3] = b"\xa5" * 4096
    path.write_bytes(content)
    with pytest.raises(RecordsError):
        make_engine()


def test_records_of_a_newer_version_are_told_as_such(make_engine, tmp_path):
    make_engine().drain(5)
    records = sqlite3.connect(tmp_path / "data" / "jobs.sqlite")
    records.execute("UPDATE alembic_version SET version_num = 'r9999'")
    records.commit()
    records.close()
    with pytest.raises(RecordsError, match="newer version"):
        make_engine()
