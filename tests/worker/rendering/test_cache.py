from worker.rendering.cache import ByteCache


def test_things_are_made_once() -> None:
    cache = ByteCache[str](10, lambda _: None)

    assert cache.get("a", lambda: ("first", 1)) == "first"
    assert cache.get("a", lambda: ("second", 1)) == "first"


def test_the_least_recently_used_go_first() -> None:
    freed: list[str] = []
    cache = ByteCache[str](20, freed.append)
    for key in "abc":
        cache.get(key, lambda key=key: (key, 8))
    cache.get("a", lambda: ("again", 8))

    cache.trim()

    assert freed == ["b"]
    assert len(cache) == 2


def test_nothing_is_freed_before_trim() -> None:
    freed: list[str] = []
    cache = ByteCache[str](1, freed.append)

    cache.get("a", lambda: ("a", 100))
    assert freed == []

    cache.trim()
    assert freed == ["a"]
