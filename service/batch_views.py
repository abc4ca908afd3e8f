"""A batch of the engine, as the API shows it."""

from api_schemas import batches as schemas
from service.job_views import failure_of, job_url, moment, result_of, result_url
from worker.jobs.batch import Batch, Entry


def batch_url(batch_id: str) -> str:
    """Return where a batch is."""
    return f"/v1/batches/{batch_id}"


def view(batch: Batch) -> schemas.Batch:
    """Return what the API tells of a batch."""
    here = batch_url(batch.id)
    return schemas.Batch.model_validate(
        {
            "id": batch.id,
            "size": batch.size,
            "counts": batch.counts,
            "progress": min(batch.progress, 1.0),
            "created": moment(batch.created),
            "finished": moment(batch.finished),
            "links": {"self": here, "cancel": here, "manifest": f"{here}/manifest"},
        }
    )


def manifest(batch: Batch, entries: list[Entry]) -> schemas.Manifest:
    """Return what the API tells of all that a batch made."""
    return schemas.Manifest(batch=view(batch), items=[_entry(item) for item in entries])


def _entry(item: Entry) -> schemas.Entry:
    return schemas.Entry.model_validate(
        {
            "index": item.place,
            "values": item.values,
            "job": item.job_id,
            "kind": item.kind,
            "state": item.state,
            "digest": item.digest,
            "result": result_of(item.facts),
            "failure": failure_of(item.failure),
            "links": {
                "job": job_url(item.job_id),
                "result": result_url(item.job_id) if item.state == "succeeded" else None,
            },
        }
    )
