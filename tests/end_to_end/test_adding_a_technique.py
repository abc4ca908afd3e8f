"""A technique is added as ARCHITECTURE.md says, in a copy of the project: no other file changes."""

import hashlib
import json
import shutil
import subprocess
import sys

import pytest

from tests.running_service import ROOT

# It compiles every kernel anew, which takes two minutes: left to `make test-all`.
pytestmark = [
    pytest.mark.end_to_end,
    pytest.mark.gl,
    pytest.mark.contract,
    pytest.mark.timeout(900),  # what lies elsewhere is compiled anew
]

SPEC = '''
"""Bands of two greys."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.families import TextureSpec


class StripesSpec(TextureSpec):
    """Upright bands, half dark and half bright."""

    source: ClassVar[str] = "none needed"
    equation: ClassVar[str] = "frac(count u) < 1/2"

    technique: Literal["stripes"]
    count: Annotated[int, Field(ge=1, le=64), WHOLE] = Field(default=2, description="Bands.")
'''
IMPLEMENTATION = '''
"""Bands of two greys."""

from collections.abc import Mapping

import numpy as np

from api_schemas.textures.stripes import StripesSpec
from worker.images.image import Image
from worker.stages import Report


def synthesize(
    spec: StripesSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Image:
    """Draw bands."""
    width, height = size
    u = (np.arange(width) + 0.5) / width
    row = np.where(spec.count * u % 1 < 0.5, 0.0, 1.0).astype(np.float32)
    return Image(np.tile(row[None, :, None], (height, 1, 1)), "colour")
'''
EXAMPLE = {"texture": {"technique": "stripes", "count": 2}, "output": {"size": [8, 4]}}


@pytest.fixture
def copy(tmp_path):
    folder = tmp_path / "texloom"
    for name in ("api_schemas", "service", "worker", "tests", "docker"):
        ignored = shutil.ignore_patterns("__pycache__", ".failures")
        shutil.copytree(ROOT / name, folder / name, ignore=ignored)
    for path in ROOT.iterdir():
        if path.is_file():
            shutil.copy(path, folder)
    return folder


def hashes(folder):
    return {
        path.relative_to(folder): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_a_new_texture_is_in_the_language_the_catalogue_and_the_renderer(copy, make_service):
    before = hashes(copy)
    (copy / "api_schemas/textures/stripes.py").write_text(SPEC.lstrip())
    (copy / "worker/synthesis/stripes.py").write_text(IMPLEMENTATION.lstrip())
    (copy / "api_schemas/examples/textures/stripes.json").write_text(json.dumps(EXAMPLE))

    service = make_service(folder=copy, slots="1")
    with service.client() as client:
        page = client.get("/v1/techniques/textures/stripes").json()
        picture = client.post("/v1/textures", json=EXAMPLE, headers={"Accept": "image/png"})
        scene = json.loads((copy / "api_schemas/examples/renders/soda_can.json").read_text())
        surface = scene["scene"]["nodes"][0]["surface"]
        surface["diffuse_color"] = {"texture": {"technique": "stripes"}}
        can = client.post("/v1/renders", json=scene, headers={"Accept": "image/png"})
        refused = client.post(
            "/v1/textures", json={"texture": {"technique": "stripes", "count": 0}}
        )
        published = client.get("/openapi.json").json()
    family = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-k", "stripes", "tests/families"],
        cwd=copy,
        env={"PYTHONPATH": str(copy), "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
    )
    after = hashes(copy)

    assert page["source"] == "none needed"
    assert picture.content.startswith(b"\x89PNG")
    assert can.content.startswith(b"\x89PNG")
    assert refused.status_code == 422
    assert "StripesSpec" in published["components"]["schemas"]
    assert "stripes" in family.stdout
    assert "There is no golden picture" in family.stdout
    assert {path: after[path] for path in before} == before
