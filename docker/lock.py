"""Makes both lock files from pyproject.toml, or checks that they fit it.

`make lock` resolves anew and needs a package index; `make check` compares offline: the first line
of each lock carries a hash of the dependency tables it was made from.
"""

import hashlib
import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
RUN_LOCK, DEV_LOCK = "requirements.lock", "requirements-dev.lock"
OLDEST_PYTHON = "3.11"


def main(verb: str) -> None:
    """Do one of the two verbs, `make` or `check`."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    if verb == "make":
        make_locks(project)
    mistakes = find_mistakes(project)
    for mistake in mistakes:
        print(f"locks: {mistake}", file=sys.stderr)
    if mistakes:
        sys.exit("Run `make lock` and commit both lock files.")


def first_line(project: dict[str, Any]) -> str:
    """The comment that binds a lock to the dependency tables of pyproject.toml."""
    tables = {
        "build": project["build-system"]["requires"],
        "python": project["project"]["requires-python"],
        "run": project["project"]["dependencies"],
        "extras": project["project"]["optional-dependencies"],
    }
    digest = hashlib.sha256(json.dumps(tables, sort_keys=True).encode()).hexdigest()
    return f"# Made by `make lock` from the dependencies in pyproject.toml, sha256 {digest}\n"


def make_locks(project: dict[str, Any]) -> None:
    """Resolve both locks; the development lock takes over every version of the other."""
    # The build backend is locked too: adding the project to .venv must not need a network.
    build_requirements = "\n".join(project["build-system"]["requires"])
    for lock, extra in ((RUN_LOCK, []), (DEV_LOCK, ["--extra", "dev", "-c", RUN_LOCK])):
        print(f"locks: resolving {lock}", flush=True)
        command = [
            *(sys.executable, "-m", "uv", "pip", "compile", "pyproject.toml", "-", *extra),
            *("--universal", "--fork-strategy", "fewest", "--python-version", OLDEST_PYTHON),
            *("--generate-hashes", "--no-header", "--no-annotate", "--upgrade", "--quiet"),
        ]
        resolved = subprocess.run(
            command,
            input=build_requirements,
            stdout=subprocess.PIPE,
            text=True,
            cwd=ROOT,
            env=index_environment(),
        )
        if resolved.returncode:
            sys.exit(f"uv could not resolve {lock}: see above. Is a package index reachable?")
        (ROOT / lock).write_text(first_line(project) + resolved.stdout)


def index_environment() -> dict[str, str]:
    """The environment for uv; without an index of its own it takes the one pip is told to use."""
    environment = dict(os.environ)
    asked = subprocess.run(
        [sys.executable, "-m", "pip", "config", "get", "global.index-url"],
        capture_output=True,
        text=True,
    )
    pip_index = os.environ.get("PIP_INDEX_URL") or asked.stdout.strip()
    if pip_index:
        environment.setdefault("UV_DEFAULT_INDEX", pip_index)
    return environment


def find_mistakes(project: dict[str, Any]) -> list[str]:
    """Everything wrong with the committed locks, one sentence each."""
    locks = {name: (ROOT / name).read_text() for name in (RUN_LOCK, DEV_LOCK)}
    mistakes = []
    for name, text in locks.items():
        if not text.startswith(first_line(project)):
            mistakes.append(f"{name} was made from other dependencies than pyproject.toml has now")
        if re.search(r"://|--(find-links|index-url|extra-index-url|trusted-host)", text):
            mistakes.append(f"{name} names a place to download from")
        if unhashed := [pin for pin, hashes in pins(text).items() if not hashes]:
            mistakes.append(f"{name} has no hash for {', '.join(unhashed)}")
    if only_run := sorted(set(pins(locks[RUN_LOCK])) - set(pins(locks[DEV_LOCK]))):
        mistakes.append(f"{DEV_LOCK} differs from {RUN_LOCK} in {', '.join(only_run)}")
    return mistakes


def pins(lock_text: str) -> dict[str, int]:
    """`name==version` (with its marker) to the number of its hashes."""
    counts: dict[str, int] = {}
    for line in lock_text.replace("\\\n", " ").splitlines():
        pin, *hashes = line.split("--hash=")
        if pin.strip() and not pin.startswith("#"):
            counts[pin.strip()] = len(hashes)
    return counts


if __name__ == "__main__":
    main(sys.argv[1])
