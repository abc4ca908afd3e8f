from typing import get_args

from api_schemas.output import Layer
from api_schemas.output_cost import LAYER_CHANNELS
from worker.rendering.packing import ATTACHMENTS, AVERAGED, PICTURE, PLACES, SAMPLED


def test_every_layer_of_the_language_has_a_place() -> None:
    channels = {name: place.channels for name, place in PLACES.items() if name != PICTURE}
    # Three times id, share, id, share, and a colour for the eye.
    channels |= dict.fromkeys(SAMPLED, 3 * 4 + 3)

    assert set(channels) == set(get_args(Layer))
    assert channels == LAYER_CHANNELS


def test_what_must_not_be_averaged_is_not() -> None:
    averaged = {name for name, place in PLACES.items() if place.attachment < AVERAGED}

    assert averaged == {PICTURE, "albedo", "coverage", "shading_difference"}
    assert max(place.attachment for place in PLACES.values()) == ATTACHMENTS - 1 < 8
