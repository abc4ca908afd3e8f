"""Where in an exemplar each patch of a picture is found again."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import FromExemplarSpec
from api_schemas.cost import Cost
from api_schemas.members import Texture
from api_schemas.own_size import OWN_SIZE


class NearestNeighbourFieldSpec(FromExemplarSpec):
    """Paints a picture with an exemplar's pixels: each from the middle of the most similar patch.

    The field is in the layers: source, u and v in the exemplar; offset, columns to the right and
    rows down in pixels; distance, the root of the mean squared difference, 0..1.
    """

    source: ClassVar[str] = "Barnes, Shechtman, Finkelstein and Goldman, 2009 (PatchMatch)"
    equation: ClassVar[str] = "offset(p) = argmin over v of |target(p) - exemplar(p + v)|^2"
    layers: ClassVar[tuple[str, ...]] = ("source", "offset", "distance")

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

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """All pairs of patches, or a few for each patch of the target."""
        exemplar, target = within["exemplar"], within.get("target", within["exemplar"])
        numbers = 4.0 * self.patch**2
        comparisons = target * (
            float(exemplar) if self.method == "exact" else 24.0 * self.iterations
        )
        slowness = 5e-11 if self.method == "exact" else 1e-9
        return Cost(
            seconds=comparisons * numbers * slowness + (exemplar + target) * 2e-6 + pixels * 5e-8,
            bytes=(exemplar + target) * 200.0 + 8192 * 4 * (2048 + 2 * numbers) + pixels * 64.0,
        )
