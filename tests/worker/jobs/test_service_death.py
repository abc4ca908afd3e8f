"""The service itself is killed in the middle of a job."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ROOT = HERE.parents[2]


@pytest.fixture
def start_service(tmp_path):
    """Starts a process with an engine that is given one job that lasts for ever the first time."""
    services = []

    def start(do):
        command = [sys.executable, HERE / "executors" / "service.py", tmp_path / "data", do]
        environment = os.environ | {
            "PYTHONPATH": os.pathsep.join([str(ROOT), str(HERE / "executors")])
        }
        service = subprocess.Popen(
            [str(part) for part in command],
            cwd=tmp_path,
            env=environment,
            stdout=subprocess.PIPE,
            text=True,
        )
        services.append(service)
        return service

    yield start
    for service in services:
        service.kill()
        service.wait()
        service.stdout.close()


def descendants(pid):
    """All processes below one."""
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return {int(child) for child in children}.union(*(descendants(child) for child in children))


@pytest.mark.parametrize("do", ["sleep once", "stuck once"])
def test_a_job_survives_the_death_of_the_service_and_no_process_does(
    start_service, make_engine, finish, wait_until, is_gone, tmp_path, do
):
    service = start_service(do)
    job_id = service.stdout.readline().strip()
    wait_until((tmp_path / "data" / "marker").exists)
    family = descendants(service.pid)
    assert len(family) >= 3, "forkserver, resource tracker and child"
    service.kill()
    service.wait()
    wait_until(lambda: all(is_gone(pid) for pid in family), 5)

    engine = make_engine()
    job = engine.get("local", job_id)
    assert job is not None
    done = finish(engine, job)
    assert (done.state, done.attempt) == ("succeeded", 2)
    assert list((tmp_path / "data" / "results").glob("*.part")) == []


def test_a_service_that_just_ends_takes_its_children_along(
    start_service, wait_until, is_gone, tmp_path
):
    """Without draining, through the exit hooks, with a child that ignores SIGTERM at work."""
    service = start_service("sleep once")
    service.stdout.readline()
    wait_until((tmp_path / "data" / "marker").exists)
    family = descendants(service.pid)
    service.send_signal(signal.SIGUSR1)
    assert service.wait(10) == 0
    wait_until(lambda: all(is_gone(pid) for pid in family), 5)


def test_signals_to_the_whole_group_leave_draining_to_the_service(
    start_service, wait_until, tmp_path
):
    service = start_service("sleep")
    service.stdout.readline()
    wait_until((tmp_path / "data" / "pids").exists)
    for pid in descendants(service.pid):
        os.kill(pid, signal.SIGTERM)
        os.kill(pid, signal.SIGINT)
    service.send_signal(signal.SIGTERM)
    assert service.stdout.readline().strip() == "succeeded 1"
    assert service.wait(10) == 0


def test_a_child_does_not_load_the_main_module_of_its_service(
    start_service, make_engine, wait_until, tmp_path
):
    service = start_service("describe")
    job_id = service.stdout.readline().strip()
    wait_until((tmp_path / "data" / "pids").exists)
    service.send_signal(signal.SIGTERM)
    assert service.stdout.readline().strip() == "succeeded 1"
    service.wait(10)
    assert make_engine().get("local", job_id).facts["loaded"] == []
