"""What the specs share that read a normal map."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from api_schemas.families import Meaning, TextureSpec
from api_schemas.maps import DATA
from api_schemas.members import Texture


class NormalReadingSpec(TextureSpec):
    """Asks what a normal map says of a relief."""

    meaning: ClassVar[Meaning] = "data"

    normal: Annotated["Texture", DATA] = Field(
        description="The normal map: x along u, y along v, z out of the surface; it goes on "
        "around its edges."
    )
    normal_range: Literal["unit", "signed"] = Field(
        default="unit",
        description="Whether the normal map holds 0..1, with 0.5 for none, or the numbers "
        "themselves.",
    )
    green: Literal["up", "down"] = Field(
        default="up", description="Whether green grows with v, as in OpenGL, or against it."
    )
