"""What an engine counts, for jobs whose fate is known."""

import pytest


@pytest.fixture
def value(engine):
    def value(name, **labels):
        return engine.meters.registry.get_sample_value(f"texloom_{name}", labels)

    return value


def test_jobs_are_counted_by_whether_their_work_was_there(
    engine, submit, begin, finish, value, tmp_path
):
    gate = tmp_path / "gate"
    first = begin(engine, submit(engine, "d" * 64, do="wait", gate=str(gate)))
    submit(engine, "d" * 64, do="wait", gate=str(gate))
    gate.touch()
    finish(engine, first)
    for _ in range(3):
        submit(engine, "d" * 64, do="wait", gate=str(gate))
    found = {
        found: value("jobs_submitted_total", priority="interactive", found=found)
        for found in ("new", "shared", "finished")
    }
    assert found == {"new": 1, "shared": 1, "finished": 3}


def test_times_and_bytes_are_those_of_the_work(engine, submit, finish, value, wait_until):
    body = {"do": "sleep", "seconds": 0.2, "texture": {"technique": "perlin"}}
    finish(engine, submit(engine, priority="batch", **body))
    labels = {"technique": "perlin", "priority": "batch"}
    wait_until(lambda: value("work_run_seconds_count", **labels) == 1)
    assert 0.2 <= value("work_run_seconds_sum", **labels) < 2
    assert value("work_wait_seconds_count", **labels) == 1
    assert value("bytes_total", what="results_stored") == len(b"result")
    assert value("work_ended_total", technique="perlin", outcome="ok") == 1


def test_what_is_no_texture_is_named_by_its_kind(engine, submit, finish, value, wait_until):
    finish(engine, submit(engine, do="refuse", texture={"technique": ["no", "text"]}))
    wait_until(lambda: value("work_ended_total", technique="texture", outcome="failed"))
    assert value("work_ended_total", technique="texture", outcome="failed") == 1


def test_the_state_of_things_is_told(make_engine, submit, begin, tmp_path):
    engine = make_engine(slots=1)
    gate = tmp_path / "gate"
    begin(engine, submit(engine, do="wait", gate=str(gate), texture={"technique": "worley"}))
    submit(engine, do="nothing")
    submit(engine, do="nothing", priority="batch")
    status = engine.status()
    queue = {name: (one.queued, one.running) for name, one in status.queues.items()}
    assert queue == {"interactive": (1, 1), "batch": (1, 0)}
    assert status.queues["batch"].oldest_seconds >= 0
    [slot] = status.slots
    assert (slot.name, slot.is_warm, slot.technique, slot.attempt) == ("slot-0", True, "worley", 1)
    assert status.store.free_bytes > 0
    gate.touch()
