import threading

import pytest

from worker.jobs.errors import MeasuringError


@pytest.fixture
def measure(engine, tmp_path):
    def measure(content, limit=30.0):
        path = tmp_path / f"upload-{threading.get_ident()}"
        path.write_bytes(content)
        return engine.measure(path, limit)

    return measure


def test_a_file_is_measured_in_a_child_that_leaves_nothing(measure, tmp_path):
    assert measure(b"scratch") == {"kind": "image", "size": 7}
    assert list((tmp_path / "data" / "assets").rglob("*.part")) == []


def test_a_measurer_hears_what_a_file_is_called(engine, tmp_path):
    path = tmp_path / "upload"
    path.write_bytes(b"called")
    assert engine.measure(path, 30.0, "model/mtl") == {"kind": "model/mtl"}
    assert engine.measure(path, 30.0) == {"kind": ""}


def test_a_refused_file_has_the_failure_of_its_measurer(measure):
    with pytest.raises(MeasuringError) as refusal:
        measure(b"refuse")
    assert refusal.value.failure == {
        "code": "asset_unusable",
        "message": "not a picture",
        "pointer": None,
    }


@pytest.mark.parametrize("content", [b"crash", b"hang"])
def test_a_file_that_kills_its_reader_is_unusable_and_the_next_one_is_not(measure, content):
    with pytest.raises(MeasuringError) as refusal:
        measure(content, 0.5)
    assert refusal.value.failure["code"] == "asset_unusable"
    assert measure(b"good")["size"] == 4


def test_many_threads_may_measure(measure):
    sizes = []
    threads = [
        threading.Thread(target=lambda n=n: sizes.append(measure(b"1" * n)["size"]))
        for n in range(1, 9)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(sizes) == list(range(1, 9))
