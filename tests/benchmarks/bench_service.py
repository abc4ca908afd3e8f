"""What the service adds to the worker's own time, and what a finished result costs."""

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.running_service import RunningService

ROUNDS = 100
AS_PNG = {"Accept": "image/png"}


def measure() -> list[dict[str, Any]]:
    """Time a real service on loopback."""
    rows: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory() as folder:
        service = RunningService(Path(folder) / "data")
        began = time.perf_counter()
        service.start()
        rows.append(row("start to ready, caches cold", time.perf_counter() - began, "s"))
        service.stop()
        began = time.perf_counter()
        service.start()
        with service.client() as client:
            soda_can(client)
            rows.append(row("start to first soda can, caches warm", since(began), "s"))
            rows += overhead(client)
            rows.append(row("idle memory, service and two warm workers", memory(service), "MB"))
        service.stop()
        rows += throughput(Path(folder))
    return rows


def row(work: str, figure: float, unit: str, note: str = "") -> dict[str, Any]:
    return {"work": work, "figure": round(figure, 3), "unit": unit, "note": note}


def since(began: float) -> float:
    return time.perf_counter() - began


def soda_can(client: Any) -> None:
    body = Path("api_schemas/examples/renders/soda_can.json").read_bytes()
    headers = {**AS_PNG, "Content-Type": "application/json"}
    client.post("/v1/renders", content=body, headers=headers).raise_for_status()


def overhead(client: Any) -> list[dict[str, Any]]:
    """Post small textures never asked for before; subtract what the worker says it took."""
    added, whole = [], []
    for seed in range(ROUNDS):
        body = {"texture": {"technique": "perlin", "seed": seed}, "output": {"size": [64, 64]}}
        began = time.perf_counter()
        answer = client.post("/v1/textures", json=body, headers=AS_PNG)
        whole.append(since(began) * 1000)
        job = client.post("/v1/textures", json=body).json()
        timings = job["result"]["timings"]
        added.append(whole[-1] - sum(timings.values()))
        answer.raise_for_status()
    again = job["links"]["result"]
    fetched = [timed(lambda: client.get(again).raise_for_status()) for _ in range(ROUNDS)]
    known = [
        timed(lambda: client.post("/v1/textures", json=body).raise_for_status())
        for _ in range(ROUNDS)
    ]
    scraped = [timed(lambda: client.get("/metrics").raise_for_status()) for _ in range(ROUNDS)]
    return [
        row("texture 64 x 64, request to picture, p50", statistics.median(whole), "ms"),
        row("of it added by the service, p50", statistics.median(added), "ms", "reach: 10"),
        row("GET of a finished result, p50", statistics.median(fetched), "ms", "reach: 3"),
        row("POST of work already done, p50", statistics.median(known), "ms"),
        row("GET /metrics, p50", statistics.median(scraped), "ms"),
    ]


def timed(call: Callable[[], object]) -> float:
    began = time.perf_counter()
    call()
    return since(began) * 1000


def memory(service: RunningService) -> float:
    """Sum the proportional set sizes, so that shared pages count once."""
    kilobytes = 0
    for pid in service.processes():
        text = Path(f"/proc/{pid}/smaps_rollup").read_text()
        kilobytes += int(text.split("Pss:")[1].split()[0])
    return kilobytes / 1024


def throughput(folder: Path) -> list[dict[str, Any]]:
    """Eight equal jobs of about a second, with one worker and with two."""
    seconds = {}
    for slots in (1, 2):
        service = RunningService(folder / f"data{slots}", {"TEXLOOM_SLOTS": str(slots)}).start()
        with service.client() as client:
            began = time.perf_counter()
            jobs = [client.post("/v1/renders", json=second(n)).json()["id"] for n in range(8)]
            while any(state(client, job) in {"queued", "running"} for job in jobs):
                time.sleep(0.02)
            seconds[slots] = since(began)
            assert {state(client, job) for job in jobs} == {"succeeded"}
        service.stop()
    return [
        row("eight jobs of a second, one worker", seconds[1], "s"),
        row("eight jobs of a second, two workers", seconds[2], "s"),
        row("throughput of two workers over one", seconds[1] / seconds[2], "x", "reach: 1.8"),
    ]


def state(client: Any, job: str) -> str:
    return str(client.get(f"/v1/jobs/{job}").json()["state"])


def second(number: int) -> dict[str, Any]:
    return {
        "scene": {
            "camera": {"type": "perspective", "pose": {"eye": [0, 0, 3 + number / 100]}},
            "nodes": [
                {
                    "mesh": {"type": "sphere"},
                    "surface": {
                        "technique": "unlit",
                        "color": {"texture": {"technique": "checkerboard"}},
                    },
                }
            ],
        },
        "output": {"size": [1024, 1024], "supersampling": 3},
    }
