"""Every technique has a golden picture: an example that shows it, small, as the executor makes it.

A texture's is its own example; that of another technique is the scene of its name, else the one
that shows the fewest techniques besides it. So a new technique has its golden test before anyone
writes one. Those that many scenes show keep the scene they had, whatever scenes are added.
"""

import pytest

from api_schemas.families import TechniqueSpec
from api_schemas.language import FAMILIES
from api_schemas.requests import REQUESTS
from api_schemas.walk import parts
from tests.examples import examples
from tests.run_example import run_example
from worker.images import image_io

KEPT = {
    "metallic_roughness": "polished_to_rough",
    "phong": "soda_can",
    "unlit": "labelled_can",
    "uv": "soda_can",
    "ward": "brushed",
}


def example_of(family, technique):
    if family == "textures":
        return technique
    if technique in KEPT:
        return KEPT[technique]
    spec = FAMILIES[family][technique]
    shown = {name: set(_specs_of(*example)) for name, example in examples().items()}
    scenes = [name for name, specs in shown.items() if spec in specs and name in _scenes()]
    return min(scenes, key=lambda name: (name != technique, len(shown[name]), name))


def _scenes():
    return {name for name, (kind, _) in examples().items() if kind == "render"}


def _specs_of(kind, body):
    for _, part in parts(REQUESTS[kind].model_validate(body)):
        if isinstance(part, TechniqueSpec):
            yield type(part)


@pytest.mark.golden
@pytest.mark.parametrize(
    ("family", "technique"),
    [
        pytest.param(family, technique, marks=[pytest.mark.gl] if family != "textures" else [])
        for family, specs in FAMILIES.items()
        for technique in specs
    ],
)
def test_an_example_looks_as_it_did(family, technique, compare_with_golden, tmp_path):
    path = tmp_path / "picture.exr"

    run_example(
        example_of(family, technique),
        path,
        tmp_path / "assets",
        size=[64, 64],
        format="exr",
        exr_type="float",
    )

    compare_with_golden(image_io.read(path, "linear", "colour"), f"{technique}/example")
