import pytest

from worker.errors import AssetMissingError, UnusableAssetError
from worker.models.siblings import shown, sibling, sibling_name


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("a.png", "a.png"),
        ("./a.png", "a.png"),
        (".\\a.png", "a.png"),
        ("maps\\wood grain.png", "maps/wood grain.png"),
        ("maps//./a.png", "maps/a.png"),
        ("../../../../etc/passwd", "passwd"),
        ("maps/../a.png", "a.png"),
        ("/etc/passwd", "passwd"),
        ("C:\\Users\\me\\a.png", "a.png"),
        ("C:a.png", "C:a.png"),
        ("..\\a.png", "a.png"),
    ],
)
def test_names_stay_within_the_set(written: str, name: str) -> None:
    assert sibling_name(written) == name


@pytest.mark.parametrize("url", ["http://169.254.169.254/a", "file:///etc/passwd", "data:,x"])
def test_urls_are_refused(url: str) -> None:
    with pytest.raises(UnusableAssetError, match="nothing is fetched") as refusal:
        sibling_name(url)
    assert refusal.value.code == "asset_unsupported"


@pytest.mark.parametrize("written", ["", "/", ".", "..", "../..", "a" * 257])
def test_what_is_no_name_is_refused(written: str) -> None:
    with pytest.raises(UnusableAssetError, match="1 to 256 characters"):
        sibling_name(written)


def test_a_file_is_found_as_written_or_by_its_name() -> None:
    assert sibling({"./a": b"1", "a": b"2"}, "./a") == b"1"
    assert sibling({"a": b"2"}, "./a") == b"2"
    with pytest.raises(AssetMissingError, match=r"a file b\.png, which") as missing:
        sibling({"a": b"2", "B.png": b""}, "b.png")
    assert missing.value.code == "asset_file_missing"


def test_a_message_shows_no_more_than_64_printable_characters_of_a_name() -> None:
    assert shown("a\x00b<script>\n") == "a?b?script??"
    assert len(shown("x" * 300)) == 64
