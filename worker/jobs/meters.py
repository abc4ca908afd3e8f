"""What is counted and timed, for Prometheus."""

from typing import Any, Final, Literal

from prometheus_client import CollectorRegistry, Counter, Histogram, disable_created_metrics

from worker.jobs.claims import Claim
from worker.jobs.slot import Outcome

Found = Literal["new", "shared", "finished"]
RESTARTS: Final = (
    "crashed",
    "timed_out",
    "memory_exceeded",
    "cancelled",
    "recycled",
    "died_idle",
)
SECONDS: Final = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 2.5, 5, 10, 30, 60, 300, 600)

disable_created_metrics()  # type: ignore[no-untyped-call]  # when a counter began is known: when the service did


class Meters:
    """The meters of one engine, in a registry of their own to which a service may add."""

    def __init__(self) -> None:
        self.registry = CollectorRegistry()
        self._submitted = Counter(
            "texloom_jobs_submitted",
            "Jobs accepted; found tells whether their work was new, shared or already finished.",
            ("priority", "found"),
            registry=self.registry,
        )
        self._refused = Counter(
            "texloom_jobs_refused",
            "Work refused for want of room: a job's, or all that is new in a batch.",
            ("why",),
            registry=self.registry,
        )
        self._ended = Counter(
            "texloom_work_ended",
            "Attempts at work.",
            ("technique", "outcome"),
            registry=self.registry,
        )
        self._waited = _seconds("texloom_work_wait", "From request to start.", self.registry)
        self._ran = _seconds("texloom_work_run", "From start to end.", self.registry)
        self._encoded = _seconds("texloom_work_encode", "Writing the file.", self.registry)
        self._restarts = Counter(
            "texloom_slot_restarts", "Children replaced.", ("cause",), registry=self.registry
        )
        self._bytes = Counter(
            "texloom_bytes", "Bytes of files stored and removed.", ("what",), registry=self.registry
        )
        for cause in RESTARTS:
            self._restarts.labels(cause)

    def submitted(self, priority: str, found: Found) -> None:
        """Count a job that was accepted."""
        self._submitted.labels(priority, found).inc()

    def refused(self, why: str, count: int) -> None:
        """Count work for which there was no room."""
        self._refused.labels(why).inc(count)

    def began(self, claim: Claim) -> None:
        """Time the wait of work that begins for the first time."""
        if claim.attempt == 1:
            self._waited.labels(technique(claim), claim.priority).observe(claim.waited_seconds)

    def ended(self, claim: Claim, outcome: Outcome, seconds: float) -> None:
        """Count and time an attempt."""
        name = technique(claim)
        self._ended.labels(name, outcome.status).inc()
        if outcome.facts is None:
            return
        self._ran.labels(name, claim.priority).observe(seconds)
        encode_ms = outcome.facts.get("timings", {}).get("encode_ms")
        if encode_ms is not None:
            self._encoded.labels(name, claim.priority).observe(encode_ms / 1000)
        self.moved("results_stored", outcome.facts.get("bytes", 0))

    def restarted(self, cause: str) -> None:
        """Count a child that was replaced."""
        self._restarts.labels(cause).inc()

    def moved(self, what: str, count: int) -> None:
        """Count bytes that were stored or removed."""
        self._bytes.labels(what).inc(count)


def technique(claim: Claim) -> str:
    """What is being made: the technique of a texture, or that it is a render."""
    texture: Any = claim.body.get("texture")
    named = texture.get("technique") if isinstance(texture, dict) else None
    return named if isinstance(named, str) else claim.kind


def _seconds(name: str, description: str, registry: CollectorRegistry) -> Histogram:
    return Histogram(
        f"{name}_seconds",
        description,
        ("technique", "priority"),
        buckets=SECONDS,
        registry=registry,
    )
