import pytest

from api_schemas.estimate import estimate
from api_schemas.requests import RenderRequest
from service.settings import Settings
from tests.examples import examples

WALL = {"mesh": {"type": "plane", "width": 100, "height": 100}, "surface": {"technique": "phong"}}
SUN = {"type": "directional", "direction": [1, 0, -2]}
LAMP = {"type": "point", "position": [0, 0, 6]}


def cost(light, **shadow):
    """Of a wall that fills 512 x 512."""
    return many([light | {"shadow": shadow}])


def many(lights):
    scene = {
        "camera": {"type": "perspective", "pose": {"eye": [0, 0, 5]}},
        "lights": lights,
        "nodes": [WALL],
    }
    return estimate(RenderRequest.model_validate({"scene": scene, "output": {}}), {})


@pytest.mark.parametrize(
    ("light", "shadow", "measured"),
    [
        (SUN, {"radius": 1}, 0.02),
        (SUN, {"radius": 4}, 0.17),
        (SUN, {"radius": 8}, 0.48),
        (SUN, {"resolution": 4096}, 0.31),
        (LAMP, {"resolution": 2048}, 0.72),
    ],
)
def test_shadows_take_their_time(light, shadow, measured):
    """Measured with one sample a pixel, in seconds more than without shadows."""
    plain = RenderRequest.model_validate(
        {"scene": {"lights": [light], "nodes": []}, "output": {"supersampling": 1}}
    )
    scene = {
        "camera": {"type": "perspective", "pose": {"eye": [0, 0, 5]}},
        "lights": [light],
        "nodes": [WALL],
    }
    shaded = {**scene, "lights": [light | {"shadow": shadow}]}
    without, more = (
        estimate(plain.model_copy(update={"scene": type(plain.scene).model_validate(body)}), {})
        for body in (scene, shaded)
    )

    assert measured / 2.5 < more.seconds - without.seconds < 2.5 * measured + 0.05


def test_maps_are_held_in_one_array_as_large_as_the_largest():
    plain, small = many([]).bytes, cost(LAMP, resolution=64).bytes
    both = many([LAMP | {"shadow": {"resolution": 64}}, SUN | {"shadow": {"resolution": 2048}}])

    assert small - plain == 6 * 64**2 * 4
    assert both.bytes - plain == 7 * 2048**2 * 4


def test_shadows_beyond_every_measure_are_over_the_budget():
    limits = Settings()
    crowd = many([LAMP | {"shadow": {"resolution": 4096}}] * 32)

    assert crowd.bytes > limits.cost_limit_bytes


def test_every_light_asks_every_picture():
    def seconds(count):
        picture = {"technique": "constant", "value": [1, 1, 1]}
        return many([SUN | {"cookie": {"texture": picture}}] * count).seconds

    plain = [many([SUN] * count).seconds for count in (4, 8)]
    # One picture and one program more; then 1e6 samples of 20 ns for each light.
    assert seconds(8) - plain[1] - (seconds(4) - plain[0]) == pytest.approx(4 * 2e-8 * 2**20)


def test_every_frame_of_a_turn_is_drawn():
    def turning(**turntable):
        scene = {"lights": [SUN | {"shadow": {}}], "nodes": [WALL]}
        output = {"size": [512, 512], "turntable": turntable}
        return estimate(RenderRequest.model_validate({"scene": scene, "output": output}), {})

    one, few, many_ = turning(frame=3), turning(frames=8), turning(frames=32)

    assert 24 * one.seconds * 0.8 < many_.seconds - few.seconds < 24 * one.seconds
    assert many_.bytes < 2 * few.bytes  # a row of frames is held, not all
    layers = turning(frames=32, arrangement="layers")
    assert layers.bytes > 32 * 512 * 512 * 48


@pytest.mark.parametrize(
    ("steps", "light_steps", "measured"), [(64, 0, 0.31), (16, 8, 0.22), (64, 8, 1.05)]
)
def test_each_step_of_a_ray_through_a_cloud_takes_its_time(steps, light_steps, measured):
    """Measured as processor time on the example, more than one step without a light takes."""

    def seconds(**fields):
        body = examples()["volume"][1]
        body["scene"]["nodes"][0]["surface"] |= fields
        return estimate(RenderRequest.model_validate(body), {}).seconds

    more = seconds(steps=steps, light_steps=light_steps) - seconds(steps=1, light_steps=0)

    # The ball round a flat box covers some three times as much as the box
    assert measured / 2 < more < 6 * measured
