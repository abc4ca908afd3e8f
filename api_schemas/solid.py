"""Textures that fill space: which can, and what in one stands in the way."""

from collections.abc import Iterator

from api_schemas.families import TextureSpec
from api_schemas.walk import parts


def flat_parts(texture: TextureSpec, pointer: str = "") -> Iterator[tuple[str, TextureSpec]]:
    """Yield what of a texture, itself included, is not solid, each with its JSON pointer.

    A texture none of whose parts is flat can be made as a volume.
    """
    for place, part in parts(texture, pointer):
        if isinstance(part, TextureSpec) and not part.solid:
            yield place, part
