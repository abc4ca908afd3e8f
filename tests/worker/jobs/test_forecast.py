"""Work that took 2 and 4 s and was estimated at 1 and 2 s: the double, and 3 s on average."""

import dataclasses
import time

import pytest

from worker.jobs.claims import Claims
from worker.jobs.forecast import Forecast
from worker.jobs.intake import Request

NOW = 5000.0


@pytest.fixture
def requests(make_requests):
    return make_requests(queue_limit=99, slots=2)


@pytest.fixture
def clock(monkeypatch):
    now = [NOW]
    monkeypatch.setattr(time, "time", lambda: now[0])
    return now


@pytest.fixture
def do(requests, database, clock):
    """Record work that was done in so many seconds."""

    def do(seconds, estimate, kind="texture"):
        job = requests.submit(
            Request("a", kind, {}, f"{seconds} {estimate} {kind}", "interactive", 60.0, estimate)
        )
        claims = Claims(database)
        claim = claims.claim()
        clock[0] += seconds
        assert claims.succeed(claim, {}, "here", lambda: None)
        return requests.get("a", job.id)

    return do


@pytest.fixture
def job(requests, do, clock):
    """A queued job, estimated at 5 s, after some history."""
    do(2.0, 1.0)
    do(4.0, 2.0)
    job = requests.submit(Request("a", "texture", {}, "d", "interactive", 60.0, 5.0))
    clock[0] = NOW
    return job


def test_a_queued_job_waits_for_those_before_it_and_then_takes_its_time(database, job):
    """Third in line of two slots: 3 * 3 s / 2, then twice its 5 s."""
    third = dataclasses.replace(job, position=3)

    assert Forecast(database, 2).seconds_left(third) == pytest.approx(4.5 + 10)
    assert Forecast(database, 1).seconds_left(third) == pytest.approx(9 + 10)


@pytest.mark.parametrize(
    ("ran", "progress", "left"),
    [
        (0.0, 0.0, 10.0),
        (4.0, 0.9, 6.0),
        (20.0, 0.8, 5.0),  # longer than expected, and a fifth is left
        (20.0, 0.0, None),
        (-3.0, 0.0, 10.0),  # the clock was set back
    ],
)
def test_a_running_job_takes_what_is_left(database, job, ran, progress, left):
    running = dataclasses.replace(
        job, state="running", position=None, progress=progress, started=NOW - ran
    )

    assert Forecast(database, 2).seconds_left(running) == (
        None if left is None else pytest.approx(left)
    )


def test_without_an_estimate_it_is_the_mean(database, job):
    plain = dataclasses.replace(job, position=None, state="running", started=NOW)
    plain = dataclasses.replace(plain, estimate_seconds=None)

    assert Forecast(database, 2).seconds_left(plain) == pytest.approx(3)


def test_other_kinds_and_no_history_tell_nothing(database, job):
    assert Forecast(database, 2).seconds_left(dataclasses.replace(job, kind="render")) is None


def test_what_is_finished_has_no_time_left(database, do):
    assert Forecast(database, 2).seconds_left(do(1.0, 1.0)) is None


def test_work_without_a_duration_is_no_history_of_negative_time(database, requests, do, clock):
    """The clock was set back while it ran."""
    do(-50.0, 1.0)
    job = requests.submit(Request("a", "texture", {}, "d", "interactive", 60.0, 5.0))

    assert Forecast(database, 2).seconds_left(job) == 0


def test_history_is_looked_up_once_a_second(database, job, monkeypatch):
    forecast, looks = Forecast(database, 2), []
    look = forecast._look
    monkeypatch.setattr(forecast, "_look", lambda kind: looks.append(kind) or look(kind))
    for _ in range(100):
        forecast.seconds_left(job)

    assert looks == ["texture"]
