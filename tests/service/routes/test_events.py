"""Server-sent events of a job, by an app without a network and by real services."""

import asyncio
import dataclasses
import gc
from types import SimpleNamespace

import pytest

from service import event_stream
from service.routes import events as routes
from service.tenants import tenant
from tests.service.streams import Caller, events
from worker.jobs.watch import Watch


def submit(client, seed, *, wait=0, **output):
    body = {
        "texture": {"technique": "perlin", "seed": seed},
        "output": {"size": [16, 16], **output},
    }
    answer = client.post("/v1/textures", json=body, headers={"Prefer": f"wait={wait}"})
    assert answer.status_code in (200, 202), answer.text
    return answer.json()


@pytest.fixture
def stuck(client):
    """A job that takes a minute, cancelled in the end."""
    job = submit(client, 1002, size=[7, 7])
    yield job
    client.delete(job["links"]["cancel"])


def told(event):
    """What makes an event news."""
    return tuple(event.job[name] for name in ("state", "attempt", "position", "progress", "stage"))


def test_a_finished_job_is_told_once(client):
    job = submit(client, 1, wait=30)
    response = client.get(job["links"]["events"])

    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/event-stream")
    assert response.headers["cache-control"] == "no-store"
    [event] = events(response.text)
    assert event.kind == "end"
    assert event.job == job == client.get(job["links"]["self"]).json()


def test_a_job_is_followed_through_its_stages_to_its_end(client):
    job = submit(client, 1005, size=[31, 1])
    found = events(client.get(job["links"]["events"]).text)
    running = [event.job for event in found if event.job["state"] == "running"]

    assert [event.kind for event in found] == ["progress"] * (len(found) - 1) + ["end"]
    assert found[-1].job["state"] == "succeeded"
    assert found[-1].job["progress"] == 1
    assert {item["stage"] for item in running} & {"draw", "encode"}
    assert len({item["progress"] for item in running}) >= 2
    assert len({event.name for event in found}) == len({told(event) for event in found})


@pytest.mark.parametrize("seed", [1005, 1006])
def test_progress_never_goes_back(client, seed):
    """Seed 1006 reports sevenths, from none to six, and begins again."""
    job = submit(client, seed, size=[32, 1])
    told = [event.job["progress"] for event in events(client.get(job["links"]["events"]).text)]

    assert told == sorted(told)
    assert told[-1] == 1


def test_a_failure_is_told_with_its_reason(client):
    job = submit(client, 1001, size=[33, 1])
    end = events(client.get(job["links"]["events"]).text)[-1]

    assert (end.kind, end.job["state"]) == ("end", "failed")
    assert end.job["failure"]["code"] == "render_failed"


def test_who_has_heard_the_end_is_told_to_stay_away(client):
    """204 is how a server ends an EventSource that would ask for ever."""
    job = submit(client, 1, wait=30)
    [end] = events(client.get(job["links"]["events"]).text)
    again = client.get(job["links"]["events"], headers={"Last-Event-ID": end.name})

    assert (again.status_code, again.content) == (204, b"")


@pytest.mark.parametrize("name", ["", "x", "0" * 16, "é".encode(), "9" * 5000])
def test_an_id_that_nobody_knows_gets_everything(client, name):
    job = submit(client, 1, wait=30)
    response = client.get(job["links"]["events"], headers={"Last-Event-ID": name})

    assert [event.kind for event in events(response.text)] == ["end"]


@pytest.mark.parametrize("job_id", ["0" * 32, "x", "%00", "0" * 999])
def test_unknown_jobs_are_404(client, job_id):
    assert client.get(f"/v1/jobs/{job_id}/events").json()["code"] == "job_unknown"


def test_nobody_follows_another_tenants_job(app, client, stuck):
    app.dependency_overrides[tenant] = lambda: "somebody else"
    try:
        assert client.get(stuck["links"]["events"]).status_code == 404
    finally:
        del app.dependency_overrides[tenant]


def test_a_caller_that_takes_no_events_gets_406(client, stuck):
    response = client.get(stuck["links"]["events"], headers={"Accept": "application/json"})

    assert (response.status_code, response.json()["code"]) == (406, "not_acceptable")


def test_too_many_streams_are_refused(client, stuck, monkeypatch):
    monkeypatch.setattr(routes, "most_streams", lambda: 0)
    response = client.get(stuck["links"]["events"])

    assert (response.status_code, response.json()["code"]) == (429, "too_many_streams")
    assert int(response.headers["retry-after"]) >= 1


def run(coroutine):
    return asyncio.run(coroutine)


def test_a_cancelled_job_ends_its_streams(app, client, stuck):
    async def follow():
        callers = [Caller(app, stuck["links"]["events"]) for _ in range(3)]
        reading = [asyncio.create_task(caller.call()) for caller in callers]
        await asyncio.gather(*(caller.heard(1) for caller in callers))
        await asyncio.to_thread(client.delete, stuck["links"]["cancel"])
        async with asyncio.timeout(10):
            return await asyncio.gather(*reading)

    for caller in run(follow()):
        assert caller.events[-1].kind == "end"
        assert caller.events[-1].job["state"] == "cancelled"


def test_cancelling_against_finishing_ends_each_stream_once_and_with_the_truth(app, client):
    jobs = [submit(client, 0, size=[200, n + 1]) for n in range(30)]

    async def follow():
        callers = [Caller(app, job["links"]["events"]) for job in jobs]
        reading = [asyncio.create_task(caller.call()) for caller in callers]
        for job in jobs:
            await asyncio.to_thread(client.delete, job["links"]["cancel"])
        async with asyncio.timeout(20):
            await asyncio.gather(*reading)
        return callers

    for job, caller in zip(jobs, run(follow()), strict=True):
        assert [event.kind for event in caller.events].count("end") == 1
        assert caller.events[-1].job == client.get(job["links"]["self"]).json()


def test_a_silent_stream_shows_that_it_lives(app, stuck, monkeypatch):
    monkeypatch.setattr(event_stream, "HEARTBEAT_SECONDS", 0.05)

    async def listen():
        caller = Caller(app, stuck["links"]["events"])
        reading = asyncio.create_task(caller.call())
        await caller.until(lambda: caller.text.count("\n: still here\n\n") >= 3)
        caller.gone.set()
        await reading
        return caller

    caller = run(listen())
    assert caller.text.startswith("retry: ")
    assert len(caller.events) <= 2


def test_a_thousand_abandoned_streams_leave_nothing_behind(app, engine, stuck):
    """And while they are open, the records are asked no more often than for one of them."""
    watch = engine.watch
    asked = []
    look = watch._look

    def counted(job_ids):
        asked.append(len(job_ids))
        return look(job_ids)

    async def open_and_leave():
        before = len(asyncio.all_tasks())
        callers = [Caller(app, stuck["links"]["events"]) for _ in range(1000)]
        reading = [asyncio.create_task(caller.call()) for caller in callers]
        await asyncio.gather(*(caller.heard(1) for caller in callers))
        assert watch.followers == 1000
        asked.clear()
        await asyncio.sleep(1.5)
        many = list(asked)
        for caller in callers:
            caller.gone.set()
        async with asyncio.timeout(10):
            await asyncio.gather(*reading)
        assert len(asyncio.all_tasks()) == before
        return many

    watch._look = counted
    try:
        many = run(open_and_leave())
    finally:
        watch._look = look
    gc.collect()

    assert watch.followers == 0
    assert watch._topics == {}
    assert watch._bell._listeners == {}
    assert len(many) <= 4, "a look a second, since nothing was written"
    assert set(many) <= {1}, "one job, however many follow it"


def test_a_slow_reader_gets_the_latest_and_no_backlog(engine, stuck):
    """Twenty news while it reads nothing: what was on its way, and then the last."""
    job = engine.get("local", stuck["id"])
    running = dataclasses.replace(job, state="running", position=None, started=job.created)
    news = [dataclasses.replace(running, progress=n / 20) for n in range(1, 20)]
    news.append(dataclasses.replace(running, state="cancelled", finished=job.created + 1))
    records = {job.id: running}
    watch = Watch(lambda _: dict(records))
    of_engine = SimpleNamespace(watch=watch, forecast=engine.forecast)

    async def follow():
        fast, slow = (Caller(event_stream.EventStream(of_engine, running, None), "/") for _ in "12")
        reading = [asyncio.create_task(caller.call()) for caller in (fast, slow)]
        await slow.heard(1)
        slow.reading.clear()
        for count, item in enumerate(news, 2):
            records[job.id] = item
            watch.wake()
            await fast.heard(count)
        slow.reading.set()
        async with asyncio.timeout(10):
            await asyncio.gather(*reading)
        return fast.events, slow.events

    watch.start()
    try:
        fast, slow = run(follow())
    finally:
        watch.close()
    assert [event.job["progress"] for event in fast[:-1]] == [n / 20 for n in range(20)]
    assert len(slow) <= 3
    assert slow[-1] == fast[-1]
    assert slow[-1].kind == "end"


def test_going_on_where_it_broke_repeats_nothing(app, client):
    async def follow(job):
        first = Caller(app, job["links"]["events"])
        reading = asyncio.create_task(first.call())
        await first.heard(2)
        first.gone.set()
        await reading
        rest = Caller(app, job["links"]["events"], {"Last-Event-ID": first.events[-1].name})
        await rest.call()
        return first.events, rest.events

    first, rest = run(follow(submit(client, 1005, size=[35, 1])))
    assert rest[-1].kind == "end"
    assert first[-1].name not in {event.name for event in rest}
    assert first[-1].job["progress"] <= rest[0].job["progress"]


def test_waiting_jobs_hear_how_they_advance(app, client):
    running = [submit(client, 1002, size=[36, n]) for n in (1, 2)]
    ahead, behind = (submit(client, 1002, size=[36, n]) for n in (3, 4))

    async def follow():
        caller = Caller(app, behind["links"]["events"])
        reading = asyncio.create_task(caller.call())
        await caller.heard(1)
        await asyncio.to_thread(client.delete, ahead["links"]["cancel"])
        await caller.heard(2)
        caller.gone.set()
        await reading
        return caller.events

    try:
        first, second = run(follow())[:2]
    finally:
        for job in (*running, ahead, behind):
            client.delete(job["links"]["cancel"])

    assert first.job["position"] == second.job["position"] + 1
    assert second.job["state"] == "queued"
