import asyncio
import time

import pytest

from worker.jobs.engine import EmbeddedEngine
from worker.jobs.errors import DataFolderInUseError, DrainingError, QueueFullError


def wait(engine, job, seconds=30.0):
    return asyncio.run(engine.finished(job, seconds))


def test_a_job_is_queued_done_and_its_result_kept(engine, submit):
    job = submit(engine, do="write", bytes=1234)
    assert (job.state, job.kind, job.tenant) == ("queued", "texture", "local")
    done = wait(engine, job)
    assert (done.state, done.attempt, done.progress) == ("succeeded", 1, 1.0)
    assert done.facts == {"bytes": 1234}
    assert done.created <= done.started <= done.finished
    assert engine.result_path(done).read_bytes() == b"\7" * 1234
    assert engine.get("local", job.id) == done
    assert engine.list("local") == ([done], None)
    assert engine.get("other", job.id) is None


def test_the_executor_is_told_all_it_needs(engine, submit, tmp_path):
    facts = wait(engine, submit(engine, "d" * 64, do="describe", variables=[])).facts
    assert facts["request"] == {
        "kind": "texture",
        "digest": "d" * 64,
        "assets": str(tmp_path / "data" / "assets"),
    }


def test_the_same_request_is_done_once(engine, submit, tmp_path):
    note = str(tmp_path / "note")
    jobs = [submit(engine, "d" * 64, do="sleep", seconds=0.2, note_pid=note) for _ in range(5)]
    assert {wait(engine, job).state for job in jobs} == {"succeeded"}
    again = submit(engine, "d" * 64, do="sleep", seconds=0.2, note_pid=note)
    assert again.state == "succeeded"
    assert (tmp_path / "note").read_text().count("\n") == 1


def test_an_evicted_result_is_made_again(engine, submit):
    done = wait(engine, submit(engine, "d" * 64, do="nothing"))
    engine.result_path(done).unlink()
    assert engine.result_path(done) is None
    again = submit(engine, "d" * 64, do="nothing")
    assert again.state == "queued"
    assert engine.result_path(wait(engine, again)) is not None


def test_a_result_of_another_platform_is_made_again(make_engine, submit, wait_until):
    engine = make_engine()
    first = wait(engine, submit(engine, "d" * 64, do="nothing"))
    engine.drain(5)
    engine = make_engine(executor="other_platform_executor")
    wait_until(lambda: engine.ready().warm_slots)
    assert engine.ready().fingerprint == "elsewhere"
    again = submit(engine, "d" * 64, do="nothing")
    assert (again.state, again.work_id == first.work_id) == ("queued", False)


def test_progress_and_stage_are_seen_while_it_runs(engine, submit, wait_until):
    job = submit(engine, do="sleep", seconds=20.0)
    running = wait_until(lambda: (now := engine.get("local", job.id)).progress > 0.02 and now)
    assert (running.state, running.stage) == ("running", "sleeping")
    assert 0.02 < running.progress < 1


def test_waiting_ends_with_the_job_or_the_time(engine, submit):
    quick = submit(engine, do="sleep", seconds=0.1)
    slow = submit(engine, do="sleep", seconds=9.0)

    async def all_of_them():
        return await asyncio.gather(
            *(engine.finished(quick, 30) for _ in range(50)),
            engine.finished(slow, 0.2),
        )

    *quickly, slowly = asyncio.run(all_of_them())
    assert {job.state for job in quickly} == {"succeeded"}
    assert slowly.state in ("queued", "running")


def test_waiting_ends_with_a_cancellation(engine, submit, begin):
    job, other = (submit(engine, "d" * 64, do="sleep", seconds=9.0) for _ in range(2))
    begin(engine, job)

    async def cancel_meanwhile():
        waiting = asyncio.create_task(engine.finished(job, 30))
        await asyncio.sleep(0.1)
        await asyncio.to_thread(engine.cancel, "local", job.id)
        async with asyncio.timeout(5):
            return await waiting

    assert asyncio.run(cancel_meanwhile()).state == "cancelled"
    assert engine.get("local", other.id).state == "running"


def test_jobs_wait_their_turn_and_know_their_place(engine, submit, begin, finish, tmp_path):
    gate = tmp_path / "gate"
    begin(engine, submit(engine, do="wait", gate=str(gate)))
    batch = submit(engine, do="nothing", priority="batch")
    interactive = submit(engine, do="nothing")
    assert engine.get("local", batch.id).position == 2
    assert interactive.position == 1
    gate.touch()
    batch, interactive = finish(engine, batch), finish(engine, interactive)
    assert interactive.finished <= batch.started


def test_a_full_queue_says_when_to_come_back(make_engine, submit, begin):
    engine = make_engine(queue_limit=2)
    begin(engine, submit(engine, do="sleep", seconds=9.0))
    for _ in range(2):
        submit(engine, do="nothing")
    with pytest.raises(QueueFullError) as refusal:
        submit(engine, do="nothing")
    assert refusal.value.retry_after_seconds >= 1


def test_slots_work_side_by_side(make_engine, submit, wait_until):
    engine = make_engine(slots=2)
    for _ in range(2):
        submit(engine, do="sleep", seconds=9.0)
    wait_until(lambda: engine.ready().running == 2)

    assert engine.ready().queued == 0


def test_readiness_tells_of_slots_and_platform(make_engine, wait_until):
    engine = make_engine(slots=2)
    wait_until(lambda: engine.ready().warm_slots == 2)
    ready = engine.ready()
    assert (ready.slots, ready.fingerprint, ready.draining) == (2, "trial", False)
    assert (ready.queued, ready.running) == (0, 0)


def test_an_executor_that_cannot_be_warmed_up_is_not_ready_and_loses_nothing(make_engine, submit):
    engine = make_engine(executor="cold_executor")
    job = submit(engine, do="nothing")
    time.sleep(0.3)
    assert engine.ready().warm_slots == 0
    assert engine.get("local", job.id).state == "queued"


def test_draining_finishes_what_runs_and_keeps_what_waits(make_engine, submit, begin, finish):
    engine = make_engine()
    running = begin(engine, submit(engine, do="sleep", seconds=0.5))
    waiting = submit(engine, do="nothing")
    engine.drain(30)
    with pytest.raises(DrainingError):
        submit(engine, do="nothing")
    engine = make_engine()
    assert engine.get("local", running.id).state == "succeeded"
    assert finish(engine, waiting).state == "succeeded"


def test_draining_puts_back_what_takes_too_long(make_engine, submit, finish, wait_until, tmp_path):
    engine = make_engine()
    job = submit(engine, do="sleep once", marker=str(tmp_path / "marker"))
    wait_until((tmp_path / "marker").exists)
    engine.drain(0.1)
    engine = make_engine()
    done = finish(engine, job)
    assert (done.state, done.attempt) == ("succeeded", 2)


def test_one_engine_for_each_data_folder(make_engine, tmp_path):
    make_engine()
    with pytest.raises(DataFolderInUseError):
        EmbeddedEngine(tmp_path / "data").start()


def test_half_files_are_swept_at_start(make_engine, submit, finish, tmp_path):
    engine = make_engine()
    done = finish(engine, submit(engine, do="nothing"))
    engine.drain(5)
    half = tmp_path / "data" / "results" / "0.1.part"
    half.write_bytes(b"half")
    engine = make_engine()
    assert not half.exists()
    assert engine.result_path(done).read_bytes() == b"result"


def test_caches_of_outdated_sources_are_removed(make_engine, tmp_path):
    outdated = tmp_path / "data" / "cache" / "numba-outdated" / "kernels"
    outdated.mkdir(parents=True)
    make_engine()
    (cache,) = (tmp_path / "data" / "cache").glob("numba-*")
    assert not outdated.exists()
    assert cache.is_dir()
