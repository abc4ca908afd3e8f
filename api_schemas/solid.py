"""Textures that fill space: which can, and what in one stands in the way."""

import math
from collections.abc import Iterator

from api_schemas.families import TextureSpec
from api_schemas.relief import AnyMap
from api_schemas.walk import parts

_SIDE = 128
"""Voxels along each side of what surfaces wear, a power of two: 2 million of them."""


def flat_parts(texture: TextureSpec, pointer: str = "") -> Iterator[tuple[str, TextureSpec]]:
    """Yield what of a texture, itself included, is not solid, each with its JSON pointer.

    A texture none of whose parts is flat can be made as a volume.
    """
    for place, part in parts(texture, pointer):
        if isinstance(part, TextureSpec) and not part.solid:
            yield place, part


def is_carved(mapped: AnyMap) -> bool:
    """Whether a map looks a texture up in space, at all three of its coordinates."""
    in_space = mapped.coordinates.dimensions == 3 and mapped.layout is None
    return in_space and not any(flat_parts(mapped.texture))


def worn_depth(texture: TextureSpec) -> int:
    """Return the voxels along each side of a texture's volume, where a surface wears it."""
    return min(*texture.surface_size, _SIDE)


def worn_size(texture: TextureSpec, proportion: tuple[int, int]) -> tuple[int, int]:
    """Return width and height of a texture's picture, where a surface wears it.

    Unless the proportion is that of a square, whole multiples of its sides, and about as many
    pixels.
    """
    if proportion == (1, 1):
        return texture.surface_size
    across, down = proportion
    unit = max(1, round(math.sqrt(math.prod(texture.surface_size) / (across * down))))
    return across * unit, down * unit
