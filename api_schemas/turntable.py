"""Several pictures of one scene, which turns."""

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import WHOLE, Schema, Vector

FRAMES_MAX = 360


class Turntable(Schema):
    """All things turn round an upright axis in equal steps; eye, lights and sky stand still.

    They turn to the right as seen from the front: counter-clockwise from above.
    """

    frames: Annotated[int, Field(ge=1, le=FRAMES_MAX), WHOLE] = Field(
        default=8, description="Steps of one whole turn; after so many it is as it was."
    )
    frame: Annotated[int, Field(ge=0, le=FRAMES_MAX), WHOLE] | None = Field(
        default=None,
        description="Only this frame, from 0, as one of many files (a batch with a sweep makes "
        "them). What lies beyond the whole turn comes round again.",
    )
    pivot: Vector = Field(default=[0.0, 0.0, 0.0], description="A point of the axis.")
    arrangement: Literal["sheet", "layers"] = Field(
        default="sheet",
        description="Where the frames go: beside each other into one picture, in rows from the "
        "upper left, as nearly square as can be, what is left over 0; or into an EXR as layers "
        "frame_0000, frame_0001 and so on, beside the first one as the picture.",
    )

    @property
    def drawn(self) -> list[int]:
        """The numbers of the frames that are drawn."""
        return list(range(self.frames)) if self.frame is None else [self.frame % self.frames]

    @property
    def cells(self) -> int:
        """How many frames lie beside each other in the file."""
        return len(self.drawn) if self.arrangement == "sheet" else 1
