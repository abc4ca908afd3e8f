import dataclasses

import numpy as np
import pytest

from worker.images.image import Image


def test_an_image_knows_its_size() -> None:
    image = Image(np.zeros((3, 5, 4), np.float32), "colour")

    assert (image.height, image.width, image.channels) == (3, 5, 4)


@pytest.mark.parametrize(
    ("meaning", "channels", "has_alpha"),
    [("colour", 1, False), ("colour", 2, True), ("colour", 3, False), ("colour", 4, True)]
    + [("data", channels, False) for channels in (1, 2, 3, 4)],
)
def test_only_colour_of_two_or_four_channels_has_alpha(
    meaning: str, channels: int, has_alpha: bool
) -> None:
    image = Image(np.zeros((1, 1, channels), np.float32), meaning)  # type: ignore[arg-type]

    assert image.has_alpha is has_alpha


@pytest.mark.parametrize(
    "shape", [(4, 4), (0, 4, 3), (4, 0, 3), (4, 4, 0), (4, 4, 5), (1, 4, 4, 3)]
)
def test_a_wrong_shape_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="shape"):
        Image(np.zeros(shape, np.float32), "data")


@pytest.mark.parametrize("kind", [np.float64, np.float16, np.uint8])
def test_any_other_number_type_is_refused(kind: type) -> None:
    with pytest.raises(TypeError, match="float32"):
        Image(np.zeros((2, 2, 3), kind), "colour")  # type: ignore[arg-type]


def test_an_image_cannot_be_pointed_at_other_pixels() -> None:
    image = Image(np.zeros((2, 2, 3), np.float32), "colour")

    with pytest.raises(dataclasses.FrozenInstanceError):
        image.meaning = "data"  # type: ignore[misc]
