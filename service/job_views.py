"""A job of the engine, as the API shows it."""

from datetime import UTC, datetime

from api_schemas import jobs as schemas
from api_schemas.jobs import JobLinks, Result
from api_schemas.problems import JobFailure
from service.problems import ProblemError
from worker.jobs.job import Job

RETRY_SECONDS = 1


def job_url(job_id: str) -> str:
    """Return where a job is."""
    return f"/v1/jobs/{job_id}"


def result_url(job_id: str) -> str:
    """Return where a job's file is."""
    return f"{job_url(job_id)}/result"


def view(job: Job) -> schemas.Job:
    """Return what the API tells of a job."""
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
            "created": _time(job.created),
            "started": _time(job.started),
            "finished": _time(job.finished),
            "result": result(job) if job.facts is not None else None,
            "failure": failure(job),
            "links": JobLinks(
                self=job_url(job.id), cancel=job_url(job.id), result=result_url(job.id)
            ),
        }
    )


def result(job: Job) -> Result:
    """Return what is known of a succeeded job's file."""
    facts = job.facts or {}
    known = {name: facts[name] for name in Result.model_fields if name in facts}
    return Result.model_validate(known)


def failure(job: Job) -> JobFailure | None:
    """Return why a job failed, if it did."""
    if job.failure is None:
        return None
    return JobFailure(
        code=job.failure["code"], message=job.failure["message"], pointer=job.failure["pointer"]
    )


def require_succeeded(job: Job) -> None:
    """Refuse jobs without a file.

    Raises:
        ProblemError: The job is not finished, or did not succeed.
    """
    here = job_url(job.id)
    if job.state == "failed":
        reason = failure(job)
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


def _time(seconds: float | None) -> datetime | None:
    return None if seconds is None else datetime.fromtimestamp(seconds, UTC)
