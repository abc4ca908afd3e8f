"""The engine knows nothing of pydantic: what both sides name, they must name alike."""

from typing import get_args

from api_schemas import jobs, requests
from worker.jobs import job


def test_the_contract_and_the_engine_have_the_same_states_and_priorities():
    assert get_args(job.State) == get_args(jobs.State)
    assert get_args(job.Priority) == get_args(requests.Priority)
    assert set(get_args(jobs.State)) > job.FINAL_STATES


def test_the_contract_shows_every_fact_of_a_job_that_is_not_the_engines_own():
    shown = set(jobs.Job.model_fields)
    own = {"tenant", "work_id", "facts", "estimate_seconds"}

    assert set(job.Job.__dataclass_fields__) - own == shown - {"result", "links", "eta_seconds"}
