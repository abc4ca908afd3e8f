"""Golden pictures of the examples of relief; worker/rendering has no technique for each of them."""

from pathlib import Path
from typing import Any

import pytest

from tests.run_example import run_example
from worker.images import image_io

pytestmark = [pytest.mark.gl, pytest.mark.golden]


@pytest.mark.parametrize("kind", ["bump", "displaced", "height", "normals", "parallax"])
def test_a_relief_looks_as_it_did(kind: str, compare_with_golden: Any, tmp_path: Path) -> None:
    path = tmp_path / "picture.exr"

    run_example(
        f"relief_{kind}",
        path,
        tmp_path / "assets",
        size=[64, 40],
        format="exr",
        exr_type="float",
    )

    compare_with_golden(image_io.read(path, "linear", "colour"), f"relief/{kind}")
