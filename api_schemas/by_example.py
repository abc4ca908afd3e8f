"""What the specs share that make new texture out of an exemplar's pixels."""

import math
from abc import abstractmethod
from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Schema, Seed
from api_schemas.cost import Cost
from api_schemas.families import Refusal, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture
from api_schemas.own_size import FUNCTION_SIZE, LIKE_EXEMPLAR, LIKE_RESULT, OWN_SIZE, Size
from api_schemas.side_by_side import together

EXEMPLAR_SIDE_MAX = 2048
RESULT_SIDE_MAX = 4096
EXEMPLARS_MAX = 8
MATERIAL = ("normal", "height", "occlusion", "roughness")
"""Maps of a material beside its colour."""
ExemplarSide = Annotated[int, Field(ge=1, le=EXEMPLAR_SIDE_MAX), WHOLE]
ResultSide = Annotated[int, Field(ge=1, le=RESULT_SIDE_MAX), WHOLE]


class FromExemplarSpec(TextureSpec):
    """Copies pixels of an exemplar: its own, at their own size."""

    layers: ClassVar[tuple[str, ...]] = ("source",)

    exemplar: Annotated["Texture", OWN_SIZE] = Field(
        description="The texture to make more of, with its own pixels: an upload at its size, a "
        "technique with a size at that, functions at 256 x 256. Pixels with alpha 0 are not copied."
    )
    exemplar_size: Annotated[list[ExemplarSide], Field(min_length=2, max_length=2)] | None = Field(
        default=None,
        description="Width and height at which the exemplar is read instead: a smaller one makes "
        "what is in it smaller, and the work quicker.",
    )
    exemplar_mask: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None,
        description="Where its first channel is below 0.5, the exemplar is not copied. Of another "
        "size, it is brought to the exemplar's.",
    )
    picture: Annotated["Texture | None", LIKE_EXEMPLAR] = Field(
        default=None,
        description="Another picture of the same thing, such as its normals or its roughness: the "
        "result is made of its pixels, from the same places. So all maps of a material stay "
        "together.",
    )
    seed: Seed = Field(default=0, description="Another number, another texture of the same kind.")

    def cost(self, pixels: int) -> Cost:
        """Of an exemplar of functions; where its size is known, `cost_at` knows better."""
        width, height = self.exemplar_size or FUNCTION_SIZE
        return self.cost_at({"exemplar": (width, height)}, pixels)

    def cost_of(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """Estimate the technique alone, where `sides` may have more than one exemplar's."""
        return self.cost_at(together(sides), pixels)

    def cost_at(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """Estimate the technique alone.

        Args:
            sides: Width and height of each nested texture, by field name; at least the exemplar's.
            pixels: How many the picture has that is asked for.
        """
        return self.cost_from({name: math.prod(size) for name, size in sides.items()}, pixels)

    @abstractmethod
    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """Estimate the technique alone.

        Args:
            within: How many pixels each nested texture has, by field name; at least the exemplar's.
            pixels: How many the picture has that is asked for.
        """


class GrownSpec(FromExemplarSpec):
    """Makes a picture of a size of its own out of an exemplar."""

    sized: ClassVar[bool] = True

    size: Annotated[list[ResultSide], Field(min_length=2, max_length=2)] = Field(
        default=[256, 256],
        description="Width and height that are grown, in pixels of the exemplar; the output's "
        "should be the same, else the picture is resampled.",
    )


class MaterialSpec(FromExemplarSpec):
    """Copies all maps of a material at once: what is found in one is copied from all."""

    layers: ClassVar[tuple[str, ...]] = ("source", *MATERIAL)

    normal: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None,
        description="The exemplar's normals, x along u, y along v, z out of the surface. The layer "
        "normal is made of them; they turn where parts of the exemplar are turned or mirrored.",
    )
    normal_range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Whether normal, and so its layer, holds 0..1, with 0.5 for none, or the "
        "numbers themselves.",
    )
    height: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The exemplar's relief; the layer height is made of it."
    )
    occlusion: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None,
        description="How much of the sky each of its pixels sees; the layer occlusion is made "
        "of it.",
    )
    roughness: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The exemplar's roughness; the layer roughness is made of it."
    )

    def has_layer(self, name: str) -> bool:
        """Whether there is such a layer: those of maps that were given."""
        return super().has_layer(name) and (name not in MATERIAL or getattr(self, name) is not None)


class GrownMaterialSpec(MaterialSpec, GrownSpec):
    """Grows all maps of a material at once."""


class FurtherExemplar(Schema):
    """Another picture of the same kind, with the same maps as the first exemplar."""

    exemplar: Annotated["Texture", OWN_SIZE] = Field(description="As the first exemplar.")
    exemplar_size: Annotated[list[ExemplarSide], Field(min_length=2, max_length=2)] | None = Field(
        default=None, description="Width and height at which this exemplar is read instead."
    )
    exemplar_mask: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="Where its first channel is below 0.5, this one is not copied."
    )
    picture: Annotated["Texture | None", LIKE_EXEMPLAR] = Field(
        default=None, description="Copied in the place of this exemplar, if the first has one."
    )
    normal: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The normals of this exemplar, if the first has any."
    )
    height: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The relief of this exemplar, if the first has one."
    )
    occlusion: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The occlusion of this exemplar, if the first has it."
    )
    roughness: Annotated["Texture | None", LIKE_EXEMPLAR, DATA] = Field(
        default=None, description="The roughness of this exemplar, if the first has it."
    )
    exemplar_guide: Annotated["Texture | None", LIKE_EXEMPLAR] = Field(
        default=None, description="What a guide is compared with here, if the first has its own."
    )


class MixedSpec(GrownMaterialSpec):
    """Grows out of one exemplar or several."""

    layers: ClassVar[tuple[str, ...]] = (*GrownMaterialSpec.layers, "exemplar")

    more_exemplars: (
        Annotated[list[FurtherExemplar], Field(min_length=1, max_length=EXEMPLARS_MAX - 1)] | None
    ) = Field(
        default=None,
        description="Further exemplars, each with the maps the first has. Pixels of all are "
        "copied, and none is compared across the edge of its own. The layer exemplar says which "
        "one a pixel is from, 0 the first, and the layer source where in that.",
    )

    def has_layer(self, name: str) -> bool:
        """Whether there is such a layer: which exemplar, where there are several."""
        return super().has_layer(name) and (name != "exemplar" or self.more_exemplars is not None)

    def cost_of(self, sides: Mapping[str, Size], pixels: int) -> Cost:
        """Several are laid beside each other, in each of their maps."""
        maps = sum(name.startswith("more_exemplars/0/") for name in sides)
        laid = math.prod(together(sides)["exemplar"]) * maps
        return super().cost_of(sides, pixels) + Cost(laid * 3e-8, laid * 32.0)

    def refusals(self) -> Iterator[Refusal]:
        """Every exemplar has the same maps: a pixel is copied from all of them."""
        for index, further in enumerate(self.more_exemplars or []):
            for name in ("picture", "exemplar_guide", *MATERIAL):
                first, other = getattr(self, name, None), getattr(further, name)
                if (first is None) != (other is None):
                    which = "has none, the first has" if other is None else "has, the first has not"
                    yield Refusal(
                        "exemplar_maps_differ",
                        f"more_exemplars/{index}/{name}",
                        f"{name}: exemplar {index + 2} {which}",
                    )


class KeepingSpec(MixedSpec):
    """Grows around parts that are finished already."""

    keep: Annotated["Texture | None", LIKE_RESULT] = Field(
        default=None,
        description="A picture parts of which are finished: they stay as they are, and the texture "
        "grows around them. Of another size, it is brought to the result's.",
    )
    keep_mask: Annotated["Texture | None", LIKE_RESULT, DATA] = Field(
        default=None,
        description="Where its first channel is at least 0.5, keep stays; by default where keep "
        "has alpha above 0.",
    )


class GuidedSpec(KeepingSpec):
    """Grows under guidance: a picture to follow."""

    guide: Annotated["Texture | None", LIKE_RESULT] = Field(
        default=None,
        description="A picture the result follows: where it is like a place of exemplar_guide, "
        "that place of the exemplar is preferred. Of another size, it is brought to the "
        "result's.",
    )
    exemplar_guide: Annotated["Texture | None", LIKE_EXEMPLAR] = Field(
        default=None, description="What the guide is compared with; by default the exemplar itself."
    )
    guide_weight: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5,
        description="How much the guide counts: 0 not at all, 0.5 as much as the texture, 1 alone.",
    )
