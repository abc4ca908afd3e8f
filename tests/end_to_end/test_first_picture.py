"""From a request over HTTP to numbers in a file."""

import json

import numpy as np
import pytest

from tests.examples import EXAMPLES
from worker.images import image_io

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

GLOW = {
    "scene": {
        "camera": {"type": "orthographic", "height": 1.0, "pose": {"eye": [0, 0, 2]}},
        "lights": [],
        "nodes": [
            {"mesh": {"type": "plane"}, "surface": {"technique": "phong", "emission": [4.0, 1, 0]}}
        ],
    },
    "output": {"size": [32, 24], "format": "exr"},
}


def picture(service, path, body, route="/v1/renders", accept="image/x-exr"):
    with service.client() as client:
        answer = client.post(route, json=body, headers={"Accept": accept})
    assert answer.status_code == 200, answer.text
    path.write_bytes(answer.content)
    return image_io.read(path, "linear", "colour").pixels


@pytest.mark.parametrize("precision", ["half", "float"])
def test_an_emission_of_four_is_four_in_the_file(service, tmp_path, precision):
    body = {**GLOW, "output": {**GLOW["output"], "exr_type": precision}}

    pixels = picture(service, tmp_path / "glow.exr", body)

    assert pixels.shape == (24, 32, 4)
    np.testing.assert_array_equal(pixels, np.broadcast_to(np.float32([4, 1, 0, 1]), pixels.shape))


def test_the_soda_can_has_100_triangles(service):
    body = json.loads((EXAMPLES / "renders/soda_can.json").read_text())
    with service.client() as client:
        job = client.post("/v1/renders", json=body, headers={"Prefer": "wait=60"}).json()

    assert job["state"] == "succeeded"
    assert job["result"]["counts"]["triangles"] == 100


def test_a_render_request_with_a_ramp_over_noise_shows_colours_of_the_ramp_alone(service, tmp_path):
    black, red = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]
    ramp = {
        "technique": "ramp",
        "input": {"technique": "perlin", "frequency": 4, "seed": 5},
        "stops": [{"position": 0.4, "color": black}, {"position": 0.6, "color": red}],
    }
    body = json.loads(json.dumps(GLOW))
    body["scene"]["nodes"][0]["surface"] = {"technique": "unlit", "color": {"texture": ramp}}

    pixels = picture(service, tmp_path / "ramp.exr", body)

    assert np.ptp(pixels[..., 0]) > 0.5
    assert (pixels[..., 1:3] == 0).all()
    assert (pixels[..., 3] == 1).all()


def test_equal_work_is_done_once_and_answers_the_same_bytes(service):
    body = {"texture": {"technique": "perlin", "seed": 99}, "output": {"size": [40, 30]}}
    with service.client() as client:
        first = client.post("/v1/textures", json=body, headers={"Accept": "image/png"})
        again = client.post("/v1/textures", json=body)
        result = client.get(again.json()["links"]["result"])
        unchanged = client.get(
            again.json()["links"]["result"], headers={"If-None-Match": first.headers["etag"]}
        )

    assert again.status_code == 200
    assert result.content == first.content
    assert result.headers["etag"] == first.headers["etag"]
    assert unchanged.status_code == 304
