from typing import get_args

from api_schemas.output import Layer
from api_schemas.output_cost import LAYER_CHANNELS
from worker.rendering.packing import ATTACHMENTS, AVERAGED, PICTURE, PLACES


def test_every_layer_of_the_language_has_a_place() -> None:
    assert set(PLACES) == {PICTURE, *get_args(Layer)}
    assert {name: PLACES[name].channels for name in get_args(Layer)} == LAYER_CHANNELS


def test_what_must_not_be_averaged_is_not() -> None:
    averaged = {name for name, place in PLACES.items() if place.attachment < AVERAGED}

    assert averaged == {PICTURE, "albedo", "coverage", "shading_difference"}
    assert max(place.attachment for place in PLACES.values()) == ATTACHMENTS - 1 < 8
