"""What is seen of a dish while it reacts."""

import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.synthesis import outcome

NOISE = {"technique": "perlin", "frequency": 4}


def shown(technique, **fields):
    """The pictures of a dish that is not ready, and the one of the dish that is."""
    body = {"technique": technique, "size": [32, 24], "steps": 200, **fields}
    seen = []
    made = outcome(
        TypeAdapter(Texture).validate_python(body),
        (32, 24),
        lambda spec, meaning: pytest.fail("there are no uploads"),
        show=seen.append,
    )
    return seen, made.image


@pytest.mark.parametrize(
    ("technique", "fields"),
    [
        ("gray_scott", {}),
        ("gray_scott", {"chemical": "u"}),
        ("turing", {}),
        ("turing", {"range": "raw"}),
        ("anisotropic_diffusion", {"input": NOISE}),
    ],
)
def test_after_every_64_steps_the_dish_is_shown_as_it_is_then(technique, fields):
    seen, _ = shown(technique, **fields)

    for number, picture in enumerate(seen, 1):
        _, then = shown(technique, **fields, steps=64 * number)
        assert picture.meaning == then.meaning
        assert picture.pixels.shape == then.pixels.shape
        assert picture.pixels.tobytes() == then.pixels.tobytes()
    assert len(seen) == 3


def test_a_dish_that_is_ready_at_once_shows_nothing_before():
    seen, _ = shown("turing", steps=60)

    assert seen == []
