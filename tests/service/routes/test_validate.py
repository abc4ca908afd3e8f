from tests.examples import examples

PERLIN = {"texture": {"technique": "perlin"}, "output": {"size": [16, 16]}}


def validate(client, body):
    return client.post("/v1/validate", json=body)


def test_a_possible_request_comes_back_with_nothing_left_to_guess(client):
    answer = validate(client, PERLIN).json()
    job = client.post("/v1/textures", json=PERLIN).json()

    assert answer["possible"]
    assert answer["problems"] == []
    assert answer["digest"] == job["digest"]
    assert answer["normalised"]["output"]["format"] == "png"
    assert answer["normalised"]["texture"]["frequency"] == 8
    assert 0 < answer["estimate"]["seconds"] < answer["limit"]["seconds"]
    assert validate(client, answer["normalised"]).json()["digest"] == job["digest"]


def test_validating_does_no_work(client):
    before = client.get("/v1/jobs").json()["jobs"]
    validate(client, PERLIN | {"output": {"size": [17, 16]}})
    after = client.get("/v1/jobs").json()["jobs"]

    assert [job["id"] for job in after] == [job["id"] for job in before]


def test_what_would_be_refused_with_409_is_an_answer_here(client):
    body = {
        "scene": {
            "camera": {
                "type": "perspective",
                "pose": {"eye": [0, 1, 0], "target": [0, 0, 0], "up": [0, 2, 0]},
            },
            "nodes": [
                {"transform": {"scale": [0, 1, 1]}, "mesh": {"type": "sphere"}},
                {
                    "surface": {
                        "technique": "unlit",
                        "color": {"texture": {"technique": "image", "asset": "0" * 64}},
                    }
                },
            ],
        },
        "output": {"size": [16384, 16384], "supersampling": 8},
    }
    answer = validate(client, body)
    refused = client.post("/v1/renders", json=body)

    assert answer.status_code == 200
    assert not answer.json()["possible"]
    assert answer.json()["digest"] is None
    assert [(item["code"], item["pointer"]) for item in answer.json()["problems"]] == [
        ("camera_degenerate", "/scene/camera/pose/up"),
        ("transform_singular", "/scene/nodes/0/transform"),
        ("asset_missing", "/scene/nodes/1/surface/color/texture/asset"),
        ("over_budget", ""),
    ]
    assert refused.status_code == 409
    assert refused.json()["code"] == "camera_degenerate"
    assert refused.json()["problems"] == answer.json()["problems"]
    assert refused.json()["estimate"] == answer.json()["estimate"]
    assert refused.json()["limit"] == answer.json()["limit"]


def test_the_scene_key_decides_which_kind_of_request_it_is(client):
    assert validate(client, {"scene": 1}).json()["problems"][0]["pointer"] == "/scene"
    assert validate(client, {}).json()["problems"][0]["pointer"] == "/texture"
    assert validate(client, []).status_code == 422
    assert validate(client, 3).status_code == 422


def test_every_example_fits_its_schema(client):
    for name, (kind, body) in examples().items():
        answer = validate(client, body)

        assert answer.status_code == 200, name
        assert answer.json()["kind"] == kind
        assert {item["code"] for item in answer.json()["problems"]} <= {"asset_missing"}, name


def test_many_layers_need_an_exr_whoever_chooses_the_format(client):
    body = {
        "scene": {"camera": {"type": "perspective", "pose": {"eye": [0, 0, 3]}}, "nodes": []},
        "output": {"size": [16, 16], "layers": ["depth", "normal"]},
    }

    def codes(accept):
        answer = client.post("/v1/validate", json=body, headers={"Accept": accept})
        return [item["code"] for item in answer.json()["problems"]]

    assert codes("application/json") == ["layers_need_exr"]
    refused = client.post("/v1/renders", json=body)
    assert (refused.status_code, refused.json()["pointer"]) == (409, "/output/layers")
    accepted = client.post("/v1/renders", json=body, headers={"Accept": "image/x-exr, */*;q=0.1"})
    assert accepted.status_code != 409
