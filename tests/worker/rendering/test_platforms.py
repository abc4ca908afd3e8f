"""Equal bytes on OSMesa and EGL, and for any number of threads."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.requirements import skip_or_fail

pytestmark = pytest.mark.gl

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = """
import hashlib
import numpy as np
from typing import get_args
from api_schemas.output import Layer
from tests.worker.rendering.panes import glass_scene
from tests.worker.rendering.studio import Studio
from tests.worker.rendering.test_metallic_roughness import polished_things
from tests.worker.rendering.test_renderer import still_life
from tests.worker.rendering.test_shadows import LIGHTS, scene
from tests.worker.rendering.test_volume import noisy_cloud
from worker.rendering.renderer import fingerprint, render

studio = Studio(render)
pixels = studio.draw(still_life(studio), (300, 200), 2)
assert pixels.any()
pixels = np.concatenate([pixels, studio.draw(polished_things(studio), (300, 200), 2)])
layers = studio.layers(still_life(studio), get_args(Layer), (200, 300), 3)
bits = pixels.tobytes() + studio.draw(glass_scene(studio), (200, 150), 2).tobytes()
bits += studio.draw(noisy_cloud(), (64, 48), 2).tobytes()
for light in LIGHTS.values():
    bits += studio.draw(scene(light | {"shadow": {}}), (100, 100)).tobytes()
bits += b"".join(layers[name].tobytes() for name in sorted(layers))
print(hashlib.sha256(bits).hexdigest(), fingerprint(), sep="|")
"""


def drawn_by(**environment: str) -> tuple[int, str, str]:
    """Draw in a process of its own; the return code, what it printed and its complaint."""
    finished = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env={**os.environ, "PYTHONPATH": str(ROOT), **environment},
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=120,
    )
    return finished.returncode, finished.stdout.strip(), finished.stderr


@pytest.fixture(scope="module")
def reference() -> str:
    code, printed, complaint = drawn_by(LP_NUM_THREADS="1")
    assert code == 0, complaint
    assert complaint == ""
    return printed


@pytest.mark.parametrize("threads", ["2", "4"])
def test_the_number_of_threads_does_not_change_a_bit(reference: str, threads: str) -> None:
    assert drawn_by(LP_NUM_THREADS=threads)[1] == reference


@pytest.mark.parametrize("platform", ["osmesa", "egl"])
def test_both_platforms_draw_the_same_bits(reference: str, platform: str) -> None:
    code, printed, complaint = drawn_by(PYOPENGL_PLATFORM=platform, LP_NUM_THREADS="2")
    if code and platform != os.environ["PYOPENGL_PLATFORM"]:
        skip_or_fail(f"no {platform} here: {complaint.strip().splitlines()[-1]}", "REQUIRE_GL")

    assert printed == reference, complaint
