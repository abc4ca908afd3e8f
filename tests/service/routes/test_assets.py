import hashlib
import json
import os

import pytest

from service.routes import assets
from service.tenants import tenant
from tests.model_facts import model_facts
from worker.images.file_kinds import FILE_KINDS


def picture():
    """A new upload that the measurer takes."""
    return b"\x89PNG" + os.urandom(8)


def toy(facts):
    """A new upload of which the measurer tells these facts."""
    return b"toy " + json.dumps({**facts, "sha256": os.urandom(9).hex()}).encode()


@pytest.fixture
def asset(client):
    content = picture()
    return content, client.post("/v1/assets", content=content).headers["location"]


def image_request(sha256):
    return {"texture": {"technique": "image", "asset": sha256}, "output": {"size": [16, 16]}}


def test_the_published_media_types_are_those_of_the_kinds_that_are_read():
    published = [name for name in assets.SUFFIXES if name.startswith("image/")]

    assert published == [kind.media_type for kind in FILE_KINDS]


@pytest.mark.parametrize(
    "media_type",
    [
        "image/png",
        "image/jpeg",
        "model/obj",
        "IMAGE/PNG; q=1",
        "application/octet-stream",
        "application/x-www-form-urlencoded",
        None,
    ],
)
def test_a_bare_upload_is_named_by_its_hash(client, media_type):
    content = picture()
    headers = {"Content-Type": media_type} if media_type else {}
    response = client.post("/v1/assets", content=content, headers=headers)
    sha256 = hashlib.sha256(content).hexdigest()

    assert response.status_code == 201
    assert response.headers["location"] == f"/v1/assets/{sha256}"
    assert response.json() == {
        "sha256": sha256,
        "kind": "image",
        "media_type": "image/png",
        "format": "png",
        "bytes": len(content),
        "width": 1,
        "height": 1,
        "channels": 1,
        "bits": 8,
        "float": False,
        "has_alpha": False,
    }


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


def test_a_model_is_measured_like_a_picture(client):
    told = model_facts(materials=["red", ""], files=["a.bin"], bounds_min=[-1, 0, -2.5])
    content = toy(told)
    created = client.post("/v1/assets", content=content)
    facts = client.get(created.headers["location"], headers={"Accept": "application/json"})

    assert created.status_code == 201
    assert facts.json() == created.json()
    sha256 = hashlib.sha256(content).hexdigest()
    assert created.json() == {**told, "sha256": sha256, "bytes": len(content)}


def declared(client, content, media_type, *, form=False):
    if form:
        return client.post("/v1/assets", files={"file": ("x", content, media_type)})
    return client.post("/v1/assets", content=content, headers={"Content-Type": media_type})


@pytest.mark.parametrize("form", [False, True])
def test_a_buffer_has_to_be_called_one(client, form):
    content = os.urandom(12)
    before = declared(client, content, "application/octet-stream", form=form)
    after = declared(client, content, "application/gltf-buffer", form=form)

    assert (before.status_code, before.json()["code"]) == (409, "asset_unsupported")
    assert (after.status_code, after.json()["kind"]) == (201, "buffer")


def test_what_was_called_a_buffer_becomes_what_its_content_tells_and_stays_it(client):
    content = picture()
    kinds = [
        declared(client, content, media_type).json()["kind"]
        for media_type in ("application/gltf-buffer", "image/png", "application/gltf-buffer")
    ]
    junk = os.urandom(12)
    answers = [
        declared(client, junk, media_type)
        for media_type in ("application/gltf-buffer", "image/png")
    ]

    assert kinds == ["buffer", "image", "image"]
    assert [answer.status_code for answer in answers] == [201, 200]
    assert answers[0].json() == answers[1].json()


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


def test_a_browsers_form_is_the_same_upload(client):
    content = picture()
    response = client.post("/v1/assets", files={"file": ("../../etc/passwd", content, "text/html")})

    assert response.status_code == 201
    assert response.json()["sha256"] == hashlib.sha256(content).hexdigest()


def test_a_chunked_upload_is_the_same_upload(client):
    content = picture()
    response = client.post("/v1/assets", content=(content[n : n + 3] for n in range(0, 12, 3)))

    assert response.json()["sha256"] == hashlib.sha256(content).hexdigest()


@pytest.mark.parametrize(
    "form",
    [
        {"files": {"picture": picture()}},
        {"files": [("file", picture()), ("file", picture())]},
        {"files": {"file": picture()}, "data": {"name": "x"}},
        {"files": {"x": (None, "text")}},
        {"files": {"file": (None, "text")}},
    ],
)
def test_a_form_with_anything_but_one_file_is_refused(client, form):
    response = client.post("/v1/assets", **form)

    assert response.status_code in (400, 422)
    assert response.json()["code"] in ("multipart_malformed", "request_invalid")


@pytest.mark.parametrize("boundary", ["", "; boundary=", "; boundary=x", "; boundary=" + "y" * 999])
def test_a_broken_form_is_refused(client, boundary):
    headers = {"Content-Type": f"multipart/form-data{boundary}"}

    for content in (b"", b"x", b"--x\r\n\r\n", b"--x\r\nContent-Disposition: form-data\r\n\r\na"):
        response = client.post("/v1/assets", content=content, headers=headers)
        assert response.status_code in (400, 422), content


def test_what_is_not_a_picture_is_refused_and_the_next_one_is_taken(client, engine):
    for content in (b"", b"GIF89a", b"<svg/>", b"PK\x03\x04"):
        response = client.post("/v1/assets", content=content)
        assert (response.status_code, response.json()["code"]) == (409, "asset_unsupported")

    assert client.post("/v1/assets", content=picture()).status_code == 201
    assert not list(engine.assets.folder.glob("*.part"))


@pytest.mark.parametrize(
    "media_type",
    ["application/json", "text/plain", "video/mp4", "application/zip", "application/gltf+buffer"],
)
def test_a_media_type_that_is_not_taken_is_415(client, media_type):
    headers = {"Content-Type": media_type}

    assert client.post("/v1/assets", content=picture(), headers=headers).status_code == 415


@pytest.mark.parametrize("kind", ["bare", "chunked", "form"])
def test_an_upload_over_the_limit_is_413_and_leaves_nothing(client, settings, engine, kind):
    content = picture() + bytes(settings.upload_limit_bytes)
    if kind == "form":
        response = client.post("/v1/assets", files={"file": content})
    elif kind == "chunked":
        response = client.post("/v1/assets", content=iter([content[:9], content[9:]]))
    else:
        response = client.post("/v1/assets", content=content)

    assert (response.status_code, response.json()["code"]) == (413, "body_too_large")
    assert not list(engine.assets.folder.glob("*.part"))


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


@pytest.mark.parametrize("size", [100, 1 << 19])
def test_an_upload_that_the_disk_has_no_room_for_is_507(
    client, engine, monkeypatch, tmp_path, size
):
    full = tmp_path / "full"
    full.symlink_to("/dev/full")
    monkeypatch.setattr(engine.assets, "new_upload", lambda: full)

    response = client.post("/v1/assets", content=b"x" * size)

    assert (response.status_code, response.json()["code"]) == (507, "storage_full")
    assert "retry-after" in response.headers
