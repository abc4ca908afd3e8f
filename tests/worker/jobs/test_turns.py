"""Who is served next, as the rules of the queue say; no clock and no process is involved."""

import pytest

from worker.jobs.claims import Claims
from worker.jobs.intake import Request


@pytest.fixture
def queue(database, make_requests):
    return Queue(database, make_requests(queue_limit=999, tenant_limit=999))


class Queue:
    def __init__(self, database, requests):
        self.database, self.requests, self.count = database, requests, 0
        self.claims = Claims(database, 1)

    def slots(self, slots):
        self.claims = Claims(self.database, slots)

    def add(self, tenant, times=1, priority="interactive"):
        jobs = []
        for _ in range(times):
            self.count += 1
            body = Request(tenant, "texture", {}, f"{self.count}", priority, 60.0)
            jobs.append(self.requests.submit(body))
        return jobs

    def serve(self, times):
        """Have one slot do so much work, one after another; answers whose it was."""
        return "".join(self.serve_one() for _ in range(times))

    def serve_one(self):
        claim = self.claims.claim()
        self.claims.succeed(claim, {}, "here", lambda: None)
        return claim.tenant


def test_a_tenant_is_not_behind_the_hundred_jobs_of_another(queue):
    queue.add("a", 100)
    [job] = queue.add("b")
    assert job.position == 2
    assert queue.serve(4) == "abaa"


def test_tenants_take_turns_and_each_ones_work_is_done_in_order(queue):
    for tenant in "abc":
        queue.add(tenant, 4)
    assert queue.serve(12) == "abcabcabcabc"


def test_who_always_has_the_next_job_ready_gets_no_more_than_a_turn(queue):
    queue.add("a", 10)
    served = ""
    for _ in range(8):
        queue.add("b")
        served += queue.serve(1)
    assert served == "abababab"


def test_slots_are_shared_evenly(queue):
    queue.slots(4)
    queue.add("a", 9)
    first = [queue.claims.claim().tenant for _ in range(3)]
    queue.add("b", 9)
    claimed = [queue.claims.claim() for _ in range(3)]
    assert (first, [claim.tenant for claim in claimed]) == (["a"] * 3, ["b"] * 3)


@pytest.mark.parametrize(
    ("slots", "batch_at_a_time"), [(1, None), (2, None), (3, 2), (4, 3), (8, 7)]
)
def test_of_three_slots_or_more_batch_leaves_one(queue, slots, batch_at_a_time):
    queue.slots(slots)
    queue.add("a", 9, "batch")
    taken = 0
    while taken < 9 and queue.claims.claim():
        taken += 1
    assert taken == (batch_at_a_time or 9)
    queue.add("a", 1)
    assert queue.claims.claim().priority == "interactive"


def test_interactive_goes_first_whoever_waits(queue):
    queue.add("a", 2, "batch")
    queue.add("b", 2, "batch")
    queue.add("a", 1)
    assert [queue.claims.claim().priority for _ in range(2)] == ["interactive", "batch"]


def test_positions_are_the_order_in_which_work_is_done(queue):
    jobs = [*queue.add("a", 4), *queue.add("b", 2), *queue.add("c", 1, "batch"), *queue.add("b")]
    places = {job.id: queue.requests.get(job.tenant, job.id).position for job in jobs}
    assert sorted(places.values()) == list(range(1, 9))
    in_order = sorted(jobs, key=lambda job: places[job.id])
    assert queue.serve(8) == "".join(job.tenant for job in in_order)


def test_work_that_is_put_back_keeps_its_place(queue):
    queue.add("a", 3)
    claim = queue.claims.claim()
    queue.claims.put_back(claim)
    assert queue.claims.claim().work_id == claim.work_id
