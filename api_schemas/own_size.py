"""At which size the textures within a texture are made.

A texture is made at its parent's size: it is a function on the unit tile. But where a technique
copies pixels, it needs those that are there: its slots say so with a MadeAt.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from api_schemas.families import TextureSpec
from api_schemas.textures.image import ImageSpec

Size = tuple[int, int]
"""Width and height in pixels."""

FUNCTION_SIZE: Size = (256, 256)
"""Of a texture that is made of functions alone, where its own size is wanted."""


@dataclass(frozen=True, slots=True)
class MadeAt:
    """Marks a field with a texture that is not made at its parent's size.

    Attributes:
        size: `own`: that of its own pixels, unless the spec's `exemplar_size` says another.
            `exemplar`: that of the field `exemplar`. `result`: the spec's own `size`.
    """

    size: Literal["own", "exemplar", "result"]


OWN_SIZE = MadeAt("own")
LIKE_EXEMPLAR = MadeAt("exemplar")
LIKE_RESULT = MadeAt("result")


def own_size(texture: TextureSpec, measure: Callable[[ImageSpec], Size]) -> Size:
    """Return the size of a texture's own pixels.

    That is an uploaded picture's, or a technique's own `size`; of what is made of others, that of
    the largest pixels among them, and FUNCTION_SIZE where there are none.

    Args:
        texture: Of any technique.
        measure: Tells the size of an uploaded picture.
    """
    return max(_sizes(texture, measure), key=math.prod, default=FUNCTION_SIZE)


def _sizes(texture: TextureSpec, measure: Callable[[ImageSpec], Size]) -> Iterator[Size]:
    if isinstance(texture, ImageSpec):
        yield measure(texture)
    elif texture.sized:
        width, height = getattr(texture, "size")  # noqa: B009 every sized technique has one
        yield (width, height)
    else:
        for inner in _within(texture).values():
            yield from _sizes(inner, measure)


def sizes_within(
    texture: TextureSpec, size: Size, measure: Callable[[ImageSpec], Size]
) -> dict[str, Size]:
    """Return the size at which each texture directly within another is made, by field name.

    Args:
        texture: Of any technique.
        size: At which it is made itself.
        measure: Tells the size of an uploaded picture.
    """
    within = _within(texture)
    sizes = {}
    for name, inner in within.items():
        metadata = type(texture).model_fields[name].metadata
        rule = next((item.size for item in metadata if isinstance(item, MadeAt)), None)
        if rule is None:
            sizes[name] = size
        elif rule == "result":
            sizes[name] = own_size(texture, measure)
        else:
            source = inner if rule == "own" else within["exemplar"]
            wanted = getattr(texture, "exemplar_size", None)
            sizes[name] = tuple(wanted) if wanted else own_size(source, measure)
    return sizes


def _within(texture: TextureSpec) -> dict[str, TextureSpec]:
    values = {name: getattr(texture, name) for name in type(texture).model_fields}
    return {name: value for name, value in values.items() if isinstance(value, TextureSpec)}
