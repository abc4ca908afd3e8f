import time

import pytest

from worker.jobs.claims import Claims
from worker.jobs.errors import QueueFullError, TenantFullError
from worker.jobs.intake import Request
from worker.jobs.run_times import RunTimes


@pytest.fixture
def claims(database):
    return Claims(database)


@pytest.fixture
def reusable():
    """Fingerprints whose results still serve."""
    return {"here"}


@pytest.fixture
def requests(make_requests, reusable):
    return make_requests(
        queue_limit=3, slots=2, is_reusable=lambda _, fingerprint: fingerprint in reusable
    )


@pytest.fixture
def run_times_of(monkeypatch):
    """Run times as after work that took so many seconds."""

    def run_times_of(*seconds):
        run_times = RunTimes()
        now = [1000.0]
        monkeypatch.setattr(time, "monotonic", lambda: now[0])
        for number, took in enumerate(seconds):
            run_times.begin(str(number))
            now[0] += took
            assert run_times.end(str(number), counts=True) == took
        monkeypatch.undo()
        return run_times

    return run_times_of


def request(digest, tenant="a", priority="interactive"):
    return Request(tenant, "texture", {"digest": digest}, digest, priority, 60.0)


def succeed(claims, fingerprint="here"):
    claim = claims.claim()
    assert claims.succeed(claim, {"bytes": 1}, fingerprint, lambda: None)


def test_the_same_digest_is_done_once_for_all_who_ask(requests, claims):
    first, second = requests.submit(request("d")), requests.submit(request("d"))
    assert first.id != second.id
    assert first.work_id == second.work_id
    running = claims.claim()
    third = requests.submit(request("d"))
    assert third.state == "running"
    assert third.work_id == running.work_id
    assert claims.claim() is None


def test_a_good_result_serves_again_at_once(requests, claims):
    first = requests.submit(request("d"))
    succeed(claims)
    again = requests.submit(request("d"))
    assert (again.state, again.work_id, again.facts) == ("succeeded", first.work_id, {"bytes": 1})


def test_a_result_that_no_longer_serves_is_made_anew(requests, claims, reusable):
    first = requests.submit(request("d"))
    succeed(claims)
    reusable.clear()
    again = requests.submit(request("d"))
    assert (again.state, again.work_id == first.work_id) == ("queued", False)


def test_tenants_share_nothing(requests):
    mine, theirs = requests.submit(request("d")), requests.submit(request("d", tenant="b"))
    assert mine.work_id != theirs.work_id
    assert requests.get("b", mine.id) is None
    assert requests.cancel("b", mine.id) is None
    assert [job.id for job in requests.list("b", cursor=None, limit=9, state=None)[0]] == [
        theirs.id
    ]


@pytest.mark.parametrize("end", ["failed", "cancelled"])
def test_work_that_ended_badly_is_not_joined(requests, claims, end):
    first = requests.submit(request("d"))
    if end == "failed":
        claims.fail(claims.claim(), {"code": "c", "message": "m", "pointer": None})
    else:
        requests.cancel("a", first.id)
    assert requests.get("a", first.id).state == end
    again = requests.submit(request("d"))
    assert (again.state, again.work_id == first.work_id) == ("queued", False)


def test_cancelling_one_of_two_leaves_the_work_to_the_other(requests, claims):
    first, second = requests.submit(request("d")), requests.submit(request("d"))
    assert requests.cancel("a", first.id).state == "cancelled"
    assert requests.get("a", second.id).state == "queued"
    succeed(claims)
    assert requests.get("a", first.id).state == "cancelled"
    assert requests.get("a", first.id).facts is None
    assert requests.get("a", second.id).state == "succeeded"


def test_cancelling_the_last_one_cancels_the_work(requests, claims):
    first, second = requests.submit(request("d")), requests.submit(request("d"))
    claim = claims.claim()
    requests.cancel("a", first.id)
    assert claims.is_live(claim.work_id)
    requests.cancel("a", second.id)
    assert not claims.is_live(claim.work_id)
    assert not claims.succeed(claim, {}, "here", lambda: pytest.fail("published"))


def test_cancelling_again_or_too_late_changes_nothing(requests, claims):
    cancelled = requests.submit(request("d"))
    once = requests.cancel("a", cancelled.id)
    assert requests.cancel("a", cancelled.id) == once
    done = requests.submit(request("e"))
    succeed(claims)
    assert requests.cancel("a", done.id).state == "succeeded"
    assert requests.cancel("a", "0" * 32) is None


def test_interactive_goes_before_batch_and_each_in_order(requests, claims):
    requests.submit(request("b1", priority="batch"))
    requests.submit(request("i1"))
    last = requests.submit(request("i2"))
    assert last.position == 2
    assert [claims.claim().digest for _ in range(3)] == ["i1", "i2", "b1"]


def test_an_interactive_job_hurries_the_batch_work_it_joins(requests, claims):
    requests.submit(request("b1", priority="batch"))
    slow = requests.submit(request("b2", priority="batch"))
    hurried = requests.submit(request("b2"))
    assert hurried.position == 1
    assert (hurried.priority, requests.get("a", slow.id).priority) == ("interactive", "batch")
    assert claims.claim().digest == "b2"


def test_positions_count_down(requests, claims):
    jobs = [requests.submit(request(digest)) for digest in "xyz"]
    assert [job.position for job in jobs] == [1, 2, 3]
    claims.claim()
    assert [requests.get("a", job.id).position for job in jobs] == [None, 1, 2]


def test_a_full_queue_refuses_new_work_only(requests, claims):
    for digest in "xyz":
        requests.submit(request(digest))
    with pytest.raises(QueueFullError) as refusal:
        requests.submit(request("w"))
    assert refusal.value.retry_after_seconds >= 1
    assert len(requests.list("a", cursor=None, limit=9, state=None)[0]) == 3
    requests.submit(request("x"))
    claims.claim()
    requests.submit(request("w"))


@pytest.mark.parametrize(
    ("slots", "priority", "seconds"),
    [(1, "interactive", 30), (2, "interactive", 15), (3, "interactive", 10), (3, "batch", 15)],
)
def test_retry_after_is_when_work_that_takes_what_recent_work_took_makes_room(
    make_requests, run_times_of, slots, priority, seconds
):
    """30 s each: a place comes free when one ends, on each slot that this priority may use."""
    requests = make_requests(queue_limit=0, slots=slots, run_times=run_times_of(20.0, 40.0))
    with pytest.raises(QueueFullError) as refusal:
        requests.submit(request("w", priority=priority))
    assert refusal.value.retry_after_seconds == seconds


def test_a_tenant_may_have_so_much_waiting_and_leaves_room_to_others(make_requests, run_times_of):
    requests = make_requests(queue_limit=9, tenant_limit=2, slots=2, run_times=run_times_of(30.0))
    for digest in "xy":
        requests.submit(request(digest))
    with pytest.raises(TenantFullError) as alone:
        requests.submit(request("z"))
    requests.submit(request("z", tenant="b"))
    with pytest.raises(TenantFullError) as one_of_two:
        requests.submit(request("z"))
    assert alone.value.retry_after_seconds == 15
    assert one_of_two.value.retry_after_seconds == 30  # every other turn is the other one's


def test_pages_are_newest_first_and_complete(requests, claims):
    made = []
    for number in range(5):
        made.append(requests.submit(request(str(number))).id)
        claims.claim()
    seen, cursor = [], None
    while True:
        page, cursor = requests.list("a", cursor=cursor, limit=2, state=None)
        seen.append([job.id for job in page])
        if cursor is None:
            break
        assert len(cursor) == 16
    assert seen == [[made[4], made[3]], [made[2], made[1]], [made[0]]]


def test_any_cursor_is_good(requests):
    job = requests.submit(request("d"))
    assert requests.list("a", cursor="0" * 16, limit=2, state=None) == ([], None)
    assert requests.list("a", cursor="f" * 16, limit=2, state=None) == ([job], None)


def test_jobs_are_listed_by_state(requests, claims):
    shared = [requests.submit(request("d")) for _ in range(2)]
    requests.cancel("a", shared[0].id)
    requests.submit(request("e"))
    succeed(claims)

    def ids(state):
        return [job.id for job in requests.list("a", cursor=None, limit=9, state=state)[0]]

    assert ids("cancelled") == [shared[0].id]
    assert ids("succeeded") == [shared[1].id]
    assert len(ids("queued")) == 1
    assert ids("failed") == ids("running") == []
