"""How attempts end whose work has moved on meanwhile."""

import threading

import pytest

from worker.jobs.assets import Assets
from worker.jobs.claims import Claims
from worker.jobs.intake import Request
from worker.jobs.line import Line
from worker.jobs.meters import Meters
from worker.jobs.results import Results
from worker.jobs.run_times import RunTimes
from worker.jobs.settling import Desk, settle
from worker.jobs.slot import Outcome


@pytest.fixture
def desk(database, tmp_path):
    claims = Claims(database)
    return Desk(
        line=Line(claims),
        claims=claims,
        results=Results(tmp_path / "results"),
        assets=Assets(tmp_path / "assets", database),
        run_times=RunTimes(),
        meters=Meters(),
        settled=lambda work_id: None,
        warming=threading.Lock(),
    )


@pytest.mark.parametrize("cancelled", [False, True])
def test_what_was_cancelled_while_it_was_finished_is_no_success(desk, make_requests, cancelled):
    requests = make_requests()
    job = requests.submit(Request("a", "texture", {}, "d" * 64, "interactive", 60.0))
    claim = desk.claims.claim()
    half = desk.results.half(claim.work_id, claim.attempt)
    half.write_bytes(b"result")
    if cancelled:
        requests.cancel("a", job.id)

    made = Outcome("ok", facts={"bytes": 6})
    outcome = settle(desk, claim, half, made, "here", threading.Event())

    assert outcome.status == ("cancelled" if cancelled else "ok")
    assert desk.results.count == (0 if cancelled else 1)
    assert not half.exists()
    assert requests.get("a", job.id).state == ("cancelled" if cancelled else "succeeded")
