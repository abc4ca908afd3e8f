"""The fuzzer finds what it is there to find, and nothing where there is nothing."""

import threading
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import uvicorn

from service.app import create_app
from service.settings import Settings
from tests.contract.fuzzer import fuzz, short_document
from tests.contract.planted_bugs import BUGS, Bug, Planted
from tests.toy_service import toy_engine, toy_executors, warmed

pytestmark = pytest.mark.contract

NO_BUG = {f"no bug in {bug.operation}": Bug(bug.operation, bug.phase, "") for bug in BUGS.values()}
OPTIONS = {
    "fuzzing": ["--phases=fuzzing", "--max-examples=60"],
    "coverage": ["--phases=coverage"],
    "stateful": ["--phases=stateful", "--max-examples=40"],
}
OPERATIONS = {
    "assets": ["create_asset", "get_asset", "delete_asset"],
    "jobs": ["create_texture", "get_job", "cancel_job"],
}


def slug(name: str) -> str:
    return name.replace(" ", "-")


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A service with every bug, each below a path of its own."""
    data = tmp_path_factory.mktemp("planted") / "data"
    settings = Settings(cost_limit_seconds=1, cost_limit_bytes=2**28)
    with toy_executors(), toy_engine(data, queue_limit=10_000) as engine:
        app = create_app(settings, warmed(engine))
        bugs = {slug(name): bug for name, bug in (BUGS | NO_BUG).items()}
        server = uvicorn.Server(
            uvicorn.Config(Planted(app, bugs), port=0, lifespan="off", log_level="error")
        )
        thread = threading.Thread(target=server.run)
        thread.start()
        while not server.started:
            time.sleep(0.01)
        port = server.servers[0].sockets[0].getsockname()[1]
        yield f"http://127.0.0.1:{port}"
        server.should_exit = True
        thread.join()


def search(url: str, name: str, folder: Path) -> tuple[int, str]:
    bug = (BUGS | NO_BUG)[name]
    names = OPERATIONS.get(bug.operation, [bug.operation])
    return fuzz(
        short_document(folder),
        f"--url={url}/{slug(name)}",
        "--seed=1",
        "--generation-deterministic",
        *OPTIONS[bug.phase],
        *(f"--include-operation-id={operation}" for operation in names),
        hooks=True,
        folder=folder,
        seconds=120,
    )


@pytest.mark.parametrize("name", BUGS)
def test_a_planted_bug_is_found(url, name, tmp_path):
    code, told = search(url, name, tmp_path)

    assert code == 1, told
    assert BUGS[name].found_as in told, told


@pytest.mark.parametrize("name", NO_BUG)
def test_where_no_bug_is_planted_none_is_found(url, name, tmp_path):
    code, told = search(url, name, tmp_path)

    assert code == 0, told
