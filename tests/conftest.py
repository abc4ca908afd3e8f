"""What every test may count on: the worker's environment, the corpus, OpenGL and golden pictures.

`REQUIRE_GL=1` and `REQUIRE_CORPUS=1` turn skips of tests marked `gl` and `corpus` into failures.
"""

import functools
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.requirements import skip_or_fail
from worker.jobs.environment import child_environment

ROOT = Path(__file__).resolve().parent.parent

# What computes in this process computes as the worker's children do. Numerical libraries read their
# environment once, when they are loaded: nothing above may import numpy.
os.environ |= child_environment(
    ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
)

# Examples are the same on every machine and every day; a test that wants more asks for more.
settings.register_profile(
    "texloom",
    derandomize=True,
    deadline=None,
    max_examples=25,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("texloom")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--bless-missing",
        action="store_true",
        help="store golden pictures that do not exist yet; one that exists is never overwritten",
    )


def pytest_runtest_setup(item: pytest.Item) -> None:
    if item.get_closest_marker("gl") and (reason := why_no_opengl()):
        skip_or_fail(reason, "REQUIRE_GL")
    if item.get_closest_marker("corpus") and not corpus_folder().is_dir():
        skip_or_fail(f"no corpus at {corpus_folder()} (TEXLOOM_CORPUS)", "REQUIRE_CORPUS")


@functools.cache
def why_no_opengl() -> str:
    """Why no context can be made here, or nothing."""
    probe = subprocess.run(
        [sys.executable, "-m", "tests.opengl_probe"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=60,
    )
    if probe.returncode == 0:
        return ""
    error = (probe.stderr.strip().splitlines() or ["it died without a word"])[-1]
    return f"no OpenGL context on {os.environ['PYOPENGL_PLATFORM']}: {error}"


def corpus_folder() -> Path:
    return (ROOT / os.environ.get("TEXLOOM_CORPUS", "../shared/corpus")).resolve()


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of the public test pictures and meshes, which are not part of the project."""
    if not corpus_folder().is_dir():
        skip_or_fail(f"no corpus at {corpus_folder()} (TEXLOOM_CORPUS)", "REQUIRE_CORPUS")
    return corpus_folder()


@pytest.fixture
def compare_with_golden(request: pytest.FixtureRequest) -> Callable[..., None]:
    """`compare(actual, "technique/case")`, see tests/golden_images.py."""
    # Imported here so that the environment above is set before numpy is loaded.
    from tests.golden_images import compare  # noqa: PLC0415

    return functools.partial(compare, bless_missing=request.config.getoption("--bless-missing"))
