"""The README's lines do what the README says."""

import re
import subprocess
from pathlib import Path

import pytest

from tests.examples import ASSETS

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = re.findall(r"^curl .*(?:\\\n.*)*$", (ROOT / "README.md").read_text(), re.MULTILINE)
MAGIC = {".png": b"\x89PNG\r\n\x1a\n", ".exr": b"\x76\x2f\x31\x01"}


@pytest.fixture
def clone(tmp_path):
    """A folder that looks like a clone to commands that read examples and write pictures."""
    (tmp_path / "api_schemas").symlink_to(ROOT / "api_schemas")
    return tmp_path


def run(command, service, folder):
    command = command.replace("http://127.0.0.1:8000", service.url).replace(
        " 127.0.0.1:8000", f" {service.url}"
    )
    return subprocess.run(
        command.replace("curl ", "curl --fail-with-body -sS ", 1),
        shell=True,
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=120,
    )


def test_the_first_screen_shows_the_two_commands_and_a_picture_in_each_format():
    screen = "\n".join((ROOT / "README.md").read_text().splitlines()[:40])

    assert "make run" in screen
    assert "make test" in screen
    assert len(re.findall(r"^curl .*soda_can", screen, re.MULTILINE)) == 2


def test_every_curl_line_works_in_the_order_it_is_written(service, clone):
    assert COMMANDS
    with service.client() as client:
        for asset in ASSETS:
            assert client.post("/v1/assets", content=asset.read_bytes()).is_success
    for command in COMMANDS:
        done = run(command, service, clone)

        assert done.returncode == 0, (command, done.stdout, done.stderr)
        for name in re.findall(r"-o (\S+)", command):
            suffix = Path(name).suffix
            assert (clone / name).read_bytes().startswith(MAGIC[suffix]), command
