"""Textures made from examples that are arrays, as a request would have them made."""

import numpy as np
from pydantic import TypeAdapter

from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import outcome

TEXTURE = TypeAdapter(Texture)


def upload(index):
    """The body of a picture that was uploaded as number 0, 1, .. of the pictures of a test."""
    return {"technique": "image", "asset": f"{index:064x}"}


def grow(technique, exemplar, size, *, meaning="colour", show=None, **fields):
    """Make a texture of an exemplar, (height, width, channels), at (width, height).

    Fields that are arrays are uploaded, too.
    """
    pictures = []

    def uploaded(value):
        if isinstance(value, np.ndarray):
            pictures.append(value)
            return upload(len(pictures) - 1)
        if isinstance(value, dict):
            return {name: uploaded(inner) for name, inner in value.items()}
        return [uploaded(item) for item in value] if isinstance(value, list) else value

    body = {"technique": technique, **uploaded({"exemplar": exemplar, **fields})}
    if FAMILIES["textures"][technique].sized:
        body["size"] = list(size)

    def load(spec, meaning):
        return Image(np.ascontiguousarray(pictures[int(spec.asset, 16)], np.float32), meaning)

    return outcome(TEXTURE.validate_python(body), tuple(size), load, meaning, show=show)


def noise(height, width, channels=3, seed=0):
    return np.random.default_rng(seed).random((height, width, channels), np.float32)


def colours(pixels):
    return set(map(bytes, np.ascontiguousarray(pixels).reshape(-1, pixels.shape[-1])))


def sources(made, exemplar):
    """Rows and columns of the exemplar that the layer `source` names."""
    height, width = exemplar.shape[:2]
    u, v = np.moveaxis(made.layers["source"].pixels, -1, 0)
    return np.floor((1 - v) * height).astype(int), np.floor(u * width).astype(int)
