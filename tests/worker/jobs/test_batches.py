import os

import pytest
from sqlalchemy import func, select

from worker.jobs.batch import Item
from worker.jobs.errors import DrainingError, QueueFullError
from worker.jobs.idempotency import Key
from worker.jobs.intake import Request
from worker.jobs.room import IN_BATCHES
from worker.jobs.schema import batch_items, batches, idempotency_keys, jobs, work

TABLES = (batches, batch_items, jobs, work, idempotency_keys)


def item(values=None, *, digest=None, priority="batch", tenant="local", **body):
    digest = digest or os.urandom(32).hex()
    return Item(Request(tenant, "texture", body, digest, priority, 30.0, 0.1), values)


def counts(engine):
    with engine._data.database.reading() as connection:
        return [
            connection.execute(select(func.count()).select_from(table)).scalar_one()
            for table in TABLES
        ]


@pytest.fixture
def end(wait_until):
    """Waits for the end of a batch and returns it."""

    def end(engine, batch):
        def ended():
            now = engine.batches.get(batch.tenant, batch.id)
            return now if now.finished is not None else None

        return wait_until(ended)

    return end


def test_a_batch_is_done_and_tells_what_became_of_each(engine, end):
    items = [item({"/a": n}, do="write", bytes=n) for n in range(5)] + [item(do="refuse")]
    batch = engine.batches.submit("local", items)
    assert (batch.size, batch.counts, batch.progress, batch.finished) == (
        6,
        {"queued": 6},
        0.0,
        None,
    )
    done = end(engine, batch)
    assert done.counts == {"succeeded": 5, "failed": 1}
    assert done.progress == 1
    entries = engine.batches.entries(batch.id)
    assert [entry.place for entry in entries] == list(range(6))
    assert [entry.values for entry in entries] == [{"/a": n} for n in range(5)] + [None]
    assert [(entry.facts or {}).get("bytes") for entry in entries] == [0, 1, 2, 3, 4, None]
    assert entries[5].failure["code"] == "refused"
    assert [entry.digest for entry in entries] == [one.request.digest for one in items]


def test_a_batch_that_does_not_fit_leaves_no_trace(engine):
    full = [item(do="wait", gate="/never") for _ in range(1000)]
    for _ in range(IN_BATCHES // 1000):
        engine.batches.submit("local", full)
        full = [item(do="wait", gate="/never") for _ in range(1000)]
    before = counts(engine)
    with pytest.raises(QueueFullError) as refusal:
        engine.batches.submit("local", full, Key("r", "k", "f"))
    assert refusal.value.retry_after_seconds >= 1
    assert counts(engine) == before


def test_a_batch_survives_a_restart(make_engine, end, tmp_path, wait_until):
    engine = make_engine()
    gate = tmp_path / "gate"
    note = tmp_path / "note"
    items = [item(do="wait", gate=str(gate), note_pid=str(note)) for _ in range(3)]
    batch = engine.batches.submit("local", items, Key("r", "k", "f"))
    wait_until(note.exists)
    engine.drain(0)
    gate.touch()
    engine = make_engine()
    assert engine.batches.replayed("local", Key("r", "k", "f")).id == batch.id
    assert end(engine, batch).counts == {"succeeded": 3}


def test_equal_items_share_their_work_at_the_pace_of_the_most_urgent(engine, tmp_path, wait_until):
    gate = tmp_path / "gate"
    engine.submit("texture", {"do": "wait", "gate": str(gate)}, "0" * 64, tenant="local")
    items = [
        item(digest="2" * 64, do="nothing"),
        item(digest="1" * 64, do="nothing"),
        item(digest="1" * 64, do="nothing", priority="interactive"),
    ]
    batch = engine.batches.submit("local", items)
    found = [engine.get("local", entry.job_id) for entry in engine.batches.entries(batch.id)]
    assert found[0].work_id != found[1].work_id == found[2].work_id
    assert found[0].position > found[1].position
    assert [job.priority for job in found] == ["batch", "batch", "interactive"]
    gate.touch()


def test_what_is_there_already_is_not_done_again(engine, finish, submit):
    done = finish(engine, submit(engine, "d" * 64, do="nothing"))
    batch = engine.batches.submit("local", [item(digest="d" * 64, do="nothing")])
    assert batch.counts == {"succeeded": 1}
    assert batch.finished >= batch.created > done.finished


def test_cancelling_stops_what_runs_and_what_waits(engine, submit, finish, wait_until, tmp_path):
    note = tmp_path / "note"
    items = [item(do="sleep", seconds=60, note_pid=str(note)) for _ in range(20)]
    batch = engine.batches.submit("local", items)
    wait_until(note.exists)
    assert engine.batches.cancel("local", batch.id).counts == {"cancelled": 20}
    assert finish(engine, submit(engine, do="nothing"), 20).state == "succeeded", "the slot is free"
    assert engine.batches.cancel("local", batch.id).counts == {"cancelled": 20}
    assert engine.batches.cancel("other", batch.id) is None
    assert engine.batches.cancel("local", "0" * 32) is None


def test_cancelling_leaves_work_that_others_want(engine, submit, finish):
    batch = engine.batches.submit("local", [item(digest="d" * 64, do="sleep", seconds=0.2)])
    other = submit(engine, "d" * 64, do="sleep", seconds=0.2)
    assert engine.batches.cancel("local", batch.id).counts == {"cancelled": 1}
    assert finish(engine, other).state == "succeeded"
    assert engine.batches.get("local", batch.id).counts == {"cancelled": 1}


def test_a_stopping_engine_takes_no_batch(engine):
    engine.drain(0)
    with pytest.raises(DrainingError):
        engine.batches.submit("local", [item(do="nothing")])
