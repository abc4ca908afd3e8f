import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_a_data_folder_that_cannot_be_is_told_in_one_line(tmp_path, place):
    (tmp_path / "file").touch()

    ended = subprocess.run(
        [sys.executable, "-m", "service"],
        cwd=ROOT,
        env=os.environ
        | {"TEXLOOM_DATA": str(tmp_path / place), "TEXLOOM_PORT": "0", "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )

    assert ended.returncode == 1
    assert ended.stderr.startswith("texloom: cannot use the data folder")
    assert ended.stderr.count("\n") == 1
