import hashlib

import pytest

from worker.jobs import files
from worker.jobs.assets import Assets
from worker.jobs.claims import Claims
from worker.jobs.errors import StorageFullError
from worker.jobs.intake import Request

CONTENT = b"picture"
SHA256 = hashlib.sha256(CONTENT).hexdigest()


@pytest.fixture
def assets(database, tmp_path):
    return Assets(tmp_path / "assets", database)


@pytest.fixture
def put(assets):
    def put(tenant):
        upload = assets.new_upload()
        upload.write_bytes(CONTENT)
        return assets.put(tenant, upload, SHA256, {"kind": "image", "width": 2})

    return put


def files_in(folder):
    return [path for path in folder.rglob("*") if path.is_file()]


def test_an_asset_lies_under_its_hash_with_its_facts(assets, put, tmp_path):
    asset = put("a")
    assert (asset.sha256, asset.bytes, asset.facts["width"]) == (SHA256, 7, 2)
    assert assets.get("a", SHA256) == asset
    assert assets.path("a", SHA256) == tmp_path / "assets" / SHA256[:2] / SHA256
    assert assets.path("a", SHA256).read_bytes() == CONTENT


def test_the_same_content_is_stored_once_and_owned_by_each(assets, put, tmp_path):
    first = put("a")
    assert put("a") == first
    put("b")
    assert len(files_in(tmp_path / "assets")) == 1
    assert assets.delete("a", SHA256)
    assert assets.get("a", SHA256) is None
    assert assets.path("b", SHA256).read_bytes() == CONTENT


def test_what_is_told_anew_of_an_asset_its_owner_alone_hears(assets, put):
    put("a")
    put("b")
    assets.tell("a", SHA256, {"kind": "model"})
    assert assets.get("a", SHA256).facts == {"kind": "model"}
    assert assets.get("b", SHA256).facts["kind"] == "image"
    assert put("a").facts == {"kind": "model"}


def test_nobody_sees_or_deletes_what_others_own(assets, put):
    put("a")
    assert assets.get("b", SHA256) is None
    assert assets.path("b", SHA256) is None
    assert not assets.delete("b", SHA256)
    assert assets.get("a", SHA256) is not None


def test_the_last_owner_takes_the_file_along(assets, put, tmp_path):
    put("a")
    assert assets.delete("a", SHA256)
    assert not assets.delete("a", SHA256)
    assert files_in(tmp_path / "assets") == []


def test_a_file_stays_while_work_may_read_it(assets, put, database, make_requests, tmp_path):
    requests = make_requests()
    claims = Claims(database)
    put("a")
    body = {"texture": {"inputs": [{"asset": SHA256}]}}
    requests.submit(Request("a", "texture", body, "d", "interactive", 60.0))
    assets.delete("a", SHA256)
    assert assets.get("a", SHA256) is None
    claim = claims.claim()
    assets.drop_unwanted([SHA256])
    assert len(files_in(tmp_path / "assets")) == 1
    claims.put_back(claim)
    claims.fail(claims.claim(), {"code": "c", "message": "m", "pointer": None})
    assets.drop_unwanted([SHA256])
    assert files_in(tmp_path / "assets") == []


def test_half_uploads_and_unowned_files_are_swept(assets, put, tmp_path):
    put("a")
    assets.new_upload().write_bytes(b"half")
    unowned = tmp_path / "assets" / "00" / ("0" * 64)
    unowned.parent.mkdir()
    unowned.write_bytes(b"")
    assets.sweep()
    assert files_in(tmp_path / "assets") == [assets.path("a", SHA256)]


def test_a_vanished_file_is_no_asset_until_it_is_put_again(assets, put):
    put("a")
    assets.path("a", SHA256).unlink()
    assert assets.get("a", SHA256) is None
    put("a")
    assert assets.path("a", SHA256).read_bytes() == CONTENT


def test_an_upload_that_does_not_fit_is_not_owned(assets, put, monkeypatch):
    def fail(descriptor):
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(files.os, "fsync", fail)
        with pytest.raises(StorageFullError):
            put("a")
    assert assets.get("a", SHA256) is None


def test_only_their_owner_may_enter_the_folders(assets, put, tmp_path):
    put("a")
    for folder in (tmp_path / "assets", tmp_path / "assets" / SHA256[:2]):
        assert folder.stat().st_mode & 0o777 == 0o700
