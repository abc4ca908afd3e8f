"""Which parts of a model are seen, and with what surface."""

from typing import Any

import numpy as np
import pytest

from api_schemas.model_mesh import ModelMesh
from api_schemas.surfaces.unlit import UnlitSpec
from tests.worker.rendering.studio import Studio
from worker.errors import RenderError
from worker.geometry.plane import plane
from worker.models.model import Model, NamedSurface, Part
from worker.rendering.model_changes import seen_parts

ASSET = "0" * 64
MESH = plane(1, 1, "+z")


def unlit(grey: float) -> UnlitSpec:
    return UnlitSpec(technique="unlit", color=[grey, grey, grey])


# Two wheels share a name and a material; the body has another; the last part has neither.
MODEL = Model(
    parts=tuple(
        Part(MESH, np.eye(4), node, material, str(place))
        for place, (node, material) in enumerate([(0, 0), (1, 0), (2, 1), (None, None)])
    ),
    node_names=("wheel", "wheel", "body", ""),
    surfaces=(NamedSurface("rubber", unlit(0.1)), NamedSurface("paint", unlit(0.2))),
    cameras=(),
    lights=(),
    pictures={},
    warnings=(),
)


def seen(**changes: Any) -> list[tuple[str, float | None]]:
    mesh = ModelMesh.model_validate({"type": "model", "asset": ASSET, **changes})
    return [
        (part.key, surface.color[0] if isinstance(surface, UnlitSpec) else None)
        for part, surface in seen_parts(mesh, MODEL)
    ]


def changed(grey: float) -> dict[str, Any]:
    return {"technique": "unlit", "color": [grey, grey, grey]}


def test_without_changes_each_part_has_its_own_material() -> None:
    assert seen() == [("0", 0.1), ("1", 0.1), ("2", 0.2), ("3", None)]


@pytest.mark.parametrize("material", ["rubber", 0])
def test_a_material_is_replaced_wherever_it_is_worn(material: str | int) -> None:
    changes = [{"material": material, "surface": changed(0.5)}]

    assert seen(materials=changes) == [("0", 0.5), ("1", 0.5), ("2", 0.2), ("3", None)]


def test_a_name_addresses_all_nodes_that_bear_it_and_an_index_one() -> None:
    assert seen(nodes=[{"node": "wheel", "visible": False}]) == [("2", 0.2), ("3", None)]
    assert seen(nodes=[{"node": 1, "visible": False}]) == [("0", 0.1), ("2", 0.2), ("3", None)]


def test_a_node_wins_over_a_material_and_the_last_change_over_the_first() -> None:
    found = seen(
        materials=[{"material": "rubber", "surface": changed(0.5)}],
        nodes=[
            {"node": 0, "visible": False},
            {"node": 0, "surface": changed(0.6)},
            {"node": 0, "surface": changed(0.7)},
        ],
    )

    assert found == [("0", 0.7), ("1", 0.5), ("2", 0.2), ("3", None)]


@pytest.mark.parametrize(
    "changes",
    [
        {"nodes": [{"node": "door"}]},
        {"nodes": [{"node": 4}]},
        {"materials": [{"material": "glass", "surface": changed(1)}]},
        {"materials": [{"material": 2, "surface": changed(1)}]},
    ],
)
def test_what_the_model_does_not_have_is_told(changes: dict[str, Any]) -> None:
    with pytest.raises(RenderError) as error:
        seen(**changes)

    assert error.value.code == "model_part_unknown"


@pytest.mark.gl
def test_the_surface_of_the_node_covers_those_of_the_model(studio: Studio) -> None:
    studio.models[ASSET] = MODEL
    scene = {
        "camera": {"type": "orthographic", "height": 0.5, "pose": {"eye": [0.0, 0.0, 2.0]}},
        "nodes": [{"mesh": {"type": "model", "asset": ASSET}, "surface": changed(0.75)}],
    }

    np.testing.assert_array_equal(studio.draw(scene, (2, 2))[..., :3], 0.75)
