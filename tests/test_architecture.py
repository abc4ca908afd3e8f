"""The house rules that no linter checks."""

import inspect
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from api_schemas.language import FAMILIES
from api_schemas.requests import REQUESTS
from api_schemas.walk import parts
from tests.examples import examples

ROOT = Path(__file__).resolve().parent.parent
MOST_LINES = 300

# Where the worker's part of a technique lies, by its name.
IMPLEMENTATIONS = {
    "textures": "worker/synthesis/{}.py",
    "surfaces": "worker/rendering/shaders/surfaces/{}.glsl",
    "coordinates": "worker/rendering/shaders/coordinates/{}.glsl",
    "layouts": "worker/layouts/{}.py",
}

TECHNIQUES = [(family, name) for family, specs in FAMILIES.items() for name in specs]


def test_the_service_loads_no_native_code() -> None:
    native = {"numpy", "numba", "scipy", "OpenGL", "pyrender", "OpenImageIO", "trimesh"}
    program = f"import sys, service.app; print(*sorted({native} & set(sys.modules)))"

    loaded = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True
    )

    assert loaded.stderr == ""
    assert loaded.stdout.split() == []


def test_no_module_is_longer_than_300_lines() -> None:
    sources = [
        path
        for folder in ("api_schemas", "service", "worker", "tests", "docker")
        for suffix in (".py", ".glsl", ".sh", ".js")
        for path in (ROOT / folder).rglob(f"*{suffix}")
    ]

    too_long = [
        f"{path.relative_to(ROOT)}: {lines} lines"
        for path in sources
        if (lines := len(path.read_text().splitlines())) > MOST_LINES
    ]

    assert too_long == []


def test_the_map_of_the_architecture_is_that_of_the_house() -> None:
    page = (ROOT / "ARCHITECTURE.md").read_text().partition("\n## The map\n")[2].partition("## ")[0]
    top = ""
    told: dict[str, set[str]] = {}
    for line in page.splitlines():
        top = match[1] if (match := re.match(r"(\w+)/", line)) else top
        told.setdefault(top, set()).update(re.findall(r"\b\w+\.py\b", line))

    there = {
        path.name for folder in ("api_schemas", "worker") for path in (ROOT / folder).glob("*.py")
    }

    assert told["api_schemas"] | told["worker"] == there - {"__init__.py"}
    assert all((ROOT / "service" / name).is_file() for name in told["service"])
    assert len(told["service"]) > 5


@pytest.mark.parametrize(("family", "technique"), TECHNIQUES)
def test_a_technique_has_its_implementation(family: str, technique: str) -> None:
    assert (ROOT / IMPLEMENTATIONS[family].format(technique)).is_file()


@pytest.mark.parametrize(("family", "technique"), TECHNIQUES)
def test_a_technique_says_all_that_its_family_asks(family: str, technique: str) -> None:
    assert not inspect.isabstract(FAMILIES[family][technique])


def test_a_layout_is_known_to_numpy_and_to_shaders() -> None:
    chunks = (ROOT / "worker/rendering/shaders/layouts").glob("*.glsl")

    assert {path.stem for path in chunks} == set(FAMILIES["layouts"])


@pytest.mark.parametrize(("family", "technique"), TECHNIQUES)
def test_a_technique_has_an_example_that_shows_it(family: str, technique: str) -> None:
    """Written there or filled in: `uv` is where a map looks unless it says otherwise."""
    requests = [REQUESTS[kind].model_validate(body) for kind, body in examples().values()]

    assert any(isinstance(part, FAMILIES[family][technique]) for _, part in parts(requests))


@pytest.mark.parametrize(("family", "technique"), TECHNIQUES)
def test_a_technique_has_a_golden_picture(family: str, technique: str) -> None:
    assert list((ROOT / "tests" / "golden" / technique).glob("*.exr"))


@pytest.mark.parametrize("family", IMPLEMENTATIONS)
def test_an_implementation_has_its_spec(family: str) -> None:
    """A leading underscore marks what techniques share."""
    pattern = ROOT / IMPLEMENTATIONS[family].format("*")
    implemented = {path.stem for path in pattern.parent.glob(pattern.name)}

    unknown = {name for name in implemented if not name.startswith("_")} - set(FAMILIES[family])

    assert unknown == set()


@pytest.mark.parametrize("lock", ["requirements.lock", "requirements-dev.lock"])
def test_a_lock_names_no_place_to_download_from(lock: str) -> None:
    text = (ROOT / lock).read_text()

    assert not re.search(r"://|\bfile:|--(find-links|(extra-)?index-url|trusted-host)|@ ", text)


def test_the_changelog_tells_of_this_version() -> None:
    version = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"]

    assert re.search(rf"^## \[?{re.escape(version)}\b", (ROOT / "CHANGELOG.md").read_text(), re.M)


def test_each_row_of_the_techniques_leads_to_its_test_and_its_example() -> None:
    page = (ROOT / "ARCHITECTURE.md").read_text().partition("\n## Where each technique is\n")[2]
    rows = re.findall(r"^\| ([TX]\d\d[^|]*) \|[^|]+\| `([^`]+)` \|(?: `(\w+)`)? \|$", page, re.M)
    written = examples()

    assert len(rows) > 70
    for name, test, example in rows:
        assert (ROOT / "tests" / f"{test}.py").is_file(), name
        assert example in written or name == "X18", name
