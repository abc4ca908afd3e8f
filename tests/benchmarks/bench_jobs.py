"""What the job engine costs, and how fast it gets over the worst.

`python tests/benchmarks/bench_jobs.py` prints a table. The executor is the trial one of the tests,
which needs no time to become warm: after the death of a child or of the service, a real one adds
its own.
"""

import asyncio
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

from worker.jobs.engine import EmbeddedEngine

ROOT = Path(__file__).parents[2]
EXECUTORS = ROOT / "tests" / "worker" / "jobs" / "executors"
ROUNDS = 10


def measure():
    """All figures, as rows of work, figure and unit."""
    sys.path.insert(0, str(EXECUTORS))
    try:
        return [
            _row("no-op job, submitted to finished, p50", *_latency(0.50)),
            _row("no-op job, submitted to finished, p99", *_latency(0.99)),
            _row("5 ms jobs, two slots", _throughput(), "jobs/s"),
            _row("the same, children replaced after 20 jobs", _throughput(recycle=20), "jobs/s"),
            *_behind_batch(),
            *_behind_another_tenant(),
            _row("cancel a running stuck native call, until its process is gone", *_cancel()),
            _row("stuck native call, beyond its limit of 1 s", *_overshoot()),
            _row("kill -9 of the child in mid-job, until the job is finished", *_child_death()),
            _row("kill -9 of the service in mid-job, restart, until finished", *_service_death()),
        ]
    finally:
        sys.path.remove(str(EXECUTORS))


def main():
    """Print the figures as a table."""
    print("| work | figure | unit |")
    print("|---|---|---|")
    for row in measure():
        print(f"| {row['work']} | {row['figure']} | {row['unit']} |")


def _latency(quantile):
    with _engine() as engine:
        times = sorted(_timed(engine, {"do": "nothing"}) for _ in range(200))
    return times[int(quantile * len(times))] * 1e3, "ms"


def _throughput(recycle=1000):
    with _engine(slots=2, recycle_after=recycle) as engine:
        started = time.perf_counter()
        jobs = [_submit(engine, {"do": "burn", "seconds": 0.005}) for _ in range(200)]
        for job in jobs:
            _finish(engine, job)
        return len(jobs) / (time.perf_counter() - started)


def _behind_batch():
    """No-ops for somebody who waits, while work of 50 ms fills every slot that it may."""
    rows = []
    for slots in (2, 3):
        with _engine(slots=slots) as engine:
            for _ in range(200):
                _submit(engine, {"do": "sleep", "seconds": 0.05}, priority="batch")
            times = sorted(_timed(engine, {"do": "nothing"}) for _ in range(20))
        what = f"interactive no-op behind 200 batch jobs of 50 ms, {slots} slots, p50"
        rows.append(_row(what, statistics.median(times) * 1e3, "ms"))
    return rows


def _behind_another_tenant():
    with _engine(slots=2) as engine:
        body = {"do": "sleep", "seconds": 0.02}
        first = [_submit(engine, body, tenant="a") for _ in range(100)]
        started = time.perf_counter()
        second = [_submit(engine, body, tenant="b") for _ in range(4)]
        ends = []
        for jobs in (second, first):
            for job in jobs:
                _finish(engine, job)
            ends.append((time.perf_counter() - started) * 1e3)
    return [
        _row("tenant B's 4 jobs of 20 ms behind A's 100, until all of B's", ends[0], "ms"),
        _row("the same, until all of A's", ends[1], "ms"),
    ]


def _cancel():
    times = []
    with _engine() as engine, tempfile.TemporaryDirectory() as folder:
        for number in range(ROUNDS):
            note = Path(folder) / str(number)
            job = _submit(engine, {"do": "stuck", "note_pid": str(note)})
            pid = _noted(note)
            time.sleep(0.05)
            started = time.perf_counter()
            engine.cancel("local", job.id)
            while Path(f"/proc/{pid}").exists():
                time.sleep(0.001)
            times.append(time.perf_counter() - started)
    return max(times) * 1e3, "ms, worst of 10"


def _overshoot():
    with _engine() as engine:
        job = _finish(engine, _submit(engine, {"do": "stuck"}, limit=1.0))
    return (job.finished - job.started - 1.0) * 1e3, "ms"


def _child_death():
    times = []
    with _engine() as engine, tempfile.TemporaryDirectory() as folder:
        for number in range(ROUNDS):
            note, marker = Path(folder) / f"note{number}", Path(folder) / f"marker{number}"
            body = {"do": "stuck once", "marker": str(marker), "note_pid": str(note)}
            job = _submit(engine, body)
            pid = _noted(note)
            time.sleep(0.05)
            started = time.perf_counter()
            os.kill(pid, signal.SIGKILL)
            assert _finish(engine, job).attempt == 2
            times.append(time.perf_counter() - started)
    return statistics.median(times) * 1e3, "ms"


def _service_death():
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "data"
        with _service(data) as service:
            _noted(data / "marker", empty=True)
            time.sleep(0.2)
            started = time.perf_counter()
            service.kill()
            service.wait()
        with _service(data):
            while not any(path.suffix != ".part" for path in (data / "results").glob("*")):
                time.sleep(0.001)
            return (time.perf_counter() - started) * 1e3, "ms"


@contextmanager
def _engine(slots=1, recycle_after=1000):
    with tempfile.TemporaryDirectory() as folder:
        engine = EmbeddedEngine(
            Path(folder),
            slots=slots,
            memory_limit_bytes=1 << 30,
            recycle_after=recycle_after,
            executor="trial_executor",
        )
        engine.start()
        try:
            while engine.ready().warm_slots < slots:
                time.sleep(0.01)
            yield engine
        finally:
            engine.drain(10)


@contextmanager
def _service(data):
    command = [sys.executable, str(EXECUTORS / "service.py"), str(data), "stuck once"]
    path = os.pathsep.join((str(ROOT), str(EXECUTORS)))
    service = subprocess.Popen(
        command, env=os.environ | {"PYTHONPATH": path}, stdout=subprocess.DEVNULL
    )
    try:
        yield service
    finally:
        service.kill()
        service.wait()


def _submit(engine, body, limit=60.0, tenant="local", priority="interactive"):
    return engine.submit(
        "texture",
        body,
        os.urandom(32).hex(),
        tenant=tenant,
        priority=priority,
        time_limit_seconds=limit,
    )


def _finish(engine, job):
    return asyncio.run(engine.finished(job, 60))


def _timed(engine, body):
    started = time.perf_counter()
    assert _finish(engine, _submit(engine, body)).state == "succeeded"
    return time.perf_counter() - started


def _noted(note, *, empty=False):
    """The process id that a child left, as soon as it did."""
    while not (note.exists() and (empty or note.read_text().endswith("\n"))):
        time.sleep(0.001)
    return None if empty else int(note.read_text())


def _row(work, figure, unit):
    return {"work": work, "figure": float(f"{figure:.3g}"), "unit": unit}


if __name__ == "__main__":
    main()
