"""What happens to jobs when children, files and callers do their worst."""

import itertools
import os
import signal
import time

import pytest

from worker.jobs import files
from worker.jobs.claims import Claims
from worker.jobs.errors import RecordsBusyError, StorageFullError


def halves(tmp_path):
    return list((tmp_path / "data" / "results").glob("*.part"))


def test_a_job_survives_the_death_of_its_child(engine, submit, finish, wait_until, tmp_path):
    note = tmp_path / "pids"
    marker = str(tmp_path / "marker")
    job = submit(engine, do="sleep once", marker=marker, note_pid=str(note))
    first = int(wait_until(lambda: note.exists() and note.read_text().strip()))
    os.kill(first, signal.SIGKILL)
    done = finish(engine, job)
    assert (done.state, done.attempt) == ("succeeded", 2)
    assert int(note.read_text().split()[1]) != first
    assert halves(tmp_path) == []


def test_poison_fails_after_three_children_and_the_next_job_is_done(
    engine, submit, finish, tmp_path
):
    note = tmp_path / "pids"
    poison = submit(engine, do="segfault", note_pid=str(note))
    good = submit(engine, do="nothing")
    failed = finish(engine, poison)
    assert (failed.state, failed.attempt) == ("failed", 3)
    assert failed.failure["code"] == "worker_lost"
    assert len(set(note.read_text().split())) == 3
    assert finish(engine, good).state == "succeeded"
    assert halves(tmp_path) == []


def test_a_stuck_native_call_fails_at_its_limit_and_is_not_repeated(
    engine, submit, finish, tmp_path
):
    job = submit(engine, limit=0.5, do="stuck")
    good = submit(engine, do="nothing")
    failed = finish(engine, job)
    assert (failed.state, failed.attempt) == ("failed", 1)
    assert failed.failure["code"] == "timed_out"
    assert failed.finished - failed.started >= 0.5
    assert finish(engine, good).state == "succeeded"
    assert halves(tmp_path) == []


def test_cancelling_ends_a_stuck_native_call(engine, submit, finish, wait_until, is_gone, tmp_path):
    note = tmp_path / "pids"
    job = submit(engine, do="stuck", note_pid=str(note))
    pid = int(wait_until(lambda: note.exists() and note.read_text().strip()))
    assert engine.cancel("local", job.id).state == "cancelled"
    wait_until(lambda: is_gone(pid), 5)
    assert finish(engine, submit(engine, do="nothing")).state == "succeeded"
    assert engine.get("local", job.id).state == "cancelled"
    assert halves(tmp_path) == []


def test_cancelling_a_waiting_job_means_that_it_never_runs(engine, submit, begin, finish, tmp_path):
    gate = tmp_path / "gate"
    begin(engine, submit(engine, do="wait", gate=str(gate)))
    job = submit(engine, do="nothing", note_pid=str(tmp_path / "note"))
    last = submit(engine, do="nothing")
    engine.cancel("local", job.id)
    gate.touch()
    finish(engine, last)
    assert engine.get("local", job.id).state == "cancelled"
    assert not (tmp_path / "note").exists()


def test_cancelling_one_of_two_lets_the_other_have_the_result(
    engine, submit, begin, finish, tmp_path
):
    gate = tmp_path / "gate"
    one, two = (submit(engine, "d" * 64, do="wait", gate=str(gate)) for _ in range(2))
    engine.cancel("local", begin(engine, one).id)
    gate.touch()
    assert finish(engine, two).state == "succeeded"
    assert engine.get("local", one.id).state == "cancelled"


def test_a_memory_hog_fails_and_the_next_job_is_done(make_engine, submit, finish):
    engine = make_engine(memory_limit_bytes=200 << 20)
    assert finish(engine, submit(engine, do="hog")).failure["code"] == "memory_exceeded"
    assert finish(engine, submit(engine, do="nothing")).state == "succeeded"


@pytest.mark.parametrize(
    ("do", "code"),
    [("refuse", "refused"), ("stumble", "internal_error"), ("no file", "internal_error")],
)
def test_a_failure_is_kept_with_its_code(engine, submit, finish, do, code):
    failed = finish(engine, submit(engine, do=do))
    assert (failed.state, failed.failure["code"], failed.facts) == ("failed", code, None)


def test_a_disk_that_is_full_in_the_child_is_told(engine, submit, finish):
    assert finish(engine, submit(engine, do="fill disk")).failure["code"] == "storage_full"


def test_a_disk_that_is_full_while_publishing_is_told(
    engine, submit, begin, finish, monkeypatch, tmp_path
):
    def fail(descriptor):
        raise OSError(28, "No space left on device")

    gate = tmp_path / "gate"
    job = begin(engine, submit(engine, do="wait", gate=str(gate)))
    with monkeypatch.context() as patch:
        patch.setattr(files.os, "fsync", fail)
        gate.touch()
        failed = finish(engine, job)
    assert failed.failure["code"] == "storage_full"
    assert list((tmp_path / "data" / "results").iterdir()) == []
    assert finish(engine, submit(engine, do="nothing")).state == "succeeded"


def test_an_outcome_that_cannot_be_recorded_is_recorded_later(engine, submit, finish, monkeypatch):
    """As on a disk on which there is no room for records, until there is."""
    refusals = []
    fail = Claims.fail

    def refuse_twice(self, claim, why):
        if len(refusals) < 2:
            refusals.append(claim)
            raise StorageFullError
        fail(self, claim, why)

    monkeypatch.setattr(Claims, "fail", refuse_twice)
    assert finish(engine, submit(engine, do="refuse")).failure["code"] == "refused"
    assert len(refusals) == 2


def test_a_half_result_leaves_its_room_on_the_disk_to_the_record(
    engine, submit, finish, monkeypatch, tmp_path
):
    seen = []
    fail = Claims.fail

    def look(self, claim, why):
        seen.append(halves(tmp_path))
        fail(self, claim, why)

    monkeypatch.setattr(Claims, "fail", look)
    assert finish(engine, submit(engine, limit=0.2, do="stuck")).failure["code"] == "timed_out"
    assert seen == [[]]


def test_progress_that_cannot_be_recorded_costs_nothing(engine, submit, finish, monkeypatch):
    def refuse(self, claim, progress, stage):
        raise StorageFullError

    monkeypatch.setattr(Claims, "report", refuse)
    assert finish(engine, submit(engine, do="sleep", seconds=0.6)).state == "succeeded"


def test_assets_that_were_deleted_under_running_work_go_with_its_end(
    engine, submit, finish, wait_until, tmp_path
):
    gate = tmp_path / "gate"
    upload = engine.assets.new_upload()
    upload.write_bytes(b"picture")
    engine.assets.put("local", upload, "a" * 64, {})
    job = submit(engine, do="wait", gate=str(gate), asset="a" * 64)
    engine.assets.delete("local", "a" * 64)
    path = tmp_path / "data" / "assets" / "aa" / ("a" * 64)
    assert path.exists()
    gate.touch()
    finish(engine, job)
    wait_until(lambda: not path.exists(), 5)


@pytest.mark.parametrize(("factor", "state"), [(1.5, "succeeded"), (2.5, "failed")])
def test_a_child_may_reserve_twice_its_memory_and_no_more(
    make_engine, submit, finish, factor, state
):
    """One huge allocation is refused when it is made, before the watch could see it."""
    limit = 300 << 20
    engine = make_engine(memory_limit_bytes=limit)
    done = finish(engine, submit(engine, do="reserve", bytes=int(factor * limit)))
    assert done.state == state
    assert finish(engine, submit(engine, do="nothing")).state == "succeeded"


def test_an_outcome_waits_for_records_that_somebody_else_holds(
    engine, submit, begin, finish, tmp_path, monkeypatch
):
    """As during a backup: the finished picture is neither lost nor made again."""
    gate = tmp_path / "gate"
    job = begin(engine, submit(engine, do="wait", gate=str(gate)))
    refusals = []
    succeed = Claims.succeed

    def refuse_twice(self, *arguments):
        if len(refusals) < 2:
            refusals.append(arguments)
            raise RecordsBusyError
        return succeed(self, *arguments)

    monkeypatch.setattr(Claims, "succeed", refuse_twice)
    gate.touch()
    done = finish(engine, job)
    assert (done.state, done.attempt, len(refusals)) == ("succeeded", 1, 2)


def test_a_jumping_clock_harms_nothing(make_engine, submit, finish, monkeypatch):
    """Run times, waits and limits are told by a clock that cannot jump."""
    jumps = itertools.cycle([0.0, 4e8, -4e8])
    true_time = time.time
    monkeypatch.setattr(time, "time", lambda: true_time() + next(jumps))
    engine = make_engine()
    jobs = [submit(engine, do="sleep", seconds=0.05) for _ in range(10)]
    assert {finish(engine, job).state for job in jobs} == {"succeeded"}
    typical = engine.status().typical_seconds
    assert 0.05 <= typical < 5
    assert finish(engine, submit(engine, limit=0.3, do="stuck")).failure["code"] == "timed_out"
    assert all(engine.result_path(engine.get("local", job.id)) for job in jobs)
