"""How layers lie in the attachments of a framebuffer, which hold four numbers each.

shaders/lib/layers.glsl writes them and shaders/resolve_layers.frag makes pixels of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from api_schemas.families import Meaning

PICTURE = "picture"
ATTACHMENTS = 8
AVERAGED = 2
"""So many attachments, the first ones, hold the mean of a pixel's samples, the others the nearest
sample that shows a thing."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where a layer lies: channels `start` to `end` of an attachment."""

    attachment: int
    start: int
    end: int
    meaning: Meaning = "data"

    @property
    def channels(self) -> int:
        """How many numbers it holds for a pixel."""
        return self.end - self.start


SHADING_DIFFERENCE = "shading_difference"
"""The picture, less what one sample for each pixel makes of it."""

PLACES: Mapping[str, Place] = {
    PICTURE: Place(0, 0, 4, "colour"),
    "albedo": Place(1, 0, 4, "colour"),
    "coverage": Place(1, 3, 4),
    "normal": Place(2, 0, 3),
    "depth": Place(2, 3, 4),
    "geometric_normal": Place(3, 0, 3),
    "object_id": Place(3, 3, 4),
    "position": Place(4, 0, 3),
    "material_id": Place(4, 3, 4),
    "tangent": Place(5, 0, 3),
    "light_visibility": Place(5, 3, 4),
    "uv": Place(6, 0, 2),
    "texel_density": Place(6, 2, 3),
    "footprint": Place(7, 0, 4),
    SHADING_DIFFERENCE: Place(0, 0, 3, "colour"),
}

SAMPLED: Mapping[str, Place] = {
    "crypto_object": Place(3, 3, 4),
    "crypto_material": Place(4, 3, 4),
}
"""Layers that are made of all of a pixel's samples, and where these lie."""
