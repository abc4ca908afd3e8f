"""The real service keeps its published contract, whatever it is sent."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.contract.fuzzer import fuzz, short_document
from tests.running_service import RunningService

pytestmark = [pytest.mark.contract, pytest.mark.gl, pytest.mark.timeout(900)]

# Whatever fits the schema is accepted: what is larger than this would take the whole day.
SMALL = {"TEXLOOM_COST_LIMIT_SECONDS": "0.5", "TEXLOOM_COST_LIMIT_BYTES": "200000000"}


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningService]:
    service = RunningService(tmp_path_factory.mktemp("fuzzed") / "data", SMALL).start()
    yield service
    assert service.stop() == 0, service.log()


def failures(service: RunningService) -> list[dict[str, str]]:
    """Everything that went wrong inside while nobody outside was told."""
    with service.wait_until_warm().client() as client:
        jobs = client.get("/v1/jobs", params={"state": "failed", "limit": 100}).json()["jobs"]
    return [job["failure"] for job in jobs]


def test_the_bare_fuzzer_finds_nothing(service: RunningService, tmp_path: Path) -> None:
    """`st run` and the document, as a stranger would type it, with a few of each family.

    Left out are the three operations that take scenes: its systematic phase goes through each field
    of every texture in every place a surface can wear one, and takes a quarter of an hour on each.
    """
    scenes = [
        f"--exclude-operation-id={name}" for name in ("create_render", "create_batch", "validate")
    ]

    code, told = fuzz(
        short_document(tmp_path),
        f"--url={service.url}",
        *scenes,
        hooks=False,
        folder=tmp_path,
        seconds=400,
    )

    assert code == 0, told
    assert re.search(r"(\d{4,}) generated, \1 passed", told), told
    assert failures(service) == []
    assert "Traceback" not in service.log()


def test_a_fuzzer_that_knows_pictures_finds_nothing(
    service: RunningService, tmp_path: Path
) -> None:
    """Uploads that can be used lead to assets that can be fetched, used and deleted."""
    code, told = fuzz(
        short_document(tmp_path),
        f"--url={service.url}",
        "--phases=examples,fuzzing,stateful",
        "--seed=1",
        "--generation-deterministic",
        "--max-examples=60",
        hooks=True,
        folder=tmp_path,
        seconds=400,
    )

    assert code == 0, told
    assert failures(service) == []
    assert "Traceback" not in service.log()
