"""Cryptomatte: which things a pixel shows, by the hashes of their names, and how much of each.

As its specification, version 1.2.0, says (Friedman and Jones, 2015; Psyop): pairs of an id and its
coverage, the largest first, two pairs in each layer; ids are MurmurHash3 of names, as float32.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.images.image import Image
from worker.images.murmur import murmur3
from worker.rendering.pyrender_scene import Drawable

LEVELS = 3
RANKS = 2 * LEVELS
_LAYERS = {"crypto_object": "CryptoObject", "crypto_material": "CryptoMaterial"}


@dataclass(frozen=True, slots=True)
class Mattes:
    """One kind of ids.

    Attributes:
        layer: Its name in the file.
        names: Of the numbers 1, 2, ... that samples hold; equal names are one thing.
    """

    layer: str
    names: tuple[str, ...]

    def attributes(self) -> dict[str, str]:
        """Return what a file says of its ids; the manifest gives each name its hash."""
        key = f"cryptomatte/{murmur3(self.layer.encode()):08x}"[:19]
        return {
            f"{key}/name": self.layer,
            f"{key}/hash": "MurmurHash3_32",
            f"{key}/conversion": "uint32_to_float32",
            f"{key}/manifest": json.dumps(self.manifest(), separators=(",", ":")),
        }

    def manifest(self) -> dict[str, str]:
        """Return the hexadecimal id of each name."""
        return {name: f"{id_of(name):08x}" for name in self.names}

    def images(self, numbers: NDArray[np.float32]) -> Mapping[str, Image]:
        """Rank what each pixel shows.

        Args:
            numbers: (height, width, samples), 0 where nothing is.

        Returns:
            Layers 00, 01, ... with id, coverage, id, coverage; and one with colours for the eye.
        """
        ids = np.array([0, *(id_of(name) for name in self.names)], dtype=np.uint32)
        # Things of one name share the lowest number among them.
        first = {name: number for number, name in reversed(list(enumerate(self.names, 1)))}
        same = np.array([0, *(first[name] for name in self.names)])
        ranked, coverage = ranks(same[np.rint(numbers).astype(int)])
        levels = np.empty((*ranked.shape[:2], RANKS, 2), dtype=np.float32)
        levels[..., 0] = ids.view(np.float32)[ranked]
        levels[..., 1] = coverage
        levels = levels.reshape(*ranked.shape[:2], LEVELS, 4)
        found = {
            f"{self.layer}{level:02d}": Image(np.ascontiguousarray(levels[:, :, level]), "data")
            for level in range(LEVELS)
        }
        preview = (_colours(ids)[ranked] * coverage[..., None]).sum(axis=2)
        return found | {self.layer: Image(preview.astype(np.float32), "data")}


def id_of(name: str) -> int:
    """Return a name's id: its hash, changed where as a float it would be no number or tiny."""
    value = murmur3(name.encode())
    exponent = value >> 23 & 255
    return value ^ 1 << 23 if exponent in (0, 255) else value


def ranks(numbers: NDArray[np.integer]) -> tuple[NDArray[np.integer], NDArray[np.float32]]:
    """Return which numbers each pixel holds and the share of each, the largest share first.

    Of equal shares the lower number is first; 0 stands for nothing and has no share.

    Args:
        numbers: (height, width, samples).

    Returns:
        Numbers and shares, (height, width, RANKS).
    """
    count = numbers.shape[2]
    found = np.sort(numbers, axis=2)
    starts = np.ones(found.shape, dtype=bool)
    starts[..., 1:] = found[..., 1:] != found[..., :-1]
    # Where the next run of equal numbers starts, counted from the back.
    places = np.where(starts, np.arange(count), count)
    following = np.minimum.accumulate(places[..., ::-1], axis=2)[..., ::-1]
    ends = np.concatenate([following[..., 1:], np.full((*found.shape[:2], 1), count)], axis=2)
    lengths = np.where(starts & (found > 0), ends - np.arange(count), 0)
    order = np.argsort(-lengths, axis=2, kind="stable")[..., :RANKS]
    shares = np.take_along_axis(lengths, order, axis=2)
    ranked = np.where(shares > 0, np.take_along_axis(found, order, axis=2), 0)
    missing = ((0, 0), (0, 0), (0, RANKS - order.shape[2]))
    return np.pad(ranked, missing), np.pad((shares / count).astype(np.float32), missing)


def _colours(ids: NDArray[np.uint32]) -> NDArray[np.float32]:
    """Give each id a colour from the bits of its hash; nothing is black."""
    bytes_of = np.stack([ids & 255, ids >> 8 & 255, ids >> 16 & 255], axis=1)
    colours: NDArray[np.float32] = (bytes_of / 255).astype(np.float32)
    return colours


def mattes_of(drawables: Sequence[Drawable], layers: Sequence[str]) -> dict[str, Mattes]:
    """Return the kinds of ids that are among the layers."""
    things = {drawable.thing: drawable.name for drawable in drawables}
    materials = {drawable.material for drawable in drawables}
    names = {
        "crypto_object": tuple(things[number] for number in sorted(things)),
        "crypto_material": tuple(f"material {number}" for number in sorted(materials)),
    }
    return {name: Mattes(_LAYERS[name], names[name]) for name in layers if name in names}


def attributes(mattes: Mapping[str, Mattes]) -> dict[str, str]:
    """Return what a file says of all its ids."""
    return {key: text for item in mattes.values() for key, text in item.attributes().items()}
