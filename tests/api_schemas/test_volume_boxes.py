"""What fills a box is refused where there is none."""

from typing import Any

import pytest

from api_schemas.feasibility import obstacles
from api_schemas.requests import RenderRequest

CONSTANT = {"technique": "constant", "value": 0.4}
BOX = {"mesh": {"type": "box"}, "surface": {"technique": "volume"}}


def test_a_plain_box_is_filled() -> None:
    assert obstacles(RenderRequest.model_validate({"scene": {"nodes": [BOX]}})) == []


@pytest.mark.parametrize(
    ("node", "pointer"),
    [
        ({"mesh": {"type": "sphere"}, "surface": {"technique": "volume"}}, "/surface"),
        (
            BOX | {"displacement": {"texture": CONSTANT, "depth": 0.1}},
            "/surface",
        ),
        (
            {
                "mesh": {"type": "torus"},
                "surface_map": {
                    "texture": CONSTANT,
                    "surfaces": [{"technique": "unlit"}, {"technique": "volume"}],
                },
            },
            "/surface_map/surfaces/1",
        ),
    ],
)
def test_what_is_no_plain_box_is_refused_at_its_place(node: dict[str, Any], pointer: str) -> None:
    request = RenderRequest.model_validate({"scene": {"nodes": [{"children": [node]}]}})

    (found,) = obstacles(request)

    assert (found.code, found.pointer) == (
        "volume_without_box",
        f"/scene/nodes/0/children/0{pointer}",
    )
