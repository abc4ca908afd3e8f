"""Runs schemathesis as its users do, from the command line."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
KEPT = {
    "Texture": ["checkerboard", "constant", "image", "mix", "perlin", "ramp"],
    "Surface": ["phong", "unlit"],
    "Coordinates": ["reflection", "uv"],
    "Layout": ["latlong"],
}
"""Members of each family that the fuzzer walks through: with all of them it walks for hours. What
holds for every technique is tested in tests/families."""


def short_document(folder: Path) -> Path:
    """Write the contract with a few members of each family, and return where."""
    document = json.loads((ROOT / "openapi.json").read_text())
    for family, kept in KEPT.items():
        schema = document["components"]["schemas"][family]
        mapping = {name: schema["discriminator"]["mapping"][name] for name in kept}
        schema["discriminator"]["mapping"] = mapping
        schema["oneOf"] = [{"$ref": target} for target in mapping.values()]
    path = folder / "openapi.json"
    path.write_text(json.dumps(document))
    return path


def fuzz(
    document: str | Path, *options: str, hooks: bool, folder: Path, seconds: float
) -> tuple[int, str]:
    """Run `st run` in an empty folder; return its exit code and what it wrote."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1", "COLUMNS": "100"}
    if hooks:
        environment["SCHEMATHESIS_HOOKS"] = "tests.contract.hooks"
    # The first upload waits for a child to start, which on a busy machine takes its time.
    patient = "--request-timeout=60"
    # The same cases for the same document. About once in ten thousand it gives an upload a field
    # that leaves no trace in the form, and takes it ill that such a form is accepted.
    seed = f"--seed={os.environ.get('FUZZ_SEED', '1')}"
    command = [sys.executable, "-m", "schemathesis.cli", "run", str(document), seed, patient]
    done = subprocess.run(
        [*command, *options],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=seconds,
    )
    return done.returncode, done.stdout
