"""Golden pictures: brushed things in an environment (T65, T09), far bumps (X21)."""

from pathlib import Path
from typing import Any

import pytest

from tests.run_example import run_example
from worker.images import image_io

pytestmark = [pytest.mark.gl, pytest.mark.golden]


@pytest.mark.parametrize("name", ["added_up", "brushed_in_the_open", "fine_detail", "turned_metal"])
def test_highlights_look_as_they_did(name: str, compare_with_golden: Any, tmp_path: Path) -> None:
    path = tmp_path / "picture.exr"

    run_example(name, path, tmp_path / "assets", size=[96, 48], format="exr", exr_type="float")

    compare_with_golden(image_io.read(path, "linear", "colour"), f"{name}/example")
