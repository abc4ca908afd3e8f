"""T38: every row of the table of applications has an example, and it looks as it did.

What each row means is tested beside its code; rows that are techniques of their own have their
golden pictures in tests/families.
"""

from pathlib import Path
from typing import Any

import pytest

from tests.run_example import run_example
from worker.images import image_io

pytestmark = pytest.mark.gl

EXAMPLES = [
    "cookies",
    "cut_out",
    "gloss",
    "lanterns",
    "light_map",
    "material_map",
    "occlusion",
    "shadows",
    "turntable",
]


@pytest.mark.golden
@pytest.mark.parametrize("name", EXAMPLES)
def test_t38_an_application_looks_as_it_did(
    name: str, compare_with_golden: Any, tmp_path: Path
) -> None:
    path = tmp_path / "picture.exr"

    run_example(name, path, tmp_path / "assets", size=[96, 72], format="exr", exr_type="float")

    compare_with_golden(image_io.read(path, "linear", "colour"), f"{name}/example")
