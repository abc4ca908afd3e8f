"""The real app with the real engine, whose executor makes pictures of one pixel."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest
from fastapi import FastAPI
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings
from tests.toy_service import toy_engine, toy_executors, warmed
from worker.jobs.engine import EmbeddedEngine


@pytest.fixture(scope="session")
def executors() -> Iterator[None]:
    with toy_executors():
        yield


@pytest.fixture(scope="module")
def engine(executors: None, tmp_path_factory: pytest.TempPathFactory) -> Iterator[EmbeddedEngine]:
    with toy_engine(tmp_path_factory.mktemp("service") / "data") as engine:
        yield warmed(engine)


@pytest.fixture(scope="module")
def settings() -> Settings:
    return Settings(upload_limit_bytes=1 << 20)


@pytest.fixture(scope="module")
def app(engine: EmbeddedEngine, settings: Settings) -> FastAPI:
    return create_app(settings, engine)


@pytest.fixture(scope="module")
def client(app: FastAPI) -> Iterator[TestClient]:
    with TestClient(app, raise_server_exceptions=False, follow_redirects=False) as client:
        yield client


@pytest.fixture
def make_client(executors: None, tmp_path: Path) -> Iterator[Callable[..., TestClient]]:
    """Makes clients of services with engines of their own."""
    with ExitStack() as stack:

        def make(executor: str = "toy_executor", **options: int) -> TestClient:
            folder = tmp_path / f"data{len(list(tmp_path.iterdir()))}"
            engine = stack.enter_context(toy_engine(folder, executor=executor, **options))
            return TestClient(create_app(Settings(), engine), raise_server_exceptions=False)

        yield make
