import pytest

from worker.images.murmur import murmur3


@pytest.mark.parametrize(
    ("text", "seed", "published"),
    [
        ("", 0, 0),
        ("", 1, 0x514E28B7),
        ("hello", 0, 0x248BFA47),
        ("The quick brown fox jumps over the lazy dog", 0, 0x2E4FF723),
        ("bunny", 0, 0x13851A76),  # as the manifest in Cryptomatte's specification has it
        ("default", 0, 0x42C9679F),
    ],
)
def test_it_gives_the_published_values(text: str, seed: int, published: int) -> None:
    assert murmur3(text.encode(), seed) == published


@pytest.mark.parametrize("length", range(1, 10))
def test_every_length_of_the_rest_counts(length: int) -> None:
    data = bytes(range(1, length + 1))

    assert len({murmur3(data), murmur3(data + b"\0"), murmur3(b"\0" + data)}) == 3
