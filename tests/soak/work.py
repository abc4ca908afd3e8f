"""Work without end: every example in new sizes, models that come and go, followers who leave."""

import itertools
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import httpx

from tests.examples import ASSETS, examples
from tests.small_models import PLY

PATHS = {"texture": "/v1/textures", "render": "/v1/renders"}
WAIT = {"Prefer": "wait=60"}


@dataclass
class Work:
    """Callers that ask one after another until they are told to stop."""

    url: str
    stopping: threading.Event = field(default_factory=threading.Event)
    done: int = 0
    faults: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._numbers = itertools.count()
        self._lock = threading.Lock()

    def keep_asking(self) -> None:
        """Ask until told to stop; what is answered wrongly is noted."""
        with httpx.Client(base_url=self.url, timeout=120) as client:
            for path in ASSETS:
                client.post("/v1/assets", content=path.read_bytes()).raise_for_status()
            while not self.stopping.is_set():
                number = next(self._numbers)
                try:
                    self._ask(client, number)
                except (httpx.HTTPError, AssertionError) as error:
                    self.faults.append(f"{number}: {error!r}")
                with self._lock:
                    self.done += 1

    def _ask(self, client: httpx.Client, number: int) -> None:
        if number % 10 == 9:
            self._bring_a_model(client, number)
            return
        kind, body = list(examples().values())[number % len(examples())]
        side = 64 + number % 97
        body["output"] = body.get("output", {}) | {"size": [side, 64 + number // 97 % 1000]}
        job = _made(client, PATHS[kind], body)
        if number % 5 == 0:
            with client.stream("GET", f"{job['links']['self']}/events") as events:
                next(events.iter_lines(), None)  # and hang up
        picture = client.get(job["links"]["result"])
        assert picture.status_code == 200, picture.status_code

    def _bring_a_model(self, client: httpx.Client, number: int) -> None:
        data = PLY.replace(b"end_header", b"comment %d\nend_header" % number)
        asset = client.post("/v1/assets", content=data).raise_for_status().json()["sha256"]
        scene = {"nodes": [{"mesh": {"type": "model", "asset": asset}}]}
        _made(client, PATHS["render"], {"scene": scene, "output": {"size": [96, 96]}})
        assert client.delete(f"/v1/assets/{asset}").status_code == 204


def callers(work: Work, count: int) -> Iterator[threading.Thread]:
    """Start so many callers."""
    for _ in range(count):
        thread = threading.Thread(target=work.keep_asking)
        thread.start()
        yield thread


def _made(client: httpx.Client, path: str, body: dict[str, Any]) -> Any:
    answer = client.post(path, json=body, headers=WAIT)
    assert answer.status_code in (200, 202), f"{answer.status_code} {answer.text[:200]}"
    job = answer.json()
    assert job["state"] == "succeeded", job
    return job
