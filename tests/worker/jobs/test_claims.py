import pytest

from worker.jobs.claims import MOST_ATTEMPTS, Claims
from worker.jobs.intake import Request

LOST = {"code": "worker_lost", "message": "gone", "pointer": None}


@pytest.fixture
def claims(database):
    return Claims(database)


@pytest.fixture
def requests(make_requests):
    return make_requests()


@pytest.fixture
def job(requests):
    return requests.submit(Request("a", "texture", {"x": 0.1}, "d", "interactive", 60.0))


def test_a_claim_carries_the_request(claims, job):
    claim = claims.claim()
    assert (claim.kind, claim.body, claim.digest) == ("texture", {"x": 0.1}, "d")
    assert (claim.attempt, claim.time_limit_seconds) == (1, 60.0)
    assert claims.claim() is None


def test_a_stale_attempt_can_change_nothing(claims, requests, job):
    stale = claims.claim()
    claims.recover()
    current = claims.claim()
    assert (stale.attempt, current.attempt) == (1, 2)
    published = []
    assert not claims.succeed(stale, {"of": "stale"}, "f", lambda: published.append("stale"))
    claims.fail(stale, LOST)
    claims.report(stale, 0.9, "stale")
    claims.put_back(stale)
    claims.crash(stale, LOST)
    now = requests.get("a", job.id)
    assert (now.state, now.attempt, now.progress, now.stage) == ("running", 2, 0.0, None)
    assert claims.succeed(current, {"of": "current"}, "f", lambda: published.append("current"))
    assert requests.get("a", job.id).facts == {"of": "current"}
    assert published == ["current"]


def test_finished_work_stays_as_it_ended(claims, requests, job):
    claim = claims.claim()
    assert claims.succeed(claim, {"n": 1}, "f", lambda: None)
    assert not claims.succeed(claim, {"n": 2}, "f", lambda: None)
    claims.fail(claim, LOST)
    claims.recover()
    now = requests.get("a", job.id)
    assert (now.state, now.facts, now.progress) == ("succeeded", {"n": 1}, 1.0)
    assert now.created <= now.started <= now.finished


def test_success_is_undone_when_publishing_fails(claims, requests, job):
    def publish():
        raise FileNotFoundError

    with pytest.raises(FileNotFoundError):
        claims.succeed(claims.claim(), {}, "f", publish)
    assert requests.get("a", job.id).state == "running"


def test_the_third_crash_is_a_failure(claims, requests, job):
    for crash in (1, 2, 3):
        claim = claims.claim()
        assert claim.attempt == crash
        claims.crash(claim, LOST)
    assert claims.claim() is None
    now = requests.get("a", job.id)
    assert (now.state, now.failure, now.attempt) == ("failed", LOST, 3)


def test_work_that_was_put_back_lost_nothing(claims, requests, job):
    for _ in range(5):
        claim = claims.claim()
        claims.report(claim, 0.5, "drawing")
        assert requests.get("a", job.id).stage == "drawing"
        claims.put_back(claim)
        now = requests.get("a", job.id)
        assert (now.state, now.progress, now.started) == ("queued", 0.0, None)
    assert claims.claim().attempt == 6


def test_work_that_ends_the_service_every_time_is_given_up(claims, requests, job):
    for _ in range(MOST_ATTEMPTS):
        assert claims.claim() is not None
        claims.recover()
    assert claims.claim() is None
    now = requests.get("a", job.id)
    assert (now.state, now.failure["code"]) == ("failed", "worker_lost")


@pytest.mark.parametrize(("told", "kept"), [(-1.0, 0.0), (0.25, 0.25), (7.0, 1.0)])
def test_progress_stays_between_0_and_1(claims, requests, job, told, kept):
    claims.report(claims.claim(), told, "drawing")
    assert requests.get("a", job.id).progress == kept


def test_work_is_counted_by_state(claims, requests, job):
    requests.submit(Request("a", "texture", {}, "e", "interactive", 60.0))
    claims.claim()
    assert claims.counts() == {"queued": 1, "running": 1}
