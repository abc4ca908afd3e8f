"""What POST /v1/assets takes, and what it makes of it."""

import hashlib
import os

import pytest

from tests.model_facts import model_facts
from tests.service.uploading import picture, toy


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
