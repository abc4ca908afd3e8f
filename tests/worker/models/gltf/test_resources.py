"""Buffers and pictures: inside the document or in the set, and never from anywhere else."""

import hashlib
import json
from collections.abc import Iterator
from typing import Any

import pytest

from tests.worker.models.gltf.building import Builder, data_uri, glb, png, shown
from worker.errors import AssetMissingError, UnusableAssetError, WorkerError
from worker.models.gltf.outline import outline
from worker.models.gltf.reader import read
from worker.models.model import Model

JPEG = bytes.fromhex("ffd8ffe000104a46494600010100000100010000ffc0000b08000200030101110000ffd9")


class Watched(dict[str, bytes]):
    """A set of files that notes what is asked for."""

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self.asked: set[str] = set()

    def __getitem__(self, name: str) -> bytes:
        self.asked.add(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        self.asked.add(str(name))
        return super().__contains__(name)


@pytest.fixture(autouse=True)
def no_files(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Neither files nor sockets are opened."""

    def fail(*args: object, **_: object) -> None:
        raise AssertionError(f"opened {args}")

    with monkeypatch.context() as patch:
        patch.setattr("builtins.open", fail)
        patch.setattr("io.open", fail)
        patch.setattr("os.open", fail)
        patch.setattr("socket.socket.connect", fail)
        yield


def with_uri(uri: Any, kind: str = "buffers") -> bytes:
    item = {"uri": uri, "byteLength": 4} if kind == "buffers" else {"uri": uri}
    return json.dumps({"asset": {"version": "2.0"}, kind: [item]}).encode()


@pytest.mark.parametrize("kind", ["buffers", "images"])
@pytest.mark.parametrize(
    ("uri", "code"),
    [
        ("http://169.254.169.254/latest", "asset_unsupported"),
        ("https://example.org/a.bin", "asset_unsupported"),
        ("file:///etc/passwd", "asset_unsupported"),
        ("FILE:/etc/passwd", "asset_unsupported"),
        ("ftp:x", "asset_unsupported"),
        ("C:/windows/win.ini", "asset_unsupported"),
        ("jar:file:x!/y", "asset_unsupported"),
        ("/etc/passwd", "asset_unusable"),
        ("//host/share", "asset_unusable"),
        ("\\\\host\\share", "asset_unusable"),
        ("..\\secret", "asset_unusable"),
        ("../../../etc/passwd", "asset_unusable"),
        ("a/../../etc/passwd", "asset_unusable"),
        ("./a.bin", "asset_unusable"),
        ("..", "asset_unusable"),
        ("a//b", "asset_unusable"),
        ("%2e%2e/etc/passwd", "asset_unusable"),
        ("..%2fetc%2fpasswd", "asset_unusable"),
        ("%2fetc%2fpasswd", "asset_unusable"),
        ("%252e%252e%252fetc", "asset_unusable"),
        ("file%3A///etc/passwd", "asset_unusable"),
        ("a%00.bin", "asset_unusable"),
        ("a\u0000.bin", "asset_unusable"),
        ("a\n.bin", "asset_unusable"),
        ("a.bin?x=1", "asset_unusable"),
        ("a.bin#x", "asset_unusable"),
        ("a%zz", "asset_unusable"),
        ("a%ff", "asset_unusable"),
        ("", "asset_unusable"),
        (":", "asset_unusable"),
        ("x" * 257, "asset_unusable"),
        ("data:", "asset_unusable"),
        ("data:application/octet-stream;base64", "asset_unusable"),
        ("data:application/octet-stream,AAAA", "asset_unusable"),
        ("data:application/octet-stream;base64,A", "asset_unusable"),
        ("data:application/octet-stream;base64,AAAA=AAA", "asset_unusable"),
        ("data:application/octet-stream;base64,AA AA", "asset_unusable"),
        ("data:application/octet-stream;base64,\u00e4AAA", "asset_unusable"),
        ("data:x y;base64,AAAA", "asset_unusable"),
    ],
)
def test_uris_that_lead_outside_or_nowhere_are_refused(kind: str, uri: str, code: str) -> None:
    files = Watched({"passwd": b"root", "etc/passwd": b"root", "secret": b"root"})
    with pytest.raises(UnusableAssetError) as caught:
        read(with_uri(uri, kind), files)

    assert caught.value.code == code
    assert caught.value.message.startswith(f"/{kind}/0")
    assert "passwd" not in caught.value.message
    assert files.asked == set()


@pytest.mark.parametrize("text", ["AA AAA==", "AAAA=AAA", "AAAAA", "AAA-AAAA", "AAAA\n"])
def test_base64_is_read_strictly(text: str) -> None:
    with pytest.raises(UnusableAssetError, match="not valid base64"):
        read(with_uri(f"data:;base64,{text}"), {})


def test_base64_may_be_percent_encoded() -> None:
    assert read(with_uri("data:;base64,%2B%2F%2B%2FAA%3D%3D"), {}).warnings == ()


@pytest.mark.parametrize("uri", [7, None, ["a"], {"a": 1}, True])
def test_a_uri_is_text(uri: Any) -> None:
    with pytest.raises(UnusableAssetError, match=r"^/buffers/0"):
        read(with_uri(uri), {})


@pytest.mark.parametrize(
    ("uri", "name"),
    [
        ("shape.bin", "shape.bin"),
        ("my%20shape.bin", "my shape.bin"),
        ("textures/shape.bin", "textures/shape.bin"),
        ("gr%C3%BCn.bin", "grün.bin"),
        ("grün.bin", "grün.bin"),
        ("..shape.bin", "..shape.bin"),
    ],
)
def test_names_are_looked_up_as_they_decode_and_nothing_else_is(uri: str, name: str) -> None:
    builder = Builder()
    builder.mesh()
    builder.json |= shown(0)
    text, content = builder.separate(uri)
    files = Watched({name: content, "other": b""})

    assert len(read(text, files).parts) == 1
    assert files.asked == {name}
    assert outline(text).files == (name,)


def test_a_file_that_is_not_in_the_set_is_named() -> None:
    with pytest.raises(AssetMissingError) as caught:
        read(with_uri("deep/<i>box</i>.bin"), {"box.bin": b"1234"})

    assert caught.value.code == "asset_file_missing"
    assert caught.value.message == "/buffers/0/uri: the file deep/?i?box?/i?.bin is not in the set"


def test_the_binary_chunk_is_the_first_buffer_only() -> None:
    builder = Builder()
    builder.mesh()
    builder.json |= shown(0)
    builder.json["bufferViews"][0]["buffer"] = 1
    builder.json["buffers"] = [{"byteLength": 36}, {"byteLength": 36}]

    with pytest.raises(UnusableAssetError, match=r"^/buffers/1: the buffer has no data"):
        read(builder.glb(), {})


def pictured(content: bytes, mime_type: str | None = None, **texture: Any) -> Model:
    builder = Builder(
        materials=[{"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}],
        textures=[{"source": 0, **texture}],
    )
    if texture.pop("source", 0) is None:
        builder.json["textures"] = [{}]
    image = {"bufferView": builder.view(content), "mimeType": mime_type or "image/png"}
    builder.add("images", image)
    return read(builder.glb(), {})


def test_a_picture_may_lie_in_a_view_in_a_data_uri_or_beside_and_is_one_picture() -> None:
    content = png()
    builder = Builder()
    builder.add("images", {"bufferView": builder.view(content), "mimeType": "image/png"})
    builder.add("images", {"uri": data_uri(content, "image/png")})
    builder.add("images", {"uri": "white.png"})
    builder.view(b"something else")
    builder.json["textures"] = [{"source": n} for n in range(3)]
    builder.json["materials"] = [
        {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": n}} for n in range(3)
    ]
    model = read(builder.glb(), {"white.png": content})

    digest = hashlib.sha256(content).hexdigest()
    emissions: list[Any] = [getattr(s.surface, "emission") for s in model.surfaces]  # noqa: B009
    assert model.pictures == {digest: content}
    assert [emission.texture.asset for emission in emissions] == [digest] * 3


def test_a_picture_in_a_view_says_what_it_is() -> None:
    builder = Builder()
    builder.add("images", {"bufferView": builder.view(png())})

    with pytest.raises(UnusableAssetError, match="needs a mimeType"):
        read(builder.glb(), {})


def test_a_jpeg_is_a_picture_without_alpha() -> None:
    assert list(pictured(JPEG, "image/jpeg").pictures.values()) == [JPEG]


@pytest.mark.parametrize(
    ("content", "kind"),
    [
        (b"RIFF\x10\0\0\0WEBPVP8 ", "WebP"),
        (b"\xabKTX 20\xbb\r\n\x1a\n", "KTX"),
        (b"DDS |", "DDS"),
        (b"GIF89a", "GIF"),
        (b"something", "unknown"),
    ],
)
def test_pictures_of_other_kinds_are_named_and_left_out(content: bytes, kind: str) -> None:
    model = pictured(content)
    surface: Any = model.surfaces[0].surface

    assert model.warnings == (f"/images/0: a picture of kind {kind} is not drawn",)
    assert surface.emission == [1, 1, 1]
    assert model.pictures == {}


def test_a_texture_without_a_picture_is_left_out_and_told() -> None:
    builder = Builder(
        materials=[{"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}], textures=[{}]
    )
    model = read(builder.gltf(), {})

    assert "without a picture" in model.warnings[0]


@pytest.mark.parametrize(
    "content",
    [
        png()[:-1],
        png()[:-12],
        png()[:20],
        png()[:8],
        png().replace(b"IHDR\0\0\0\1", b"IHDR\0\0\0\0"),
        JPEG[:12],
        JPEG.replace(b"\0\2\0\3\1", b"\0\2\0\0\1"),
        JPEG[:20] + b"\0" + JPEG[20:],
        png().replace(b"\0\0\0\0IEND", b"\0\0\1\0IEND"),
    ],
)
def test_pictures_that_end_early_or_have_no_size_are_refused(content: bytes) -> None:
    media_type = "image/png" if content.startswith(b"\x89") else "image/jpeg"
    with pytest.raises(UnusableAssetError, match=r"^/images/0: the (PNG|JPEG)"):
        pictured(content, media_type)


def test_a_picture_that_is_called_another_kind_is_refused() -> None:
    with pytest.raises(UnusableAssetError, match="image/png and is called image/jpeg"):
        pictured(png(), "image/jpeg")
    with pytest.raises(UnusableAssetError, match="data URI says otherwise"):
        read(with_uri(data_uri(png(), "image/jpeg"), "images"), {})


def test_equal_sources_are_hashed_once_and_many_bytes_are_too_large(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("worker.models.gltf.resources.PICTURE_BYTES_MAX", 3 * len(png()))
    builder = Builder()
    view = builder.view(png())
    for _ in range(100):
        builder.add("images", {"bufferView": view, "mimeType": "image/png"})
    assert len(read(builder.glb(), {}).pictures) == 1

    for _ in range(3):
        builder.add("images", {"bufferView": builder.view(png()), "mimeType": "image/png"})
    with pytest.raises(WorkerError) as caught:
        read(builder.glb(), {})
    assert caught.value.code == "asset_too_large"


def test_a_glb_may_have_files_beside_it() -> None:
    text, _ = Builder(images=[{"uri": "white.png"}]).separate()

    assert read(glb(text), {"white.png": png()}).warnings == ()
