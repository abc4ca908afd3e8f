"""How named pictures become the channels of one OpenEXR file."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import ExrType
from worker.images.image import Image

_LARGEST_HALF = np.float32(65504)

_COLOUR_NAMES = {1: "Y", 2: "YA", 3: "RGB", 4: "RGBA"}
_MAIN_DATA_NAMES = {1: "Y", 2: "RG", 3: "RGB", 4: "RGBA"}
_LAYER_DATA_NAMES = {2: "XY", 3: "XYZ", 4: "XYZW"}


@dataclass(frozen=True, slots=True)
class Channels:
    """The channels of one file: a name and a type each, and their numbers, (H, W, channels)."""

    names: tuple[str, ...]
    types: tuple[ExrType, ...]
    pixels: NDArray[np.float32]


def join_layers(layers: Mapping[str, Image], pixel_type: ExrType) -> Channels:
    """Put pictures of one size side by side.

    The layer named "" is the picture itself: its channels are R, G, B, A (or Y, A; data R, G). A
    layer "N" has N.R, N.G, N.B, N.A for colour, N.X, N.Y, N.Z, N.W for data, and is called just N
    if it has one channel; "uv" has uv.U and uv.V, those of Cryptomatte have R, G, B, A. The
    picture and colour layers have the asked type; named data (depth, ids, positions) is always
    float, since half holds no whole number above 2048.

    In half, finite values beyond 65504 become 65504 instead of infinity; NaN and infinity stay.

    Raises:
        ValueError: The layers are none, or of different sizes.
    """
    sizes = {(image.height, image.width) for image in layers.values()}
    if len(sizes) != 1:
        raise ValueError(f"layers must be of one size; they are of {sorted(sizes)}")
    names: list[str] = []
    types: list[ExrType] = []
    parts: list[NDArray[np.float32]] = []
    for layer, image in layers.items():
        layer_type = "float" if layer and image.meaning == "data" else pixel_type
        names += _names(layer, image)
        types += [layer_type] * image.channels
        parts.append(_saturate(image.pixels) if layer_type == "half" else image.pixels)
    pixels = parts[0] if len(parts) == 1 else np.concatenate(parts, axis=2)
    return Channels(tuple(names), tuple(types), pixels)


def _names(layer: str, image: Image) -> list[str]:
    if not layer:
        return list(
            (_COLOUR_NAMES if image.meaning == "colour" else _MAIN_DATA_NAMES)[image.channels]
        )
    if image.channels == 1:
        return [layer]
    if layer == "uv":
        return [f"{layer}.{letter}" for letter in "UV"]
    if layer.startswith("Crypto"):
        return [f"{layer}.{letter}" for letter in "RGBA"[: image.channels]]
    letters = (_COLOUR_NAMES if image.meaning == "colour" else _LAYER_DATA_NAMES)[image.channels]
    return [f"{layer}.{letter}" for letter in letters]


def _saturate(pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    beyond = (np.abs(pixels) > _LARGEST_HALF) & np.isfinite(pixels)
    if not beyond.any():
        return pixels
    return np.where(beyond, np.copysign(_LARGEST_HALF, pixels), pixels)
