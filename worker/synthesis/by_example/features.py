"""The space in which pictures are compared: 8 bits, equal steps about equally visible."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy import ndimage

from worker.images.colour import srgb_from_linear, unpremultiply

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from worker.images.image import Image

    Bytes = NDArray[np.uint8]
    Mask = NDArray[np.bool_]

_EDGE_REACH = 12.0
_TAILS = (0.5, 99.5)


@dataclass(frozen=True, slots=True)
class FeatureSpace:
    """How numbers become 0..255: along a curve, then from `low` to `high`.

    Dark texture would vanish in linear light, so light is compared as sRGB encodes it, or, where a
    picture holds more than white, by its logarithm. Data are compared as they are, without their
    extremes.
    """

    curve: Literal["srgb", "log", "linear"]
    low: float
    high: float

    @classmethod
    def of(cls, image: Image) -> FeatureSpace:
        """Choose the space that suits a picture."""
        values = _straight(image)[usable(image)]
        if image.meaning == "colour" and values.max(initial=0.0) <= 1.001:
            return cls("srgb", 0.0, 1.0)
        curve: Literal["log", "linear"] = "log" if image.meaning == "colour" else "linear"
        bent = _bend(values, curve)
        low, high = np.percentile(bent, _TAILS) if bent.size else (0.0, 1.0)
        return cls(curve, float(low), float(high))

    def encode(self, image: Image) -> Bytes:
        """Return features, (height, width, channels), of a picture; alpha is not among them."""
        bent = _bend(_straight(image), self.curve)
        span = max(self.high - self.low, 1e-12)
        return _bytes((bent - self.low) / span * 255)


def usable(image: Image) -> Mask:
    """Return which pixels, (height, width), may be copied: those whose alpha is not 0."""
    if image.has_alpha:
        return np.asarray(image.pixels[..., -1] > 0)
    return np.ones(image.pixels.shape[:2], bool)


def with_channels(features: Bytes, count: int) -> Bytes:
    """Return features with so many channels: a grey stands for each, others are cut or empty."""
    channels = features.shape[2]
    if channels == 1:
        return np.repeat(features, count, axis=2)
    return np.pad(features[..., :count], ((0, 0), (0, 0), (0, max(0, count - channels))))


def edge_distance(features: Bytes) -> Bytes:
    """Return how far each pixel is from an edge, (height, width, 1).

    Scaled to vary as much as the colours together do: the outline of stones then counts as much as
    what they are made of (Kaspar et al., 2015). A flat picture has 0 everywhere.
    """
    grey = ndimage.gaussian_filter(features.astype(np.float32).mean(axis=-1), 1.0)
    slope = np.hypot(ndimage.sobel(grey, 0), ndimage.sobel(grey, 1))
    edges = slope > np.percentile(slope, 85)
    if not edges.any():
        return np.zeros((*features.shape[:2], 1), np.uint8)
    distance = np.minimum(ndimage.distance_transform_edt(~edges), _EDGE_REACH)
    wanted = features.std() * np.sqrt(features.shape[2])
    return _bytes(distance * (wanted / max(distance.std(), 1e-3)))[..., np.newaxis]


def weighed(features: Bytes, weight: float) -> Bytes:
    """Scale features so that squared differences count `weight` (0..1) times."""
    return features if weight >= 1 else _bytes(features * np.sqrt(weight))


def _bytes(values: NDArray[np.floating]) -> Bytes:
    return np.asarray(np.rint(np.clip(values, 0, 255)), np.uint8)


def _straight(image: Image) -> NDArray[np.float32]:
    """Return finite numbers without alpha, and not premultiplied by it."""
    pixels = np.nan_to_num(image.pixels, nan=0.0, posinf=3e38, neginf=-3e38)
    return unpremultiply(pixels)[..., :-1] if image.has_alpha else pixels


def _bend(values: NDArray[np.float32], curve: str) -> NDArray[np.float32]:
    if curve == "srgb":
        return srgb_from_linear(values)
    if curve == "log":
        return np.log2(np.maximum(values, 0) + np.float32(1e-3))
    return values
