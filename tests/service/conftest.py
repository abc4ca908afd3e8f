"""The real app with the real engine, whose executor makes pictures of one pixel."""

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings
from worker.jobs.engine import EmbeddedEngine
from worker.jobs.forkserver import start_forkserver

EXECUTORS = str(Path(__file__).parent / "executors")


@pytest.fixture(scope="session")
def forkserver() -> Iterator[None]:
    """Children get the path of modules from this process, so the executors are found by name."""
    sys.path.insert(0, EXECUTORS)
    start_forkserver()
    yield
    sys.path.remove(EXECUTORS)


@pytest.fixture(scope="module")
def engine(forkserver: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedEngine]:
    engine = EmbeddedEngine(
        tmp_path_factory.mktemp("service") / "data",
        slots=2,
        memory_limit_bytes=1 << 30,
        executor="toy_executor",
        measurer="toy_measurer",
    )
    engine.start()
    while engine.ready().warm_slots < engine.ready().slots:
        time.sleep(0.01)
    yield engine
    engine.drain(0)


@pytest.fixture(scope="module")
def settings() -> Settings:
    return Settings(upload_limit_bytes=1 << 20)


@pytest.fixture(scope="module")
def app(engine: EmbeddedEngine, settings: Settings):
    return create_app(settings, engine)


@pytest.fixture(scope="module")
def client(app) -> Iterator[TestClient]:
    with TestClient(app, raise_server_exceptions=False, follow_redirects=False) as client:
        yield client


@pytest.fixture
def make_client(forkserver: None, tmp_path: Path) -> Iterator[Callable[..., TestClient]]:
    """Makes clients of services with engines of their own."""
    started = []

    def make(**options: int) -> TestClient:
        engine = EmbeddedEngine(
            tmp_path / f"data{len(started)}",
            executor="toy_executor",
            measurer="toy_measurer",
            **options,
        )
        engine.start()
        started.append(engine)
        return TestClient(create_app(Settings(), engine), raise_server_exceptions=False)

    yield make
    for engine in started:
        engine.drain(0)
