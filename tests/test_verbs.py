"""The verbs of the Makefile, and what calls them."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
VERBS = [
    "run",
    "test",
    "test-all",
    "check",
    "fix",
    "bench",
    "faults",
    "soak",
    "gallery",
    "lock",
    "clean",
]


def test_make_alone_lists_the_verbs_and_what_they_do() -> None:
    told = subprocess.run(["make"], cwd=ROOT, capture_output=True, text=True, check=True)

    verbs = dict(re.findall(r"^([a-z-]+) +(\S.*)$", told.stdout, re.M))

    assert list(verbs) == VERBS
    assert told.stderr == ""


@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_of_the_readme_is_one_of_make(verb: str) -> None:
    assert f"`{verb}`" in (ROOT / "README.md").read_text().partition("\n## Verbs\n")[2]


def test_hooks_call_nothing_but_verbs() -> None:
    hooks = re.findall(r"^ +entry: (.*)$", (ROOT / ".pre-commit-config.yaml").read_text(), re.M)

    assert hooks == ["make fix", "make check"]


def test_continuous_integration_requires_opengl_and_calls_the_three_verbs_of_testing() -> None:
    script = (ROOT / ".ci" / "run").read_text()

    assert "export REQUIRE_GL=1\n" in script
    assert re.search(r"-d \.\./shared/corpus.*\n.*REQUIRE_CORPUS=1", script)
    assert re.search(r"^make check test test-all\b", script, re.M)
