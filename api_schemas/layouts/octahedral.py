"""All directions on one square, unfolded from an octahedron."""

from typing import ClassVar, Literal

from api_schemas.families import LayoutSpec


class OctahedralSpec(LayoutSpec):
    """The half with z >= 0 is the diamond in the middle; the other one is folded into the corners.

    The whole square is used, and texels differ in solid angle by 5.2 at most.
    """

    source: ClassVar[str] = "Praun and Hoppe, 2003; Engelhardt and Dachsbacher, 2008"
    equation: ClassVar[str] = (
        "p = (x, y) / (|x| + |y| + |z|), folded to (1 - |p_y|, 1 - |p_x|) sign(p) where z < 0; "
        "(u, v) = (p + 1) / 2"
    )

    technique: Literal["octahedral"]
