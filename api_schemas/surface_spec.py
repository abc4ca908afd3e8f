"""What every surface can be told besides the parameters of its technique."""

from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, TypeAlias

from pydantic import Field
from typing_extensions import TypeAliasType

from api_schemas.families import TechniqueSpec
from api_schemas.maps import LightMap, MappableNonNegative, NormalMap
from api_schemas.members import OneOf
from api_schemas.relief import BumpMap, HeightMap, ParallaxMap, TangentFrames

AlphaMode = Literal["opaque", "mask", "blend"]
STREAK_LOOKUPS = 12
"""How often what is brushed looks at an environment; lib/streak.glsl has the same number."""


class SurfaceSpec(TechniqueSpec):
    """Says how a surface sends light to the eye, and how much of what is behind it is seen."""

    fills_box: ClassVar[bool] = False
    """Whether it is what is in a box, and not its sides: no other mesh may wear it, and it keeps no
    light from what is behind it."""

    streaks: ClassVar[bool] = False
    """Whether its highlights may be longer in one direction than in others."""

    sums_sky: ClassVar[bool] = False
    """Whether its formula may be added up over all directions that light comes from."""

    opacity: MappableNonNegative = Field(
        default=1.0,
        description="How much of what is behind is hidden, where alpha_mode is mask or blend.",
    )
    alpha_mode: AlphaMode = Field(
        default="opaque",
        description="Whether opacity is ignored, cuts holes, or lets through what is behind. What "
        "lets light through dims all of its own, highlights and emission too, as in glTF, and is "
        "drawn after everything else, the farthest middle first.",
    )
    alpha_cutoff: Annotated[float, Field(ge=0, le=1)] = Field(
        default=0.5, description="Opacity below which there is a hole, where alpha_mode is mask."
    )
    double_sided: bool = Field(
        default=True, description="Whether the inner side is drawn as well as the outer one."
    )
    normal: NormalMap | None = Field(
        default=None, description="Tilts the surface in fine detail: a map of normals."
    )
    bump: BumpMap | None = Field(
        default=None, description="Tilts what is there further, by two numbers for each texel."
    )
    height: HeightMap | None = Field(
        default=None, description="Tilts what is there further, as the slopes of a relief do."
    )
    parallax: ParallaxMap | None = Field(
        default=None,
        description="Lets the eye look into a relief: every other map is read where the ray ends.",
    )
    tangents: TangentFrames = Field(
        default="mikktspace",
        description="Which directions normal and bump maps tilt along: those that bakers use, the "
        "mean of the triangles round each corner, or the parallels and meridians of a globe round "
        "the y axis. They follow the coordinates of the normal map, without one the bump map's.",
    )

    light_map: LightMap | None = Field(
        default=None,
        description="Baked light that arrives besides the lamps', reflected as ambient light is.",
    )

    def looks(self, lights: int) -> int:
        """Return how often each sample reads the maps, where so many lights shine."""
        return 1

    @property
    def needs_tangents(self) -> bool:
        """Whether it looks different along u and along v, so that the mesh's tangents matter."""
        return False

    @property
    def is_streaked(self) -> bool:
        """Whether its highlights are longer in one direction, by themselves or by fine relief."""
        reliefs = (self.normal, self.bump, self.height)
        grooved = any(relief and relief.fine_detail == "streaks" for relief in reliefs)
        return self.needs_tangents or (self.streaks and grooved)

    @property
    def sky_lookups(self) -> int:
        """How often it looks at an environment for one sample."""
        return 1

    def filled(self) -> Self:
        """Return the surface with every parameter that follows another one set to its value."""
        return self


if TYPE_CHECKING:
    Surface: TypeAlias = SurfaceSpec
else:
    Surface = TypeAliasType("Surface", Annotated[Any, OneOf("surfaces")])
"""What a node writes where it wears any surface."""
