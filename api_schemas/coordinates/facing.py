"""How far a surface faces the eye: what contours are drawn with."""

from typing import ClassVar, Literal

from api_schemas.families import CoordinatesSpec


class FacingSpec(CoordinatesSpec):
    """Along u from turned away, 0, over the contour, 1/2, to facing the eye, 1.

    A picture of one row that is dark in its middle draws outlines; v is always 1/2.
    """

    source: ClassVar[str] = "Hughes et al., 2013, section 20.2"
    equation: ClassVar[str] = "u = (1 + n.r) / 2, n outward, r from the point towards the eye"
    dimensions: ClassVar[Literal[2, 3]] = 2

    technique: Literal["facing"]
