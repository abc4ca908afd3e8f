import hashlib

import pytest

from service.routes import assets
from service.tenants import tenant
from tests.service.uploading import image_request, picture, toy
from worker.images.file_kinds import FILE_KINDS


@pytest.fixture
def asset(client):
    content = picture()
    return content, client.post("/v1/assets", content=content).headers["location"]


def test_the_published_media_types_are_those_of_the_kinds_that_are_read():
    published = [name for name in assets.SUFFIXES if name.startswith("image/")]

    assert published == [kind.media_type for kind in FILE_KINDS]


@pytest.mark.parametrize(
    ("media_type", "suffix"),
    [
        ("image/x-exr", "exr"),
        ("image/jpeg", "jpg"),
        ("image/tiff", "tif"),
        ("image/vnd.radiance", "hdr"),
        ("model/gltf-binary", "glb"),
        ("model/gltf+json", "gltf"),
        ("model/obj", "obj"),
        ("model/mtl", "mtl"),
        ("model/ply", "ply"),
        ("model/stl", "stl"),
        ("application/gltf-buffer", "bin"),
    ],
)
def test_an_upload_is_fetched_as_what_it_is_under_a_usual_name(client, media_type, suffix):
    told = {"kind": "buffer", "format": suffix, "media_type": media_type}
    content = toy(told)
    created = client.post("/v1/assets", content=content)
    fetched = client.get(created.headers["location"])

    assert created.json()["media_type"] == fetched.headers["content-type"] == media_type
    assert fetched.content == content
    assert fetched.headers["content-disposition"].endswith(f'.{suffix}"')


def test_facts_of_before_there_were_models_are_still_read(client, engine):
    content = picture()
    sha256 = hashlib.sha256(content).hexdigest()
    location = client.post("/v1/assets", content=content).headers["location"]
    engine.assets.tell(
        "local",
        sha256,
        {
            "sha256": sha256,
            "kind": "image",
            "media_type": "image/png",
            "format": "png",
            "bytes": 12,
            "width": 1,
            "height": 1,
            "channels": 1,
            "bits": 8,
            "float": False,
            "has_alpha": False,
        },
    )

    assert client.get(location).status_code == 200
    assert client.post("/v1/textures", json=image_request(sha256)).is_success


def test_a_second_upload_is_told_so(client, asset):
    content, location = asset
    again = client.post("/v1/assets", content=content)

    assert (again.status_code, again.headers["location"]) == (200, location)


def test_an_upload_is_served_as_it_was_and_runs_in_no_browser(client, asset):
    content, location = asset
    response = client.get(location)

    assert response.content == content
    assert response.headers["content-type"] == "image/png"
    assert response.headers["etag"] == f'"{hashlib.sha256(content).hexdigest()}"'
    assert response.headers["x-content-type-options"] == "nosniff"
    assert response.headers["content-disposition"].startswith("attachment")
    assert response.headers["content-security-policy"].startswith("sandbox")
    assert "immutable" in response.headers["cache-control"]


def test_head_tells_what_get_would(client, asset):
    head, get = (client.request(method, asset[1]) for method in ("HEAD", "GET"))

    assert (head.status_code, head.content) == (200, b"")
    of_the_request = {"x-request-id"}
    assert {*head.headers.items()} ^ {*get.headers.items()} <= {
        (name, answer.headers[name]) for name in of_the_request for answer in (head, get)
    }


def test_a_caller_that_has_the_facts_gets_304(client, asset):
    as_json = {"Accept": "application/json"}
    etag = client.get(asset[1], headers=as_json).headers["etag"]
    again = client.get(asset[1], headers=as_json | {"If-None-Match": etag})
    head = client.head(asset[1], headers=as_json)

    assert (again.status_code, again.content) == (304, b"")
    assert client.get(asset[1], headers={"If-None-Match": etag}).status_code == 200, "the file"
    assert head.headers["etag"] == etag


def test_json_gets_the_facts(client, asset):
    content, location = asset
    response = client.get(location, headers={"Accept": "application/json"})

    assert response.json()["bytes"] == len(content)
    assert client.get(location, headers={"Accept": "text/html"}).status_code == 406


def test_a_caller_that_has_it_gets_304_and_a_part_is_206(client, asset):
    content, location = asset
    etag = f'"{location.rpartition("/")[2]}"'

    assert client.get(location, headers={"If-None-Match": etag}).status_code == 304
    assert client.get(location, headers={"Range": "bytes=0-3"}).content == content[:4]


def test_a_deleted_upload_is_gone(client, asset):
    _, location = asset
    request = image_request(location.rpartition("/")[2])

    assert client.post("/v1/textures", json=request).is_success
    assert client.delete(location).status_code == 204
    assert client.delete(location).status_code == 404
    assert client.get(location).status_code == 404
    missing = client.post("/v1/textures", json=request)
    assert (missing.status_code, missing.json()["code"]) == (409, "asset_missing")
    assert missing.json()["pointer"] == "/texture/asset"


@pytest.mark.parametrize(
    "name", ["x", "0" * 64, "0" * 63, "A" * 64, "%00", "..%2f..%2fjobs.sqlite"]
)
def test_unknown_assets_are_404(client, name):
    for method in ("GET", "HEAD", "DELETE"):
        assert client.request(method, f"/v1/assets/{name}").status_code == 404


def test_nobody_sees_or_uses_another_tenants_uploads(app, client, asset):
    content, location = asset
    app.dependency_overrides[tenant] = lambda: "somebody else"
    try:
        for method in ("GET", "HEAD", "DELETE"):
            assert client.request(method, location).status_code == 404
        request = image_request(location.rpartition("/")[2])
        assert client.post("/v1/textures", json=request).status_code == 409
        assert client.post("/v1/assets", content=content).status_code == 201
    finally:
        del app.dependency_overrides[tenant]

    assert client.get(location).status_code == 200
