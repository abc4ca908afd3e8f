"""Which results stay and which go; time is the test's own."""

import os
from types import SimpleNamespace

import pytest

from worker.jobs import results as results_module
from worker.jobs.results import GRACE_SECONDS, Limits, Results


@pytest.fixture
def clock(monkeypatch):
    now = SimpleNamespace(seconds=1000.0, free=1 << 40)
    monkeypatch.setattr(results_module.time, "monotonic", lambda: now.seconds)
    monkeypatch.setattr(
        results_module.shutil, "disk_usage", lambda _: SimpleNamespace(free=now.free)
    )
    return now


@pytest.fixture
def make(tmp_path, clock):
    def make(**limits):
        return Results(tmp_path / "results", Limits(**limits))

    return make


def put(results, name, length):
    half = results.half(name, 1)
    half.write_bytes(b"\1" * length)
    results.settle(half)
    results.publish(half, name)


def names(results):
    return sorted(path.name for path in results._folder.iterdir())


def test_the_least_recently_used_go_until_the_rest_fits(make, clock):
    results = make(bytes=300)
    for name in "abcd":
        put(results, name, 100)
        clock.seconds += 1
    assert results.find("a") is not None
    clock.seconds += GRACE_SECONDS
    assert results.evict() == ["b"]
    assert (names(results), results.bytes, results.count) == (["a", "c", "d"], 300, 3)
    assert results.find("b") is None


def test_what_was_just_made_or_fetched_stays_whatever_the_limit(make, clock):
    results = make(bytes=0)
    put(results, "a", 100)
    put(results, "b", 100)
    clock.seconds += GRACE_SECONDS - 1
    assert results.find("a") is not None
    assert results.evict() == []
    clock.seconds += 1
    assert results.evict() == ["b"]
    clock.seconds += GRACE_SECONDS
    assert results.evict() == ["a"]


def test_what_nobody_used_for_so_long_goes_though_there_is_room(make, clock):
    results = make(seconds=3600.0)
    put(results, "a", 1)
    clock.seconds += 1800
    put(results, "b", 1)
    clock.seconds += 1801
    assert results.evict() == ["a"]
    assert results.find("b") is not None
    clock.seconds += 3601
    assert results.evict() == ["b"]


def test_results_make_room_on_a_disk_that_fills(make, clock):
    results = make(free_bytes=1000)
    for name in "abc":
        put(results, name, 100)
    clock.seconds += GRACE_SECONDS
    clock.free = 850
    assert results.evict() == ["a", "b"]


def test_a_new_result_takes_the_place_of_an_older_one_of_the_same_work(make, clock):
    results = make()
    put(results, "a", 100)
    put(results, "a", 40)
    assert (results.bytes, results.count) == (40, 1)
    results.remove("a")
    assert (results.bytes, results.count, names(results)) == (0, 0, [])


def test_a_result_that_somebody_removed_is_noticed(make, clock):
    results = make()
    put(results, "a", 100)
    (results._folder / "a").unlink()
    assert results.find("a") is None
    assert results.bytes == 0


def test_the_order_of_use_survives_a_restart(make, clock):
    """Told by the times of the files: a was used last, b two hours before."""
    results = make()
    for name, used in (("a", 9_000), ("b", 1_800), ("c", 5_000)):
        put(results, name, 10)
        os.utime(results._folder / name, (used, used))
    again = make(seconds=3600.0)
    assert again.sweep({"a": 10, "b": 10, "c": 10}) == []
    clock.seconds += 1
    assert again.evict() == ["b", "c"]


def test_a_wrong_clock_at_the_start_takes_nothing_away(make, clock, monkeypatch):
    results = make()
    put(results, "a", 10)
    monkeypatch.setattr(results_module.time, "time", lambda: 4e12)
    again = make(seconds=3600.0)
    again.sweep({"a": 10})
    assert again.evict() == []


def test_the_start_removes_what_is_half_strange_or_of_the_wrong_length(make, clock, tmp_path):
    results = make()
    for name in ("whole", "short", "unknown"):
        put(results, name, 10)
    (results._folder / "short").write_bytes(b"123")
    results.half("work", 2).write_bytes(b"half")
    again = make()
    assert again.sweep({"whole": 10, "short": 10, "gone": 10}) == ["gone", "short"]
    assert names(again) == ["whole"]
    assert (again.bytes, again.count) == (10, 1)
