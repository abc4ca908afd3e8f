"""A job of the engine, as the API shows it."""

import re
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any, Final

from api_schemas import jobs as schemas
from api_schemas.jobs import JOB_ID_PATTERN, JobLinks, Result
from api_schemas.problems import JobFailure
from service.problems import ProblemError
from worker.jobs.job import Job
from worker.jobs.queue import JobQueue

RETRY_SECONDS = 1
WELL_FORMED: Final = re.compile(JOB_ID_PATTERN)


def job_url(job_id: str) -> str:
    """Return where a job is."""
    return f"/v1/jobs/{job_id}"


def result_url(job_id: str) -> str:
    """Return where a job's file is."""
    return f"{job_url(job_id)}/result"


def found_job(engine: JobQueue, tenant: str, job_id: str) -> Job:
    """Return one of the tenant's jobs.

    Raises:
        ProblemError: There is none of this name, or it is somebody else's.
    """
    job = engine.get(tenant, job_id) if WELL_FORMED.fullmatch(job_id) else None
    if job is None:
        raise ProblemError("job_unknown")
    return job


def view(job: Job, seconds_left: float | None) -> schemas.Job:
    """Return what the API tells of a job, and of the time until it is finished."""
    return schemas.Job.model_validate(
        {
            "id": job.id,
            "kind": job.kind,
            "state": job.state,
            "priority": job.priority,
            "digest": job.digest,
            "position": job.position,
            "attempt": job.attempt,
            "progress": job.progress,
            "stage": job.stage,
            "eta_seconds": None if seconds_left is None else round(seconds_left, 3),
            "created": moment(job.created),
            "started": moment(job.started),
            "finished": moment(job.finished),
            "result": result_of(job.facts),
            "failure": failure_of(job.failure),
            "links": JobLinks(
                self=job_url(job.id),
                events=f"{job_url(job.id)}/events",
                cancel=job_url(job.id),
                preview=f"{job_url(job.id)}/preview",
                result=result_url(job.id),
            ),
        }
    )


def result(job: Job) -> Result:
    """Return what is known of a succeeded job's file."""
    known = result_of(job.facts)
    assert known is not None
    return known


def result_of(facts: Mapping[str, Any] | None) -> Result | None:
    """Return what the executor's facts tell of a file, if there is one."""
    if facts is None:
        return None
    known = {name: facts[name] for name in Result.model_fields if name in facts}
    return Result.model_validate(known)


def failure_of(failure: Mapping[str, object] | None) -> JobFailure | None:
    """Return why a job failed, if it did."""
    return None if failure is None else JobFailure.model_validate(dict(failure))


def moment(seconds: float | None) -> datetime | None:
    """Return a time of the records as one of the API."""
    return None if seconds is None else datetime.fromtimestamp(seconds, UTC)


def require_succeeded(job: Job) -> None:
    """Refuse jobs without a file.

    Raises:
        ProblemError: The job is not finished, or did not succeed.
    """
    here = job_url(job.id)
    if job.state == "failed":
        reason = failure_of(job.failure)
        raise ProblemError(
            "job_failed", reason.message if reason else None, failure=reason, instance=here
        )
    if job.state == "cancelled":
        raise ProblemError("job_cancelled", instance=here)
    if job.state != "succeeded":
        raise ProblemError(
            "job_not_finished",
            f"the job is {job.state}",
            instance=here,
            headers={"Retry-After": str(RETRY_SECONDS)},
        )
