"""A disk without a free byte: everything that would write says so, and everything else works."""

import resource

import pytest

ASSET = b"\x89PNG but not really"
BODY = {"texture": {"technique": "perlin", "seed": 1}, "output": {"size": [8, 8]}}


@pytest.fixture
def full_disk():
    """No file of this process can grow: a limit that needs no rights, and works like a quota."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, hard))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


@pytest.fixture
def client(make_client):
    return make_client()


@pytest.fixture
def prepared(client):
    """An upload, a finished job and one that runs."""
    location = client.post("/v1/assets", content=ASSET).headers["location"]
    done = client.post("/v1/textures", json=BODY, headers={"Prefer": "wait=30"}).json()
    long = {**BODY, "texture": {"technique": "perlin", "seed": 1002}}
    running = client.post("/v1/textures", json=long).json()
    return location, done, running


@pytest.mark.parametrize("what", ["submit", "batch", "upload", "cancel", "delete"])
def test_what_has_to_be_written_is_507_and_changes_nothing(client, prepared, full_disk, what):
    location, _, running = prepared
    new = {**BODY, "texture": {"technique": "perlin", "seed": 2}}
    answer = {
        "submit": lambda: client.post("/v1/textures", json=new),
        "batch": lambda: client.post("/v1/batches", json={"items": [new, new]}),
        "upload": lambda: client.post("/v1/assets", content=ASSET + b"2"),
        "cancel": lambda: client.delete(running["links"]["cancel"]),
        "delete": lambda: client.delete(location),
    }[what]()

    assert (answer.status_code, answer.json()["code"]) == (507, "storage_full")
    assert int(answer.headers["retry-after"]) >= 1
    assert client.head(location).status_code == 200
    assert client.get(running["links"]["self"]).json()["state"] in ("queued", "running")
    assert len(client.get("/v1/jobs").json()["jobs"]) == 2
    assert client.get("/v1/batches").json()["batches"] == []


def test_what_is_there_can_be_had(client, prepared, full_disk):
    location, done, _ = prepared
    assert client.get(done["links"]["result"]).status_code == 200
    assert client.get(location).content == ASSET
    assert client.get("/v1/status").status_code == 200
    assert client.get("/readyz").status_code == 200


def test_everything_works_again_when_there_is_room(client, prepared):
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, hard))
    client.delete(prepared[0])
    resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))

    assert client.delete(prepared[0]).status_code == 204
    answer = client.post("/v1/textures", json={**BODY, "output": {"size": [7, 7]}})
    assert answer.status_code == 202
