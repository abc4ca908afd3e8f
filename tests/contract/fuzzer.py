"""Runs schemathesis as its users do, from the command line."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def fuzz(
    document: str | Path, *options: str, hooks: bool, folder: Path, seconds: float
) -> tuple[int, str]:
    """Run `st run` in an empty folder; return its exit code and what it wrote."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1", "COLUMNS": "100"}
    if hooks:
        environment["SCHEMATHESIS_HOOKS"] = "tests.contract.hooks"
    command = [sys.executable, "-m", "schemathesis.cli", "run", str(document), *options]
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=seconds,
    )
    return done.returncode, done.stdout
