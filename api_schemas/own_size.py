"""At which size the textures within a texture are made.

A texture is made at its parent's size: it is a function on the unit tile. But where a technique
copies pixels, it needs those that are there: its slots say so with a MadeAt.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from api_schemas.families import TextureSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import outermost, part_with

Size = tuple[int, int]
"""Width and height in pixels."""

FUNCTION_SIZE: Size = (256, 256)
"""Of a texture that is made of functions alone, where its own size is wanted."""


@dataclass(frozen=True, slots=True)
class MadeAt:
    """Marks a field with a texture that is not made at its parent's size.

    Attributes:
        size: `own`: that of its own pixels; of functions the spec's `function_size`, if it has
            one; of the field `exemplar` the spec's `exemplar_size` may say another.
            `exemplar`: that of the field `exemplar`. `result`: the spec's own `size`.
    """

    size: Literal["own", "exemplar", "result"]


OWN_SIZE = MadeAt("own")
LIKE_EXEMPLAR = MadeAt("exemplar")
LIKE_RESULT = MadeAt("result")


def own_size(texture: TextureSpec, measure: Callable[[ImageSpec], Size]) -> Size:
    """Return the size of a texture's own pixels.

    That is an uploaded picture's, or a technique's own `size`; of what is made of others, what it
    makes (`outer_size`) of the largest pixels among them, and FUNCTION_SIZE where there are none.

    Args:
        texture: Of any technique.
        measure: Tells the size of an uploaded picture.
    """
    return _size(texture, measure) or FUNCTION_SIZE


def size_within(
    texture: TextureSpec, name: str, size: Size, measure: Callable[[ImageSpec], Size]
) -> Size:
    """Return the size at which the texture in a field of another one is made.

    Args:
        texture: Of any technique.
        name: Of its field, or of that of a part in a list (`fields_within`).
        size: At which it is made itself.
        measure: Tells the size of an uploaded picture.
    """
    holder, name = part_with(texture, name)
    field = type(holder).model_fields.get(name)
    metadata = field.metadata if field else []
    rule = next((item.size for item in metadata if isinstance(item, MadeAt)), None)
    if rule is None:
        return texture.inner_size(size)
    if rule == "result":
        return own_size(texture, measure)
    source = name if rule == "own" else "exemplar"
    if source == "exemplar" and (wanted := getattr(holder, "exemplar_size", None)):
        width, height = wanted
        return (width, height)
    functions: Size = getattr(texture, "function_size", FUNCTION_SIZE)
    return _size(getattr(holder, source), measure) or functions


def _size(texture: TextureSpec, measure: Callable[[ImageSpec], Size]) -> Size | None:
    if isinstance(texture, ImageSpec):
        return measure(texture)
    if texture.sized:
        width, height = getattr(texture, "size")  # noqa: B009 every sized technique has one
        return (width, height)
    fields = (getattr(texture, name) for name in type(texture).model_fields)
    within = (_size(inner, measure) for field in fields for inner in outermost(field, TextureSpec))
    largest = max((size for size in within if size), key=math.prod, default=None)
    return texture.outer_size(largest) if largest else None
