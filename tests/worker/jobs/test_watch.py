"""Followers of jobs that a test makes up, and a look that answers what the test wants."""

import asyncio
import dataclasses
import hashlib
import threading

import pytest
from sqlalchemy.exc import OperationalError

from worker.jobs.job import Job
from worker.jobs.watch import Watch, news_id

JOB = Job(
    id="j",
    tenant="t",
    kind="texture",
    priority="batch",
    digest="d",
    state="queued",
    attempt=0,
    progress=0.0,
    stage=None,
    created=0.0,
    started=None,
    finished=None,
    failure=None,
    facts=None,
    position=1,
    estimate_seconds=None,
    work_id="w",
)


class Records:
    """What a look finds, and how often was looked."""

    def __init__(self):
        self.jobs = {"j": JOB}
        self.looks = []
        self.broken = False

    def look(self, job_ids):
        self.looks.append(set(job_ids))
        if self.broken:
            raise OperationalError("SELECT", {}, Exception("database is locked"))
        return {job_id: self.jobs[job_id] for job_id in job_ids if job_id in self.jobs}

    def change(self, **values):
        self.jobs["j"] = dataclasses.replace(self.jobs["j"], **values)


@pytest.fixture
def records():
    return Records()


@pytest.fixture
def watch(records):
    watch = Watch(records.look)
    watch.start()
    yield watch
    watch.close()
    assert watch.followers == 0


def follow(watch, meanwhile, *, followers=1, patience=5.0):
    """What each of some followers has heard after `meanwhile` was called."""

    async def one(ready):
        with watch.following(JOB) as follower:
            ready.release()
            changed = await follower.changed(patience)
            return changed, follower.job, follower.is_over

    async def run():
        ready = asyncio.Semaphore(0)
        tasks = [asyncio.create_task(one(ready)) for _ in range(followers)]
        for _ in tasks:
            await ready.acquire()
        await asyncio.to_thread(meanwhile)
        return await asyncio.gather(*tasks)

    return asyncio.run(run())


def test_all_followers_hear_the_same_news_from_one_look(watch, records):
    def meanwhile():
        records.change(state="running", position=None, attempt=1)
        watch.wake()

    heard = follow(watch, meanwhile, followers=200)

    assert heard == [(True, records.jobs["j"], False)] * 200
    assert all(asked == {"j"} for asked in records.looks)
    assert len(records.looks) <= 3


def test_news_from_nowhere_is_found_within_a_second(watch, records):
    """Somebody else may write to the same records without telling."""
    [(changed, job, _)] = follow(watch, lambda: records.change(progress=0.5), patience=3)

    assert (changed, job.progress) == (True, 0.5)


def test_what_is_no_news_wakes_nobody(watch, records):
    def meanwhile():
        records.change(estimate_seconds=7.0)
        watch.wake()

    assert follow(watch, meanwhile, patience=1.3)[0][0] is False


def test_nobody_looks_when_nobody_follows(watch, records):
    for _ in range(100):
        watch.wake()
    threading.Event().wait(0.3)

    assert records.looks == []


def test_a_job_that_is_gone_sends_its_followers_home(watch, records):
    def meanwhile():
        records.jobs.clear()
        watch.wake()

    assert follow(watch, meanwhile) == [(True, JOB, True)]


def test_records_that_cannot_be_read_are_asked_again(watch, records):
    def meanwhile():
        records.broken = True
        watch.wake()
        threading.Event().wait(0.2)
        records.broken = False
        records.change(state="succeeded", position=None)

    [(changed, job, is_over)] = follow(watch, meanwhile)
    assert (changed, job.state, is_over) == (True, "succeeded", True)


def test_closing_tells_the_last_news_and_sends_everybody_home(records):
    watch = Watch(records.look)
    watch.start()

    def meanwhile():
        records.change(state="succeeded", position=None)
        watch.close()

    assert follow(watch, meanwhile, followers=3) == [(True, records.jobs["j"], True)] * 3


def test_who_comes_after_closing_is_sent_home_at_once(records):
    watch = Watch(records.look)
    watch.start()
    watch.close()

    async def late():
        with watch.following(JOB) as follower:
            return follower.is_over

    assert asyncio.run(late())


def test_a_follower_that_is_cancelled_leaves_nothing(watch):
    async def run():
        ready = asyncio.Semaphore(0)

        async def wait():
            with watch.following(JOB) as follower:
                ready.release()
                await follower.changed(60)

        tasks = [asyncio.create_task(wait()) for _ in range(50)]
        for _ in tasks:
            await ready.acquire()
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    asyncio.run(run())
    assert (watch.followers, watch._topics, watch._bell._listeners) == (0, {}, {})


@pytest.mark.parametrize(
    "change",
    [{"state": "running"}, {"attempt": 1}, {"position": 2}, {"progress": 0.1}, {"stage": "x"}],
)
def test_every_news_has_a_name_of_its_own(change):
    assert news_id(dataclasses.replace(JOB, **change)) != news_id(JOB)


def test_equal_news_has_equal_names_in_every_process():
    """Callers bring them back after a restart: the beginning of what `sha256sum` tells of this."""
    told = '["queued", 0, 1, 0.0, null]'
    assert hashlib.sha256(told.encode()).hexdigest().startswith("03edef4c2710610f")
    assert news_id(JOB) == news_id(dataclasses.replace(JOB, id="k")) == "03edef4c2710610f"
