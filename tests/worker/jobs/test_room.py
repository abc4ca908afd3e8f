import pytest

from worker.jobs.errors import QueueFullError, TenantFullError
from worker.jobs.meters import Meters
from worker.jobs.room import IN_BATCHES, Room
from worker.jobs.run_times import RunTimes


@pytest.mark.parametrize(
    ("queue_limit", "tenant_limit", "error", "why"),
    [(9, 0, TenantFullError, "tenant_queue_full"), (0, 9, QueueFullError, "queue_full")],
)
def test_a_refused_job_is_counted_by_why(database, queue_limit, tenant_limit, error, why):
    meters = Meters()
    room = Room(
        queue_limit=queue_limit,
        tenant_limit=tenant_limit,
        slots=1,
        run_times=RunTimes(),
        meters=meters,
    )

    with database.reading() as connection, pytest.raises(error):
        room.require(connection, "a", "interactive")

    assert refused(meters) == {why: 1}


def test_all_new_work_of_a_refused_batch_is_counted_and_what_is_taken_is_not(database):
    meters = Meters()
    room = Room(queue_limit=1, tenant_limit=1, slots=1, run_times=RunTimes(), meters=meters)

    with database.reading() as connection:
        room.require(connection, "a", "batch")
        room.require_for_batch(connection, IN_BATCHES)
        assert refused(meters) == {}
        with pytest.raises(QueueFullError):
            room.require_for_batch(connection, IN_BATCHES + 1)

    assert refused(meters) == {"batches_full": IN_BATCHES + 1}


def refused(meters):
    samples = [sample for metric in meters.registry.collect() for sample in metric.samples]
    return {
        sample.labels["why"]: sample.value
        for sample in samples
        if sample.name == "texloom_jobs_refused_total"
    }
