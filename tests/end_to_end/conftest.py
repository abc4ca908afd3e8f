"""Services of the tests' own."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.running_service import ROOT, RunningService


@pytest.fixture
def make_service(tmp_path: Path) -> Iterator[Callable[..., RunningService]]:
    """Start services with settings of one's own; all are stopped afterwards."""
    started: list[RunningService] = []

    def make(folder: Path = ROOT, **settings: str) -> RunningService:
        data = tmp_path / f"data{len(started)}"
        environment = {f"TEXLOOM_{name.upper()}": value for name, value in settings.items()}
        service = RunningService(data, environment, folder)
        started.append(service)
        return service.start()

    yield make
    for service in started:
        service.stop()


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningService]:
    """One service for all tests of a module."""
    service = RunningService(tmp_path_factory.mktemp("service") / "data").start()
    yield service
    assert service.stop() == 0, service.log()
    assert "leaked" not in service.log()
