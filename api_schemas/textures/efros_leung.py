"""Texture grown pixel by pixel, each chosen by all that is known around it."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.base import WHOLE
from api_schemas.by_example import KeepingSpec
from api_schemas.cost import Cost


class EfrosLeungSpec(KeepingSpec):
    """Grows outwards from a seed, or from what is kept, and compares with all of the exemplar.

    Slow, and careful with structure: regular things go on exactly where the window is larger than
    what repeats.
    """

    source: ClassVar[str] = "Efros and Leung, 1999; Popat and Picard, 1993 (clusters)"
    equation: ClassVar[str] = (
        "a random q with d(q) <= 1.1 min d, d(q) = the mean over the known e of "
        "G(e) |target(p + e) - exemplar(q + e)|^2"
    )

    technique: Literal["efros_leung"]
    window: Annotated[int, Field(ge=3, le=31), WHOLE] = Field(
        default=11,
        description="Side of the square that is compared, in pixels; even ones count as the next "
        "smaller: it should be as large as the largest regular thing.",
    )
    tileable: bool = Field(
        default=False, description="Whether the result goes on seamlessly around its edges."
    )

    clusters: Annotated[int, Field(ge=0, le=512), WHOLE] = Field(
        default=0,
        description="Into how many kinds the exemplar's neighbourhoods are sorted first; then only "
        "those of the likeliest kind are compared. Some dozens are a few times as quick, and "
        "wander more; 0 compares with all.",
    )

    def cost_from(self, within: Mapping[str, int], pixels: int) -> Cost:
        """About half of a window is known when its pixel is compared with all of the exemplar."""
        grown = self.size[0] * self.size[1]
        places = float(within["exemplar"])
        # Clusters are of uneven sizes: as if the likeliest were four times the mean
        compared = self.clusters + places * min(1, 4 / self.clusters) if self.clusters else places
        slowness = 2e-9 if self.clusters else 6e-10
        sorting = places * self.clusters * self.window**2 * 1e-9
        return Cost(
            seconds=grown * compared * self.window**2 * slowness
            + sorting
            + grown * 1e-5
            + pixels * 5e-8,
            bytes=grown * 100.0 + places * 140.0 + 12288 * 32 * self.window**2 + pixels * 64.0,
        )
