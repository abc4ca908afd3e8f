"""Where in an exemplar each patch of a picture is found again."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import FromExemplarSpec
from api_schemas.cost import Cost
from api_schemas.families import Refusal
from api_schemas.members import Texture
from api_schemas.own_size import OWN_SIZE

NEAREST_MAX = 8
_FURTHER = range(2, NEAREST_MAX + 1)


class NearestNeighbourFieldSpec(FromExemplarSpec):
    """Paints a picture with an exemplar's pixels: each from the middle of the most similar patch.

    The field is in the layers: source, u and v in the exemplar; offset, columns to the right and
    rows down in pixels; distance, the root of the mean squared difference, 0..1; angle, how far the
    patch lies turned in the exemplar, anticlockwise in radians; scale, how much larger it is there.
    """

    source: ClassVar[str] = "Barnes, Shechtman, Finkelstein and Goldman, 2009 and 2010 (PatchMatch)"
    equation: ClassVar[str] = "offset(p) = argmin over v of |target(p) - exemplar(p + v)|^2"
    layers: ClassVar[tuple[str, ...]] = (
        "source",
        "offset",
        "distance",
        "angle",
        "scale",
        *(
            f"{name}_{rank}"
            for rank in range(2, NEAREST_MAX + 1)
            for name in ("offset", "distance")
        ),
    )

    technique: Literal["nearest_neighbour_field"]
    target: Annotated[Texture, OWN_SIZE] = Field(
        description="The picture whose patches are looked for, at its own size; the output's "
        "should be the same."
    )
    patch: Annotated[int, Field(ge=1, le=15), WHOLE] = Field(
        default=7,
        description="Side of a patch in pixels, or that of the smaller picture if it is smaller: "
        "larger ones keep more of how things lie beside each other.",
    )
    method: Literal["patch_match", "exact"] = Field(
        default="patch_match",
        description="Quick and nearly the nearest, or the nearest of all, which takes the product "
        "of both pictures' pixels.",
    )
    iterations: Annotated[int, Field(ge=0, le=64), WHOLE] = Field(
        default=5, description="How often patch_match passes over the picture: more come nearer."
    )

    nearest: Annotated[int, Field(ge=1, le=NEAREST_MAX), WHOLE] = Field(
        default=1,
        description="How many places are looked for at each patch. The layers offset_2, distance_2 "
        "and so on have those after the nearest; where there are no more, the distance is 1.",
    )

    rotations: Annotated[float, Field(ge=0, le=math.pi)] = Field(
        default=0.0,
        description="Up to which angle, in radians, patches are looked for turned either way: pi, "
        "however they lie. Then all places are found between pixels, and offsets are not whole.",
    )
    scales: Annotated[float, Field(ge=1, le=4)] = Field(
        default=1.0,
        description="Up to how many times as large, or as small, patches are looked for.",
    )

    @property
    def turned(self) -> bool:
        """Whether patches have an angle and a scale."""
        return self.rotations > 0 or self.scales > 1

    def refusals(self) -> Iterator[Refusal]:
        """Not all of the ways a patch may lie are tried, nor are several of them remembered."""
        if self.turned and self.method == "exact":
            yield Refusal(
                "options_exclude_each_other",
                "method",
                "turned and scaled patches are looked for by patch_match alone",
            )
        if self.turned and self.nearest > 1:
            yield Refusal(
                "options_exclude_each_other",
                "nearest",
                f"of turned and scaled patches the nearest is found, not {self.nearest}",
            )

    def has_layer(self, name: str) -> bool:
        """Whether there is such a layer: of as many places as are looked for, in such ways."""
        if name in ("angle", "scale"):
            return self.turned
        rank = name.rpartition("_")[2]
        return super().has_layer(name) and not (rank.isdigit() and int(rank) > self.nearest)

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """All pairs of patches, or a few for each patch of the target."""
        exemplar, target = within["exemplar"], within.get("target", within["exemplar"])
        numbers = 4.0 * self.patch**2
        comparisons = target * (
            exemplar * (1 + 0.2 * (self.nearest - 1))
            if self.method == "exact"
            else 24.0 * self.iterations * self.nearest
        )
        slowness = 5e-11 if self.method == "exact" else 5e-9 if self.turned else 1e-9
        return Cost(
            seconds=comparisons * numbers * slowness + (exemplar + target) * 2e-6 + pixels * 5e-8,
            bytes=(exemplar + target) * (180.0 + 20 * self.nearest)
            + 8192 * 4 * (2048 + 2 * numbers)
            + pixels * 64.0,
        )
