"""A picture of all directions in another layout, no light lost (T08)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from worker.images.image import Image
from worker.outcome import Outcome
from worker.synthesis import _sphere
from worker.synthesis._conversion import converted
from worker.synthesis._environment import harmonics_of, taken, told

if TYPE_CHECKING:
    from collections.abc import Mapping

    from api_schemas.textures.convert_layout import ConvertLayoutSpec
    from worker.stages import Report


def synthesize(
    spec: ConvertLayoutSpec, size: tuple[int, int], inputs: Mapping[str, Image], report: Report
) -> Outcome:
    """Return the light in the layout `to`: three channels of colour."""
    source, mended = taken(inputs["environment"], spec.layout, spec.broken_texels)
    made = converted(source, spec.to, size, report)
    return Outcome(
        Image(made.sphere.pixels, "colour"),
        report={
            "power_before": made.before.tolist(),
            "power_after": made.after.tolist(),
            "gain": made.gain.tolist(),
            "all_directions": made.whole,
            **told(harmonics_of(source)),
            **mended,
        },
    )


def warm() -> None:
    """Compile the kernels."""
    _sphere.warm()
