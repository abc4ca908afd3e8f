"""A picture of all directions in another layout."""

from typing import ClassVar, Literal

from api_schemas.sphere_textures import SphereTextureSpec


class ConvertLayoutSpec(SphereTextureSpec):
    """Brings light from one layout to another, weighed by solid angle so that none is lost.

    The job's report tells the light before and after, and what was made up for.
    """

    source: ClassVar[str] = "Debevec, 1998 (probes); Greene, 1986 (cubes); Hughes et al., 20.4"
    equation: ClassVar[str] = "L(texel) = int_texel L dw / int_texel dw"

    technique: Literal["convert_layout"]
