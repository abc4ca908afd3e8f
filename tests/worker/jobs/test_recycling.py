"""A child that has done enough is replaced by one that is warm already."""

import pytest

from worker.jobs.errors import SlotError
from worker.jobs.slot import Slot


@pytest.fixture
def pids(tmp_path):
    """The process that did each job so far."""
    note = tmp_path / "pids"
    note.touch()
    return lambda: note.read_text().split()


@pytest.fixture
def do(submit, finish, tmp_path):
    def do(engine, times, **body):
        for _ in range(times):
            done = finish(engine, submit(engine, note_pid=str(tmp_path / "pids"), **body))
            assert (done.state, done.attempt) == ("succeeded", 1)

    return do


def restarts(engine, cause):
    value = engine.meters.registry.get_sample_value
    return value("texloom_slot_restarts_total", {"cause": cause})


def test_a_fresh_child_takes_over_after_so_many_jobs(make_engine, do, pids, wait_until, is_gone):
    engine = make_engine(recycle_after=3)
    do(engine, 3, do="nothing")
    wait_until(lambda: restarts(engine, "recycled") == 1)
    do(engine, 1, do="nothing")
    first, fresh = pids()[0], pids()[3]
    assert pids()[:3] == [first] * 3
    assert fresh != first
    wait_until(lambda: is_gone(int(first)), 5)
    assert restarts(engine, "died_idle") == 0


def test_work_goes_on_with_the_old_child_while_the_fresh_one_warms_up(
    make_engine, do, pids, monkeypatch
):
    engine = make_engine(recycle_after=2)
    do(engine, 1, do="nothing")
    desk = engine._crew._threads[0]._desk
    with desk.warming:  # nobody becomes warm as long as this is held
        do(engine, 6, do="nothing")
        assert len(set(pids())) == 1
        assert engine.ready().warm_slots == 1


def test_a_child_that_cannot_be_replaced_goes_on(make_engine, do, pids, monkeypatch, wait_until):
    engine = make_engine(recycle_after=2)
    do(engine, 1, do="nothing")
    tried = []

    def fail(self):
        tried.append(self)
        raise SlotError("no memory for another")

    monkeypatch.setattr(Slot, "start", fail)
    do(engine, 4, do="nothing")
    wait_until(lambda: tried)
    do(engine, 4, do="nothing")
    assert len(set(pids())) == 1


def test_draining_leaves_no_replacement_behind(make_engine, do, pids):
    engine = make_engine(recycle_after=1)
    do(engine, 2, do="nothing")
    engine.drain(5)
    assert all(not thread.is_alive() for thread in engine._crew._threads)
    assert engine._crew._threads[0]._replacement is None or not (
        engine._crew._threads[0]._replacement.slot.is_alive()
    )


@pytest.mark.parametrize(
    ("body", "cause"),
    [
        ({"do": "segfault"}, "crashed"),
        ({"do": "stuck", "limit": 0.2}, "timed_out"),
        ({"do": "exhaust"}, "memory_exceeded"),
    ],
)
def test_restarts_are_counted_by_their_cause(make_engine, submit, finish, wait_until, body, cause):
    engine = make_engine()
    finish(engine, submit(engine, **body))
    finish(engine, submit(engine, do="nothing"))
    times = 3 if cause == "crashed" else 1
    wait_until(lambda: restarts(engine, cause) >= times)
    counted = {name: restarts(engine, name) for name in ("crashed", "timed_out", "memory_exceeded")}
    assert counted == dict.fromkeys(counted, 0) | {cause: times}
