"""Every technique has a golden picture: an example that shows it, small, as the executor makes it.

A texture's is its own example; a surface's or a kind of coordinates' is the first scene, in
alphabetical order, that uses it. So a new technique has its golden test before anyone writes one.
"""

import shutil

import pytest

from api_schemas.assets import AssetFacts
from api_schemas.digest import digest
from api_schemas.language import FAMILIES
from api_schemas.normalise import normalise
from api_schemas.requests import REQUESTS
from api_schemas.walk import parts
from tests.examples import ASSETS, examples, sha256
from worker import run_job
from worker.images import image_io

OUTPUT = {"size": [64, 64], "format": "exr", "exr_type": "float"}
REQUESTS_BY_EXAMPLE = {
    name: (kind, REQUESTS[kind].model_validate(body | {"output": OUTPUT}))
    for name, (kind, body) in examples().items()
}


def example_of(family, technique):
    if family == "textures":
        return technique
    return next(
        name
        for name, (kind, request) in sorted(REQUESTS_BY_EXAMPLE.items())
        if kind == "render"
        and any(isinstance(part, FAMILIES[family][technique]) for _, part in parts(request))
    )


@pytest.fixture(scope="module")
def assets(tmp_path_factory):
    """The examples' pictures, stored as the service stores uploads, and the facts of each."""
    folder = tmp_path_factory.mktemp("assets")
    facts = {}
    for path in ASSETS:
        name = sha256(path)
        (folder / name[:2]).mkdir(exist_ok=True)
        shutil.copy(path, folder / name[:2] / name)
        measured = dict(image_io.measure(path))
        known = {key: measured[key] for key in AssetFacts.model_fields.keys() & measured.keys()}
        facts[name] = AssetFacts(sha256=name, bytes=path.stat().st_size, **known)
    return folder, facts


@pytest.mark.golden
@pytest.mark.parametrize(
    ("family", "technique"),
    [
        pytest.param(family, technique, marks=[pytest.mark.gl] if family != "textures" else [])
        for family, specs in FAMILIES.items()
        for technique in specs
    ],
)
def test_an_example_looks_as_it_did(family, technique, assets, compare_with_golden, tmp_path):
    folder, facts = assets
    kind, request = REQUESTS_BY_EXAMPLE[example_of(family, technique)]
    request = normalise(request, "exr", facts)
    job = {
        "kind": kind,
        "body": request.model_dump(mode="json"),
        "digest": digest(request),
        "assets": str(folder),
    }

    run_job.run(job, tmp_path / "picture.exr", lambda progress, stage: None)

    picture = image_io.read(tmp_path / "picture.exr", "linear", "colour")
    compare_with_golden(picture, f"{technique}/example")
