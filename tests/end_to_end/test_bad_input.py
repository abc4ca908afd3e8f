"""What is damaged, huge or impossible gets its named answer; the next good request a picture."""

import json
import struct
import zlib

import pytest

from tests.examples import ASSETS, EXAMPLES

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

LABEL = next(path for path in ASSETS if path.name == "label.png").read_bytes()
CAN = json.loads((EXAMPLES / "renders/soda_can.json").read_text())
GOOD = {"texture": {"technique": "checkerboard"}, "output": {"size": [16, 16]}}


@pytest.fixture
def client(service):
    with service.client() as client:
        yield client
        answer = client.post("/v1/textures", json=GOOD, headers={"Accept": "image/png"})
        assert answer.content.startswith(b"\x89PNG"), "the next good request was not served"


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(width, height, data):
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(data))
        + chunk(b"IEND", b"")
    )


BOMB = png(16384, 16384, bytes(50_000_000))


@pytest.mark.parametrize(
    ("upload", "code"),
    [
        (LABEL[: len(LABEL) // 2], "asset_unusable"),
        (LABEL[:5000] + bytes(400) + LABEL[5400:], "asset_unusable"),
        (BOMB, "asset_too_large"),
        (b"GIF89a" + bytes(100), "asset_unsupported"),
        (b"<svg xmlns='http://www.w3.org/2000/svg'/>", "asset_unsupported"),
        (b"PK\x03\x04" + bytes(100), "asset_unsupported"),
        (bytes(100), "asset_unsupported"),
    ],
    ids=["truncated", "damaged", "bomb", "gif", "svg", "zip", "zeros"],
)
def test_a_picture_that_is_none_is_refused_by_name(client, upload, code):
    answer = client.post("/v1/assets", content=upload, headers={"Content-Type": "image/png"})

    assert 400 <= answer.status_code < 500
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["code"] == code


def can(change):
    body = json.loads(json.dumps(CAN))
    change(body)
    return body


def set_at(*path):
    *folders, name, value = path

    def change(body):
        for folder in folders:
            body = body[folder]
        body[name] = value

    return change


NODE = ("scene", "nodes", 0)


@pytest.mark.parametrize(
    ("change", "code", "pointer"),
    [
        (
            set_at("scene", "camera", "pose", {"eye": [0, 9, 0]}),
            "camera_degenerate",
            "/scene/camera/pose/up",
        ),
        (
            set_at(*NODE, "transform", {"scale": [1, 0, 1]}),
            "transform_singular",
            "/scene/nodes/0/transform",
        ),
        (
            set_at(
                *NODE,
                "surface",
                {
                    "technique": "unlit",
                    "color": {"texture": {"technique": "image", "asset": "f" * 64}},
                },
            ),
            "asset_missing",
            "/scene/nodes/0/surface/color/texture/asset",
        ),
        (set_at("output", {"size": [16384, 16384], "supersampling": 8}), "over_budget", ""),
    ],
    ids=["camera", "transform", "asset", "budget"],
)
def test_what_cannot_be_done_is_told_before_work_starts(client, change, code, pointer):
    answer = client.post("/v1/renders", json=can(change))
    problem = answer.json()

    assert answer.status_code == 409
    assert problem["code"] == code
    assert problem["pointer"] == pointer


@pytest.mark.parametrize(
    ("change", "pointer"),
    [
        (set_at(*NODE, "mesh", "radius", 0), "/scene/nodes/0/mesh/radius"),
        (set_at(*NODE, "mesh", "segments", 10**7), "/scene/nodes/0/mesh/segments"),
        (set_at("output", "size", [0, 16]), "/output/size/0"),
        (set_at(*NODE, "surface", "exponent", -1), "/scene/nodes/0/surface/exponent"),
        (set_at(*NODE, "surface", "shine", 1), "/scene/nodes/0/surface/shine"),
    ],
)
def test_what_the_schema_refuses_is_told_with_its_place(client, change, pointer):
    answer = client.post("/v1/renders", json=can(change))

    assert answer.status_code == 422
    assert [error["pointer"] for error in answer.json()["problems"]] == [pointer]


@pytest.mark.parametrize(
    ("texture", "code", "pointer"),
    [
        ({"technique": "turing", "time_step": 9.0}, "time_step_unstable", "/texture/time_step"),
        ({"technique": "schnakenberg", "a": 0.0, "b": 0.0}, "no_steady_state", "/texture"),
    ],
)
def test_a_reaction_that_cannot_run_is_refused_before_it_does(client, texture, code, pointer):
    answer = client.post("/v1/textures", json={"texture": texture})

    assert answer.status_code == 409
    assert (answer.json()["code"], answer.json()["pointer"]) == (code, pointer)


def test_a_reaction_that_runs_away_fails_by_name(client):
    # At rest it is 4 everywhere; what begins a billion times above has no end
    flood = {"technique": "constant", "value": [4e9, 4e9]}
    texture = {"technique": "turing", "size": [32, 32], "start": flood}

    answer = client.post("/v1/textures", json={"texture": texture}, headers={"Accept": "image/png"})

    assert answer.status_code == 409
    assert answer.json()["failure"]["code"] == "reaction_diverged"


NOISE = {"technique": "perlin", "frequency": 8}
ALL, NOTHING = ({"technique": "constant", "value": value} for value in ([1.0], [0.0]))


@pytest.mark.parametrize(
    "texture",
    [
        {"technique": "hole_filling", "hole": ALL},
        {"technique": "image_shuffling", "region": ALL, "shift": [3, 0]},
        {"technique": "texture_optimization", "size": [16, 16], "exemplar_mask": NOTHING},
    ],
    ids=["hole", "region", "mask"],
)
def test_an_exemplar_of_which_nothing_is_left_fails_by_name(client, texture):
    texture |= {"exemplar": NOISE, "exemplar_size": [24, 24]}
    body = {"texture": texture, "output": {"size": [24, 24]}}

    answer = client.post("/v1/textures", json=body, headers={"Accept": "image/png"})

    assert answer.status_code == 409
    assert answer.json()["failure"]["code"] == "exemplar_unusable"


@pytest.mark.parametrize(
    ("fields", "pointer"),
    [
        ({"shift": [2049, 0]}, "/texture/shift/0"),
        ({"shift": [0, 1.5]}, "/texture/shift/1"),
        ({"shift": [3, 0], "margin": -1}, "/texture/margin"),
        ({"shift": [3, 0], "exemplar_size": [0, 24]}, "/texture/exemplar_size/0"),
        ({"shift": [3, 0], "region": None}, "/texture/region"),
    ],
)
def test_a_part_that_cannot_be_moved_is_refused_with_its_place(client, fields, pointer):
    texture = {"technique": "image_shuffling", "exemplar": NOISE, "region": ALL, **fields}

    answer = client.post("/v1/textures", json={"texture": texture})

    assert answer.status_code == 422
    assert [error["pointer"] for error in answer.json()["problems"]] == [pointer]


@pytest.mark.parametrize(
    "texture",
    [
        {"technique": "image_shuffling", "region": ALL, "shift": [0, 0]},
        {"technique": "image_shuffling", "region": NOTHING, "shift": [900, 0]},
        {"technique": "hole_filling", "hole": NOTHING},
    ],
    ids=["not moved", "no region", "no hole"],
)
def test_what_changes_nothing_gives_the_picture_back(client, texture):
    texture |= {"exemplar": NOISE, "exemplar_size": [24, 24]}
    pictures = [
        client.post(
            "/v1/textures",
            json={"texture": each, "output": {"size": [24, 24]}},
            headers={"Accept": "image/png"},
        ).content
        for each in (texture, NOISE)
    ]

    assert pictures[0].startswith(b"\x89PNG")
    assert pictures[0] == pictures[1]
