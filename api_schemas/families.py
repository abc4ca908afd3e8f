"""The families of techniques: what each member says of itself besides its parameters.

A technique's name is written once: its module's name, its `technique` literal, its word in the URL.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, Literal

from api_schemas.base import Schema
from api_schemas.cost import Cost

Meaning = Literal["colour", "data"]
Wrap = Literal["repeat", "mirror", "clamp", "border"]


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why a valid spec cannot be done: a problem's code, the field at fault, and the reason."""

    code: str
    field: str
    message: str


class TechniqueSpec(Schema):
    """One technique with its parameters; the class carries what documentation and digests need."""

    revision: ClassVar[int] = 1
    """Raised whenever the same parameters give other pixels."""
    source: ClassVar[str] = ""
    """Author and year of the idea."""
    equation: ClassVar[str] = ""
    """The formula in plain text, where there is one."""

    technique: str


class TextureSpec(TechniqueSpec):
    """Makes a picture from parameters, nested textures and uploaded pictures."""

    meaning: ClassVar[Meaning] = "colour"
    """Whether the result is light (sRGB in a PNG) or numbers (quantised as they are)."""
    layers: ClassVar[tuple[str, ...]] = ()
    """What it can tell besides the picture: layers that `output.layers` may name."""
    sized: ClassVar[bool] = False
    """Whether it has a size of its own in pixels; otherwise it is a function on the unit tile."""

    solid: ClassVar[bool] = False
    """Whether it also fills space, where the textures nested in it do."""
    pointwise: ClassVar[bool] = False
    """Whether each pixel follows from the same pixel of its inputs alone: so it is solid, too."""

    surface_side: ClassVar[int] = 1024
    """Pixels along each side of its picture, where a surface wears it."""

    @property
    def surface_size(self) -> tuple[int, int]:
        """Width and height of its picture, where a surface wears it."""
        return (self.surface_side, self.surface_side)

    def inner_size(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the size that textures within are made at, where this one is made at `size`."""
        return size

    def outer_size(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the size of its own pixels, where the largest within it are of a `size`."""
        return size

    def has_layer(self, name: str) -> bool:
        """Whether it can tell this layer with the numbers and textures it was given."""
        return name in self.layers

    def refusals(self) -> Iterator[Refusal]:
        """Tell what its numbers make impossible, beyond what its schema refuses."""
        yield from ()

    def has_formula(self) -> bool:
        """Whether it can be worked out at any place; the textures nested in it must be able too."""
        return False

    def cost(self, pixels: int) -> Cost:
        """Estimate this technique at a number of pixels, without the textures nested in it."""
        return Cost(seconds=pixels * 2e-8, bytes=pixels * 32)

    def volume_cost(self, voxels: int) -> Cost:
        """Estimate the same as a volume, where that does not just cost as much for each voxel."""
        return self.cost(voxels)


class PresetSpec(TextureSpec):
    """A composition of other techniques with a name, and parameters of its own."""

    solid: ClassVar[bool] = True
    pointwise: ClassVar[bool] = True

    @abstractmethod
    def composed(self) -> TextureSpec:
        """Return the composition, of solid textures."""

    def has_formula(self) -> bool:
        """Whether all that it is composed of do."""
        return all(part.has_formula() for part in textures_in(self.composed()))

    def cost(self, pixels: int) -> Cost:
        """Estimate all that it is composed of."""
        return sum((part.cost(pixels) for part in textures_in(self.composed())), Cost())

    def volume_cost(self, voxels: int) -> Cost:
        """Estimate all that it is composed of."""
        return sum((part.volume_cost(voxels) for part in textures_in(self.composed())), Cost())


def textures_in(texture: TextureSpec) -> Iterator[TextureSpec]:
    """Yield a texture and all that are nested in it."""
    yield texture
    for name in type(texture).model_fields:
        value = getattr(texture, name)
        if isinstance(value, TextureSpec):
            yield from textures_in(value)


class CoordinatesSpec(TechniqueSpec):
    """Says which vector of the surface point a map is looked up with."""

    dimensions: ClassVar[Literal[2, 3]] = 3
    """Whether it gives a place on a picture, or a place or direction in space."""


class LayoutSpec(TechniqueSpec):
    """Says where on a picture each direction lies."""

    whole: ClassVar[bool] = True
    """Whether every place on the picture holds a direction."""

    @property
    def joins(self) -> tuple[Wrap, Wrap]:
        """What lies beyond the picture along u and v."""
        return ("clamp", "clamp")

    @property
    def proportion(self) -> tuple[int, int]:
        """Width to height of the picture."""
        return (1, 1)

    def mistake(self) -> tuple[str, str] | None:
        """Return which field is impossible and why, if JSON Schema could not say it."""
        return None
