"""What the README says is true, and it forgets nothing."""

import re
from pathlib import Path
from typing import get_args

import pytest

from api_schemas import feasibility, meshes
from api_schemas.families import Wrap
from api_schemas.lights import LIGHTS_MAX
from api_schemas.maps import MAPS_MAX, Filter
from api_schemas.output import SIDE_MAX
from api_schemas.scene import NODES_MAX
from service.json_body import DEPTH_MAX
from service.pointers import MESSAGES
from service.problems import TABLE
from service.settings import Settings
from worker.images.file_header import TEXELS_MAX
from worker.images.file_kinds import FILE_KINDS

README = (Path(__file__).resolve().parent.parent / "README.md").read_text()


def section(title: str) -> str:
    return re.split(r"^## ", README.partition(f"\n## {title}\n")[2], flags=re.M)[0]


@pytest.mark.parametrize("name", Settings.model_fields)
def test_every_setting_is_in_the_table_with_its_default_and_its_reason(name: str) -> None:
    field = Settings.model_fields[name]
    default = {(): "none", False: "false"}.get(field.default, field.default)
    shown = int(default) if isinstance(default, float) and default.is_integer() else default

    row = f"| `TEXLOOM_{name.upper()}` | `{shown}` | {field.description} |"

    assert row in section("Settings").splitlines()


def test_every_code_of_a_problem_is_in_the_row_of_its_status() -> None:
    rows = re.findall(r"^\| (\d+) \|.*\| (.*) \|$", section("Errors"), re.M)

    told = {int(status): set(re.findall(r"`(\w+)`", codes)) for status, codes in rows}

    assert told == {
        status: {code for code, (its, _) in TABLE.items() if its == status}
        for status, _ in TABLE.values()
    }


def test_every_code_of_a_mistake_in_a_body_is_told() -> None:
    for code, _ in MESSAGES.values():
        assert f"`{code}`" in section("Errors")


@pytest.mark.parametrize(
    "limit",
    [
        f"{SIDE_MAX} pixels a side",
        f"{TEXELS_MAX} in an upload",
        f"{feasibility.LEVELS_MAX} levels",
        f"{feasibility.TEXTURES_MAX} textures",
        f"{NODES_MAX} nodes",
        f"{MAPS_MAX} maps on a surface",
        f"{LIGHTS_MAX} lights",
        f"{DEPTH_MAX} levels of JSON",
    ],
)
def test_every_limit_is_the_one_of_the_code(limit: str) -> None:
    assert limit in " ".join(section("Limits").split())


def test_every_choice_of_the_language_is_named() -> None:
    """But techniques: adding one touches no file that exists, and the service tells of them."""
    for name in (*get_args(Wrap), *get_args(Filter)):
        assert f"`{name}`" in section("What it can do"), name
    for mesh in get_args(meshes.Primitive):
        (name,) = get_args(mesh.model_fields["type"].annotation)
        assert name.replace("_", " ") in section("What it can do")


def test_every_kind_of_upload_is_named() -> None:
    for kind in FILE_KINDS:
        named = {"openexr": "OpenEXR", "hdr": "Radiance HDR"}.get(kind.format, kind.format.upper())
        assert named in README
