"""From a coordinate map to pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeVar

import numpy as np

from api_schemas.by_example import MATERIAL
from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis._channels import data_with, matched
from worker.synthesis._resample import resample
from worker.synthesis.by_example.quality import quality
from worker.synthesis.by_example.views import turned_normals

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from worker.synthesis.by_example.exemplar import Exemplar
    from worker.synthesis.by_example.side_by_side import SideBySide

    Integers = NDArray[np.int32]
    Pixels = NDArray[np.float32]

Kind = TypeVar("Kind", bound=np.generic)


def finished(
    place: Integers,
    exemplar: Exemplar,
    inputs: Mapping[str, Image],
    size: tuple[int, int],
    kept: Image | None = None,
    *,
    turns: NDArray[np.int64] | None = None,
    normal_range: Literal["unit", "signed"] = "unit",
) -> Outcome:
    """Gather pixels, and tell where they come from and how good the result is.

    Args:
        place: Row and column of the source of each pixel, (height, width, 2); -1 for kept ones.
        exemplar: What the map was made on.
        inputs: `picture` is what pixels are taken of, if it is there, else the exemplar. Layers
            are made of the maps of a material in the same way.
        size: Width and height of the picture that is wanted.
        kept: Where -1 is taken from.
        turns: Which view of the exemplar each pixel is from, where there are several.
        normal_range: Whether the normals of the material, if given, hold 0..1.
    """
    layout = exemplar.layout
    image = gathered(place, layout.joined(inputs, "picture") or exemplar.image, kept)
    layers = {"source": source_layer(place, layout)}
    if len(layout.sizes) > 1:
        layers["exemplar"] = layout.which(place)[..., np.newaxis].astype(np.float32)
    if turns is not None:
        layers["turn"] = turns[..., np.newaxis].astype(np.float32)
    given = {name: layout.joined(inputs, name) for name in MATERIAL}
    maps = {name: gathered(place, whole).pixels for name, whole in given.items() if whole}
    maps |= {name: np.where(place[..., :1] < 0, 0, pixels) for name, pixels in maps.items()}
    if "normal" in maps and turns is not None:
        maps["normal"] = _turned(maps["normal"], turns, normal_range)
    return Outcome(
        Image(resample(image.pixels, size), image.meaning),
        {name: Image(nearest(values, size), "data") for name, values in layers.items()}
        | {name: Image(resample(pixels, size), "data") for name, pixels in maps.items()},
        {"quality": quality(place, exemplar), **_shares(place, layout)},
    )


def gathered(place: Integers, source: Image, kept: Image | None = None) -> Image:
    """Copy pixels: nothing is computed with them, so they stay what they were."""
    rows, columns = np.moveaxis(place, -1, 0)
    if kept is None:
        return Image(source.pixels[rows, columns], source.meaning)
    copied, stays = matched(source, kept)
    pixels = np.where((rows < 0)[..., np.newaxis], stays, copied[rows, columns])
    return Image(pixels, source.meaning)


def _shares(place: Integers, layout: SideBySide) -> dict[str, list[float]]:
    """Tell which share of the copied pixels is from each exemplar, where there are several."""
    count = len(layout.sizes)
    if count == 1:
        return {}
    numbers = layout.which(place)
    pixels = np.bincount(numbers[numbers >= 0], minlength=count)
    return {"exemplars": [round(float(share), 4) for share in pixels / max(1, pixels.sum())]}


def _turned(
    pixels: Pixels, turns: NDArray[np.int64], normal_range: Literal["unit", "signed"]
) -> Pixels:
    """Turn the normals of a map with the pieces of it that were turned."""
    normals = data_with(pixels, 3)[..., :3]
    if normal_range == "signed":
        return turned_normals(normals, turns)
    return np.asarray((turned_normals(2 * normals - 1, turns) + 1) / 2, np.float32)


def source_layer(place: Integers, layout: SideBySide) -> NDArray[np.float32]:
    """Return u and v in its exemplar of each pixel's source, (height, width, 2); 0 for kept."""
    there, sizes = layout.within(place)
    (rows, columns), (height, width) = np.moveaxis(there, -1, 0), np.moveaxis(sizes, -1, 0)
    layer = np.empty((*rows.shape, 2), np.float32)
    layer[..., 0] = (columns + 0.5) / width
    layer[..., 1] = 1 - (rows + 0.5) / height
    layer[place[..., 0] < 0] = 0
    return layer


def nearest(values: NDArray[Kind], size: tuple[int, int]) -> NDArray[Kind]:
    """Bring coordinates to another (width, height): means of them would be other places."""
    height, width = values.shape[:2]
    rows = (2 * np.arange(size[1]) + 1) * height // (2 * size[1])
    columns = (2 * np.arange(size[0]) + 1) * width // (2 * size[0])
    return np.asarray(values[rows[:, np.newaxis], columns])
