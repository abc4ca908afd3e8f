"""A render is drawn and written in bands: its memory does not grow with its height."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.gl

ROOT = Path(__file__).resolve().parents[2]
MEBIBYTE = 1 << 20
PROGRAM = """
import sys
from pathlib import Path
from tests.worker.test_run_job import run, table

def peak():
    # ru_maxrss would begin with what the process held that started this one.
    return int(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0]) * 1024

out = Path(sys.argv[1])
# Two bands and sixteen, or more of them with layers; a first picture leaves its targets behind.
for height in (1024, 1024, 8192):
    run(out, "render", table(), size=[2048, height], **eval(sys.argv[2]))
    print(peak())
"""


@pytest.mark.parametrize(
    ("output", "bytes_per_pixel"),
    [
        ({"format": "png", "supersampling": 2}, 4 + 16),
        ({"format": "exr", "layers": ["depth"], "supersampling": 1}, 16 + 4),
    ],
    ids=["png", "exr"],
)
def test_a_taller_picture_takes_no_more_memory(
    tmp_path: Path, output: dict[str, object], bytes_per_pixel: int
) -> None:
    finished = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(tmp_path / "picture"), repr(output)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
    )

    assert finished.returncode == 0, finished.stderr
    _, low, tall = map(int, finished.stdout.split())
    rest_of_it = 2048 * (8192 - 1024) * bytes_per_pixel
    assert tall - low < 64 * MEBIBYTE < rest_of_it / 4
