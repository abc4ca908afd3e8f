"""A glance at work that is not finished."""

import numpy as np
import PIL.Image
import pytest

from worker import preview
from worker.images.image import Image
from worker.preview import Preview


@pytest.fixture
def clock(monkeypatch):
    class Clock:
        now = 100.0

        def monotonic(self):
            return self.now

    clock = Clock()
    monkeypatch.setattr(preview, "time", clock)
    return clock


def grey(value, width=4, height=2, meaning="data"):
    return Image(np.full((height, width, 1), value, np.float32), meaning)


def code(path):
    with PIL.Image.open(path) as picture:
        return picture.getpixel((0, 0))


def test_it_shows_the_last_step_but_not_too_often(tmp_path, clock):
    path = tmp_path / "preview"
    shown = Preview(path)
    shown.show(grey(0.0))
    clock.now += 0.25
    shown.show(grey(1.0))
    assert code(path) == 0
    clock.now += 0.5
    shown.show(grey(1.0))
    assert code(path) == 255
    assert [file.name for file in tmp_path.iterdir()] == ["preview"]


def test_it_is_small_and_keeps_its_shape(tmp_path):
    Preview(tmp_path / "preview").show(grey(0.5, width=4096, height=1024))
    with PIL.Image.open(tmp_path / "preview") as picture:
        assert picture.size == (256, 64)


def test_colour_is_encoded_and_data_is_not(tmp_path):
    # sRGB of 0.5 is 187.5 of 255
    Preview(tmp_path / "colour").show(grey(0.5, meaning="colour"))
    Preview(tmp_path / "data").show(grey(0.5))
    assert code(tmp_path / "colour") == 188
    assert code(tmp_path / "data") == 128


def test_where_it_cannot_be_left_nothing_happens(tmp_path):
    Preview(tmp_path / "no such folder" / "preview").show(grey(0.5))
    assert list(tmp_path.iterdir()) == []
