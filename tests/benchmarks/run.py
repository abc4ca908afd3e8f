"""Runs every bench_<name>.py of this folder and writes what it measured to RESULTS.md.

A benchmark is a module whose docstring says what is measured and whose `measure()` returns rows:
mappings from column to value, in general `work`, `figure`, `unit`, `note`. Each runs in a process
of its own with the environment of the worker, so none inherits another's threads or memory.
"""

import datetime
import json
import os
import platform
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

from worker.jobs.environment import child_environment

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parent.parent
RESULTS = FOLDER / "RESULTS.md"
ENDURED = "\n# Endured\n"
"""Heads what `make faults` and `make soak` print, which is put there by hand and stays."""
PROGRAM = "import json, sys, importlib as i; m = i.import_module(sys.argv[1]); \
print('\\n' + json.dumps({'title': m.__doc__, 'rows': [dict(row) for row in m.measure()]}))"
LIBRARIES = ("numpy", "numba", "scipy", "OpenImageIO", "pyrender-maintained")


def main() -> None:
    """Measure everything, then write; a benchmark that fails leaves the old results in place."""
    worker_environment = child_environment(
        ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
    )
    environment = os.environ | worker_environment | {"PYTHONPATH": str(ROOT)}
    sections = [machine_facts(environment)]
    for path in sorted(FOLDER.glob("bench_*.py")):
        print(f"bench: {path.stem}", flush=True)
        sections.append(measured(path.stem, environment))
    _, heading, kept = RESULTS.read_text().partition(ENDURED)
    RESULTS.write_text("\n".join(sections) + heading + kept)
    print(f"bench: wrote {RESULTS}")


def measured(name: str, environment: dict[str, str]) -> str:
    """Run one benchmark and draw its rows as a table."""
    finished = subprocess.run(
        [sys.executable, "-c", PROGRAM, f"tests.benchmarks.{name}"],
        stdout=subprocess.PIPE,
        text=True,
        env=environment,
        cwd=ROOT,
    )
    if finished.returncode:
        sys.exit(f"bench: {name} failed, see above")
    result = json.loads(finished.stdout.splitlines()[-1])
    heading, *rest = (result["title"] or name).strip().split("\n", 1)
    return f"## {heading.rstrip('.')}\n{''.join(rest).rstrip()}\n\n{table(result['rows'])}"


def table(rows: list[dict[str, object]]) -> str:
    """Draw rows as a Markdown table; numbers get three significant digits."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    lines = [columns, ["---"] * len(columns)]
    lines += [[shown(row.get(column, "")) for column in columns] for row in rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def shown(value: object) -> str:
    """A value as a table cell."""
    return f"{value:.3g}" if isinstance(value, float) and abs(value) < 1000 else str(value)


def machine_facts(environment: dict[str, str]) -> str:
    """Say what the figures were measured on, and of which revision."""
    facts = {
        "Date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "Revision": answer(["git", "describe", "--always", "--dirty"], environment),
        "Processor": f"{processor()}, {len(os.sched_getaffinity(0))} cores",
        "System": f"{os_name()}, Linux {platform.release()}",
        "Python": platform.python_version(),
        "OpenGL": answer([sys.executable, "-m", "tests.opengl_probe"], environment),
        "Libraries": ", ".join(f"{library} {version(library)}" for library in LIBRARIES),
    }
    lines = "".join(f"- {name}: {fact}\n" for name, fact in facts.items())
    return f"# Measured\n\nWritten by `make bench`.\n\n{lines}"


def answer(command: list[str], environment: dict[str, str]) -> str:
    """The line a command prints, or that there is none."""
    finished = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, env=environment)
    return finished.stdout.strip() if finished.returncode == 0 else "unknown"


def processor() -> str:
    """The processor's name as the kernel knows it."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.machine()


def os_name() -> str:
    """The distribution's own name."""
    return platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())


if __name__ == "__main__":
    main()
