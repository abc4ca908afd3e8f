"""GLB and JSON: what is one, and what only claims to be."""

import struct

import pytest

from tests.worker.models.gltf.building import glb
from worker.errors import UnusableAssetError
from worker.models.gltf.container import open_container
from worker.models.gltf.json_text import parse

EMPTY = b'{"asset":{"version":"2.0"}}'


def refused(data: bytes) -> UnusableAssetError:
    with pytest.raises(UnusableAssetError) as caught:
        parse(open_container(data).text)
    return caught.value


def test_a_glb_is_its_json_and_its_bytes() -> None:
    container = open_container(glb(EMPTY, b"12345678"))

    assert parse(container.text) == {"asset": {"version": "2.0"}}
    assert container.binary == b"12345678"
    assert container.warnings == ()


def test_unknown_chunks_and_what_follows_the_end_are_told() -> None:
    whole = glb(EMPTY, b"1234")
    extra = struct.pack("<I4s", 4, b"XTRA") + b"abcd"
    longer = whole[:8] + struct.pack("<I", len(whole) + len(extra)) + whole[12:] + extra

    assert "unknown" in open_container(longer).warnings[0]
    assert open_container(longer).binary == b"1234"
    assert "after the end" in open_container(whole + b"tail").warnings[0]


@pytest.mark.parametrize("length", range(60))
def test_a_glb_cut_anywhere_is_refused(length: int) -> None:
    whole = glb(EMPTY, b"12345678")
    assert len(whole) > 60

    error = refused(whole[:length])
    assert error.code == "asset_unusable"
    if length >= 12:
        assert f"has {length} bytes and claims {len(whole)}" in error.message


def test_a_chunk_that_claims_four_gigabytes_is_refused() -> None:
    whole = bytearray(glb(EMPTY))
    whole[12:16] = struct.pack("<I", 0xFFFFFFFC)

    assert "claims 4294967292 bytes" in refused(bytes(whole)).message


def test_another_version_of_the_container_is_unsupported() -> None:
    whole = bytearray(glb(EMPTY))
    whole[4:8] = struct.pack("<I", 1)

    assert refused(bytes(whole)).code == "asset_unsupported"


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"[]",
        b"7",
        b"null",
        b"\xef\xbb\xbf" + EMPTY,
        EMPTY + b"x",
        b'{"a":NaN}',
        b'{"a":Infinity}',
        b'{"a":"\xff"}',
        b'{"a":"\\ud800"}',
        b'{"a":' + b"9" * 5000 + b"}",
        b'{"secret":}',
    ],
)
def test_what_is_no_json_object_is_refused_without_repeating_it(text: bytes) -> None:
    error = refused(text)

    assert error.code == "asset_unusable"
    assert "secret" not in error.message
    assert len(error.message) < 120


def test_of_equal_keys_the_last_counts() -> None:
    assert parse(memoryview(b'{"a":1,"a":2}')) == {"a": 2}


def test_depth_is_bounded_and_brackets_in_strings_are_not_depth() -> None:
    deep = b'{"extras":' + b"[" * 200_000 + b"]" * 200_000 + b"}"
    flat = b'{"name":"' + b"[" * 1000 + b'\\"[["}'

    assert "recursion limit" in refused(deep).message
    assert parse(memoryview(flat))["name"].endswith('"[[')


def test_a_document_of_millions_of_values_is_too_large() -> None:
    lists = b'{"extras":[' + b"[]," * 300_001 + b"[]]}"
    numbers = b'{"extras":[' + b"0," * 4_000_001 + b"0]}"

    assert refused(lists).code == "asset_too_large"
    assert refused(numbers).code == "asset_too_large"
