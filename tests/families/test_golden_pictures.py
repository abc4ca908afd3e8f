"""Every technique has a golden picture: an example that shows it, small, as the executor makes it.

A texture's is its own example; a surface's or a kind of coordinates' is the first scene, in
alphabetical order, that uses it. So a new technique has its golden test before anyone writes one.
"""

import pytest

from api_schemas.language import FAMILIES
from api_schemas.requests import REQUESTS
from api_schemas.walk import parts
from tests.examples import examples
from tests.run_example import run_example
from worker.images import image_io


def example_of(family, technique):
    if family == "textures":
        return technique
    spec = FAMILIES[family][technique]
    return next(
        name
        for name, (kind, body) in sorted(examples().items())
        if kind == "render"
        and any(isinstance(part, spec) for _, part in parts(REQUESTS[kind].model_validate(body)))
    )


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
