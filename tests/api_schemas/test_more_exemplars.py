"""What a request with several exemplars is refused for, how it is read and what it costs."""

import pytest

from api_schemas.assets import ImageFacts
from api_schemas.estimate import estimate
from api_schemas.feasibility import assets_in, obstacles
from api_schemas.normalise import normalise
from api_schemas.requests import TextureRequest
from api_schemas.side_by_side import corners, gap, whole
from tests.growing import upload

SIDES = {0: (300, 200), 1: (100, 260), 2: (64, 64)}
FACTS = {
    f"{index:064x}": ImageFacts(
        sha256=f"{index:064x}", media_type="image/png", format="png", bytes=1, kind="image",
        width=width, height=height, channels=3, bits=8, float=False, has_alpha=False,
    )
    for index, (width, height) in SIDES.items()
}  # fmt: skip


def request(technique="texture_optimization", layers=(), **fields):
    texture = {"technique": technique, "exemplar": upload(0), **fields}
    output = {"layers": list(layers), "format": "exr"}
    return TextureRequest.model_validate({"texture": texture, "output": output})


def further(index, **maps):
    return {"exemplar": upload(index), **maps}


def test_they_lie_apart():
    sizes = list(SIDES.values())

    between = gap(sizes)

    assert between >= 300 / 4
    assert corners(sizes) == [0, 300 + between, 400 + 2 * between]
    assert whole(sizes) == (464 + 2 * between, 260)
    assert whole(sizes[:1]) == sizes[0]


@pytest.mark.parametrize("technique", ["image_quilting", "texture_optimization", "wei_levoy"])
def test_they_cost_what_one_of_the_size_of_all_costs(technique):
    width, height = whole(list(SIDES.values()))

    several = request(technique, more_exemplars=[further(1), further(2)])
    one = request(technique, exemplar_size=[width, height])

    # Laying them beside each other costs a little
    assert estimate(several, FACTS).seconds == pytest.approx(estimate(one, FACTS).seconds, rel=0.02)
    assert estimate(several, FACTS).bytes > estimate(request(technique), FACTS).bytes


def test_their_own_sizes_are_heeded():
    small = [{**further(index), "exemplar_size": [16, 16]} for index in (1, 2)]
    large = [{**further(index), "exemplar_size": [2000, 2000]} for index in (1, 2)]

    seconds = [
        estimate(request("image_quilting", more_exemplars=each), FACTS).seconds
        for each in (small, large)
    ]

    assert seconds[1] > 10 * seconds[0]


def test_each_has_the_maps_of_the_first():
    found = obstacles(
        request(
            normal=upload(1),
            more_exemplars=[
                further(1, normal=upload(2)),
                further(2),
                further(1, normal=upload(2), height=upload(2)),
                further(2, normal=upload(2), exemplar_guide=upload(1)),
            ],
        )
    )

    assert {obstacle.code for obstacle in found} == {"exemplar_maps_differ"}
    assert [obstacle.pointer for obstacle in found] == [
        "/texture/more_exemplars/1/normal",
        "/texture/more_exemplars/2/height",
        "/texture/more_exemplars/3/exemplar_guide",
    ]


def test_the_layer_exemplar_needs_several():
    layers = ["source", "exemplar"]

    one = obstacles(request(layers=layers))
    two = obstacles(request(layers=layers, more_exemplars=[further(1)]))

    assert [(each.code, each.pointer) for each in one] == [("layer_unknown", "/output/layers/1")]
    assert two == []


def test_their_pictures_are_read_as_their_slots_say_and_told_to_be_missing():
    maps = {"normal": upload(1), "exemplar_mask": upload(2)}
    asked = request(normal=upload(2), more_exemplars=[further(1, **maps)])

    item = normalise(asked, "exr", FACTS).texture.more_exemplars[0]

    assert (item.exemplar.encoding, item.normal.encoding) == ("srgb", "linear")
    assert item.exemplar_mask.encoding == "linear"
    pointers = [pointer for pointer, _ in assets_in(asked)]
    assert "/texture/more_exemplars/0/exemplar_mask/asset" in pointers
