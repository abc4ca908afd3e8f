"""Compositions with names: nothing but what they are composed of."""

import pytest
from pydantic import TypeAdapter

from api_schemas.families import PresetSpec
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from api_schemas.solid import flat_parts
from worker.synthesis import synthesize, synthesize_volume

PRESETS = sorted(n for n, s in FAMILIES["textures"].items() if issubclass(s, PresetSpec))


def spec(body):
    return TypeAdapter(Texture).validate_python(body)


def test_there_are_clouds_fire_and_granite():
    assert {"clouds", "fire", "granite"} <= set(PRESETS)


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_is_its_composition_bit_for_bit(name):
    preset = spec({"technique": name, "seed": 5})
    composed = spec(preset.composed().model_dump())

    pictures = [synthesize(texture, (40, 30), None).pixels for texture in (preset, composed)]
    assert pictures[0].tobytes() == pictures[1].tobytes()
    assert (
        synthesize_volume(preset, (9, 8, 7)).voxels.tobytes()
        == synthesize_volume(composed, (9, 8, 7)).voxels.tobytes()
    )
    assert list(flat_parts(composed)) == []


@pytest.mark.parametrize("name", PRESETS)
def test_a_preset_costs_what_it_is_composed_of(name):
    preset = spec({"technique": name})

    assert preset.cost(1000).seconds > preset.composed().cost(1000).seconds
    assert preset.volume_cost(1000).bytes > preset.composed().volume_cost(1000).bytes


def test_more_coverage_is_more_cloud():
    pictures = [
        synthesize(spec({"technique": "clouds", "coverage": share}), (64, 64), None).pixels
        for share in (0.0, 0.5, 1.0)
    ]

    means = [picture[..., 0].mean() for picture in pictures]
    # From the sky's red, .1, to the cloud's, .9
    assert means[0] < 0.2 < means[1] < 0.8 < means[2]


def test_fire_burns_at_the_end_of_time_as_at_its_beginning():
    def burning(time):
        return synthesize(spec({"technique": "fire", "time": time}), (48, 48), None).pixels

    assert (burning(0.0) == burning(1.0)).all()
    assert abs(burning(0.0) - burning(0.3)).mean() > 0.05
