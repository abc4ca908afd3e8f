"""Pictures, lights and reliefs that cannot be: the place of each mistake, before work starts."""

from typing import Any

import pytest

from api_schemas.lights import LIGHTS_MAX
from api_schemas.requests import RenderRequest
from tests.service.test_pointers import problems

PLAIN = {"technique": "constant", "value": 0.5}
FACES = ("front", "right", "back", "left", "top", "bottom")
LAMP = {"type": "point", "position": [0, 1, 0]}


def refused(**scene: Any) -> dict[str, str]:
    """The pointers and codes of what the schema refuses of a scene."""
    return problems(RenderRequest, {"scene": {"nodes": [], **scene}})


@pytest.mark.parametrize("missing", FACES)
def test_t20_a_cube_of_five_faces_lacks_one(missing: str) -> None:
    faces = {name: PLAIN for name in FACES if name != missing}
    environment = {
        "texture": {"technique": "six_faces", **faces},
        "layout": {"technique": "cube"},
    }

    found = refused(environment=environment)

    assert found == {f"/scene/environment/texture/{missing}": "missing"}


def test_more_lights_than_there_is_room_for() -> None:
    assert refused(lights=[LAMP] * (LIGHTS_MAX + 1)) == {"/scene/lights": "wrong_length"}


def test_a_face_that_is_no_texture() -> None:
    faces: dict[str, Any] = dict.fromkeys(FACES, PLAIN)

    found = refused(environment={"texture": {"technique": "six_faces", **faces, "top": None}})

    assert found == {"/scene/environment/texture/top": "wrong_type"}
