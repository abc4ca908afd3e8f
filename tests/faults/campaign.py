"""Asks for everything while one fault follows another, then counts."""

import random
import statistics
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import httpx

from tests.faults.aftermath import left_behind
from tests.faults.requests import Asked
from tests.faults.service import FaultyService

FINAL = frozenset({"succeeded", "failed", "cancelled"})
REASONS = frozenset({"worker_lost", "storage_full"})
"""What a job may fail with here: its worker was killed three times, or there was no room."""

NOTHING_WRONG = "0 lost, 0 duplicates, 0 differing, 0 orphans, 0 halves"
SECONDS_TO_FINISH = 300.0
GONE = "service: until its processes are gone"
KINDS = ("child", "child", "child", "child", "service", "disk", "busy", "clock")


@dataclass
class Report:
    """What came of one campaign."""

    seed: int
    jobs: int
    seconds: float
    states: Counter[str]
    recoveries: Mapping[str, Sequence[float]]
    complaints: list[str] = field(default_factory=list)

    def table(self) -> str:
        """Return it as Markdown."""
        states = ", ".join(f"{count} {state}" for state, count in sorted(self.states.items()))
        verdict = "; ".join(self.complaints) or NOTHING_WRONG
        lines = [
            f"Seed {self.seed}: {self.jobs} jobs in {self.seconds:.0f} s: {states}; {verdict}",
            "",
            "| fault | times | median s until the next job finished | worst |",
            "| --- | --- | --- | --- |",
        ]
        lines += [
            f"| {kind} | {len(times)} | {statistics.median(times):.2f} | {max(times):.2f} |"
            for kind, times in sorted(self.recoveries.items())
        ]
        return "\n".join(lines) + "\n"


class Campaign:
    """One run of all requests against one service that is being harmed."""

    def __init__(
        self,
        seed: int,
        requests: Sequence[Asked],
        expected: Mapping[str, str],
        service: FaultyService,
        faults: int,
    ) -> None:
        self._seed = seed
        self._requests = requests
        self._expected = expected
        self._service = service
        self._choose = random.Random(seed)
        self._faults = [KINDS[number % len(KINDS)] for number in range(faults)]
        self._choose.shuffle(self._faults)
        self._done_faults = 0
        self._accepted: dict[str, str] = {}
        self._finished_at: list[float] = []
        self._recoveries: dict[str, list[float]] = {}
        self._complaints: list[str] = []
        self._over = threading.Event()

    def run(self) -> Report:
        """Harm, wait, count."""
        began = time.monotonic()
        threads = [
            threading.Thread(target=self._submit, args=[self._requests[part::2]])
            for part in range(2)
        ]
        watch = threading.Thread(target=self._watch)
        for thread in (*threads, watch):
            thread.start()
        for kind in self._faults:
            self._harm(kind)
            self._done_faults += 1
        self._service.jump(0)
        for thread in threads:
            thread.join()
        jobs = self._settled()
        self._over.set()
        watch.join()
        seconds = time.monotonic() - began
        self._compare(jobs)
        self._complaints += left_behind(self._service)
        states = Counter(_told(job) for job in jobs.values())
        return Report(self._seed, len(jobs), seconds, states, self._recoveries, self._complaints)

    def _submit(self, requests: Sequence[Asked]) -> None:
        """Ask for things, evenly over the time that the faults take; insist until accepted.

        There is always something unfinished: how else would one see that it goes on?
        """
        for number, asked in enumerate(requests):
            share = number / len(requests)
            while self._done_faults < share * len(self._faults) - 1 and (
                len(self._finished_at) < len(self._accepted)
            ):
                time.sleep(0.02)
            while (job := self._try_to_submit(asked)) is None:
                time.sleep(0.1)
            self._accepted[asked.key] = job

    def _try_to_submit(self, asked: Asked) -> str | None:
        try:
            answer = httpx.post(
                f"{self._service.url}{asked.path}",
                json=asked.body,
                headers={"Idempotency-Key": asked.key},
                timeout=60,
            )
        except httpx.TransportError:
            return None
        if answer.status_code in (200, 202):
            return str(answer.json()["id"])
        if answer.status_code not in (429, 503, 507):
            self._complaints.append(f"submitting was answered {answer.status_code}: {answer.text}")
        return None

    def _harm(self, kind: str) -> None:
        """Do one fault, and time how long after its end (a kill ends at once) a job finishes."""
        choose, service = self._choose, self._service
        time.sleep(choose.uniform(0.2, 1.5))
        began = time.monotonic()
        faults: dict[str, Callable[[], object]] = {
            "child": lambda: service.kill_child(choose),
            "service": service.kill_and_restart,
            "disk": lambda: service.fill_disk(choose.uniform(0.5, 3)),
            "busy": lambda: service.hold_records(choose.uniform(0.5, 3)),
            "clock": lambda: service.jump(choose.choice([-4e7, -9e4, -60, 60, 9e4, 4e7])),
        }
        outcome = faults[kind]()
        if kind == "service":
            self._note_gone(outcome)
        if kind in ("disk", "busy"):
            began = time.monotonic()
        while not (after := [moment for moment in self._finished_at if moment > began]):
            if time.monotonic() - began > SECONDS_TO_FINISH:
                self._complaints.append(f"nothing finished any more after: {kind}")
                return
            if len(self._finished_at) == len(self._requests):
                return  # there is nothing left that could finish
            time.sleep(0.005)
        self._recoveries.setdefault(kind, []).append(after[0] - began)
        sys.stderr.write(f"  {kind}: {after[0] - began:.2f} s\n")

    def _note_gone(self, seconds: object) -> None:
        if isinstance(seconds, float):
            self._recoveries.setdefault(GONE, []).append(seconds)
        else:
            self._complaints.append("a process outlived a killed service")

    def _watch(self) -> None:
        """Note when jobs finish, as a client sees it."""
        finished: set[str] = set()
        while not self._over.is_set():
            for key, job_id in list(self._accepted.items()):
                if key not in finished and not self._over.is_set():
                    job = self._look(job_id)
                    if job is not None and job.get("state") in FINAL:
                        finished.add(key)
                        self._finished_at.append(time.monotonic())
            time.sleep(0.01)

    def _look(self, job_id: str) -> dict[str, Any] | None:
        """The job; None when the service cannot be asked right now."""
        try:
            answer = httpx.get(f"{self._service.url}/v1/jobs/{job_id}", timeout=60)
        except httpx.TransportError:
            return None
        if answer.status_code in (503, 507):
            return None
        if answer.status_code != 200:
            self._complaints.append(f"a job was answered {answer.status_code}: {answer.text}")
        found: dict[str, Any] = answer.json()
        return found

    def _settled(self) -> dict[str, dict[str, Any]]:
        """Every accepted job, once it is finished; what never is is lost."""
        deadline = time.monotonic() + SECONDS_TO_FINISH
        jobs: dict[str, dict[str, Any]] = {}
        while len(jobs) < len(self._accepted) and time.monotonic() < deadline:
            for key, job_id in self._accepted.items():
                if key not in jobs:
                    job = self._look(job_id)
                    if job is not None and job.get("state") in FINAL:
                        jobs[key] = job
            time.sleep(0.05)
        if lost := len(self._requests) - len(jobs):
            self._complaints.append(f"{lost} lost")
        return jobs

    def _compare(self, jobs: Mapping[str, dict[str, Any]]) -> None:
        """See that every job has its picture, or a reason."""
        differing = unreasonable = 0
        with self._service.client() as client:
            for key, job in jobs.items():
                if job["state"] == "succeeded":
                    picture = client.get(job["links"]["result"])
                    is_right = picture.status_code == 200 and (
                        picture.headers["etag"] == f'"{self._expected[key]}"'
                    )
                    differing += not is_right or job["result"]["sha256"] != self._expected[key]
                elif job["state"] != "failed" or job["failure"]["code"] not in REASONS:
                    unreasonable += 1
                    self._complaints.append(f"{job['state']}: {job['failure']}")
        if differing:
            self._complaints.append(f"{differing} differing")
        if unreasonable:
            self._complaints.append(f"{unreasonable} without a reason")


def _told(job: Mapping[str, Any]) -> str:
    why = job["failure"]
    return f"{job['state']} ({why['code']})" if why else str(job["state"])
