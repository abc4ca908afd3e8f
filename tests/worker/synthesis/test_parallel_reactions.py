"""Reactions by one thread and by several: the same bits."""

import pytest
from pydantic import TypeAdapter

from api_schemas.dishes import ReactionSpec
from api_schemas.language import FAMILIES, Texture
from worker.synthesis import outcome

REACTIONS = [n for n, spec in FAMILIES["textures"].items() if issubclass(spec, ReactionSpec)]


@pytest.mark.parametrize("across", [1.0, 0.3])
@pytest.mark.parametrize("name", REACTIONS)
def test_pixels_do_not_depend_on_the_number_of_threads(with_threads, name, across):
    body = {"size": [48, 37], "steps": 70, "disturbance": 0.5, "across": across}
    described = TypeAdapter(Texture).validate_python({"technique": name, **body})

    one = with_threads(1, lambda: outcome(described, (48, 37), None).image.pixels.tobytes())
    two = with_threads(2, lambda: outcome(described, (48, 37), None).image.pixels.tobytes())

    assert one == two
