"""How a picture is stored for the filter that reads it: at which sizes, or summed up."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Wrap
from api_schemas.maps import TABLE_FILTERS, Filter, Pyramid
from worker.images.kaiser import kaiser_chain
from worker.images.pyramids import Cut, keep_coverage, mip_chain
from worker.images.ripmap import ripmap, ripmap_table
from worker.images.summed_area import summed_area_table


@dataclass(frozen=True, slots=True)
class StoredForm:
    """What of a map decides how its picture is stored; equal pictures of equal form are one.

    Attributes:
        kind: Smaller levels of box means or through a Kaiser window, or a table of its own.
        wrap: What lies beyond the edges, where that is stored as well.
        border: Beyond which value, where there is one.
    """

    kind: Literal["box", "kaiser", "ripmap", "summed_area"]
    wrap: tuple[Wrap, Wrap] = ("repeat", "repeat")
    border: tuple[float, ...] = (0.0,) * 4

    @classmethod
    def of(
        cls,
        filter_name: Filter,
        pyramid: Pyramid,
        wrap: tuple[Wrap, Wrap],
        border: Sequence[float],
    ) -> "StoredForm":
        """Return the form that a filter reads."""
        if filter_name in TABLE_FILTERS:
            return cls(filter_name, wrap, tuple(border))
        return BOX if pyramid == "box" else cls(pyramid, wrap)

    @property
    def is_table(self) -> bool:
        """Whether it is one picture, of another size, that holds all smaller ones."""
        return self.kind in TABLE_FILTERS


BOX = StoredForm("box")


def stored(
    pixels: NDArray[np.float32], form: StoredForm, *, levels: bool, cut: Cut | None
) -> list[NDArray[np.float32]]:
    """Return the levels to upload, the largest first; a table is one.

    Args:
        pixels: float32 (H, W, C), linear light, alpha premultiplied.
        form: How they are stored.
        levels: Whether a form with smaller levels has any but the first.
        cut: Where holes are, if smaller levels shall have as many.
    """
    if form.kind == "summed_area":
        return [summed_area_table(pixels, form.wrap, form.border)]
    if form.kind == "ripmap":
        rows = ripmap(pixels)
        if cut is not None:
            keep_coverage([item for row in rows for item in row], cut)
        return [ripmap_table(rows, form.wrap, form.border)]
    if not levels:
        return [pixels]
    chain = mip_chain(pixels) if form.kind == "box" else kaiser_chain(pixels, form.wrap)
    if cut is not None:
        keep_coverage(chain, cut)
    return chain
