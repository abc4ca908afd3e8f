"""What decides a surface's program: everything the compiler must know, and nothing else."""

from dataclasses import dataclass
from typing import Literal

from api_schemas.maps import Filter
from api_schemas.surface_spec import AlphaMode
from worker.rendering.calls import Call
from worker.rendering.samplers import Sampling
from worker.rendering.textures import TextureFormat

SkyKind = Literal["none", "latlong", "cube", "hemispheres", "lamps"]
"""The chunks of shaders/skies."""

SPACE_FILTERS: tuple[Filter, ...] = ("nearest", "bilinear", "trilinear")
"""Filters of volumes and cube maps; any other one is anisotropic there."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """One field of a surface. `lookup` is the index of the lookup it is read from, if mapped."""

    name: str
    type: str
    lookup: int | None


@dataclass(frozen=True, slots=True)
class FormulaLayout:
    """A texture worked out at the fragment.

    Attributes:
        chunks: Which it calls.
        declarations: Of its uniforms.
        call: An expression of place, across_x and across_y.
        solid: Whether it fills space.
    """

    chunks: tuple[str, ...]
    declarations: tuple[str, ...]
    call: str
    solid: bool


@dataclass(frozen=True, slots=True)
class LookupLayout:
    """One reading of a picture; parameters that share a lookup cost one.

    Attributes:
        calls: Which say where: that of the coordinates, then that of the layout, if there is one.
        filter: How texels become a pixel.
        picture: Which unit is read; none where there is a formula.
        formula: What is worked out in its place.
    """

    calls: tuple[Call, ...]
    filter: Filter
    picture: int | None
    formula: FormulaLayout | None = None

    @property
    def returns(self) -> str:
        """The GLSL type of what says where: a Footprint, a Reach or a Triplanar."""
        return self.calls[-1].returns


@dataclass(frozen=True, slots=True)
class PictureLayout:
    """A texture unit: how it is read, and what the JIT knows about the texture."""

    sampling: Sampling
    format: TextureFormat


@dataclass(frozen=True, slots=True)
class CookieLayout:
    """A picture before a light.

    Attributes:
        filter: How texels become a pixel.
        picture: Its texture unit.
        call: Which says how directions lie on it, if it is all round the light.
    """

    filter: Filter
    picture: PictureLayout
    call: Call | None


@dataclass(frozen=True, slots=True)
class LightLayout:
    """What the programs of lit surfaces know of a scene's lights.

    Attributes:
        shadows: Whether any casts shadows.
        cookies: The pictures before them.
        visibility: Whether what comes through is told as a layer, of surfaces that need none too.
        sky: Which chunk reads the light from all around.
    """

    shadows: bool = False
    cookies: tuple[CookieLayout, ...] = ()
    visibility: bool = False
    sky: SkyKind = "none"

    @property
    def samplers(self) -> tuple[str, ...]:
        """The names of the cookies' texture units in the program."""
        return tuple(f"cookie_{number}" for number in range(len(self.cookies)))


@dataclass(frozen=True, slots=True)
class Spread:
    """How slopes that are finer than a pixel vary, told by two readings of a map.

    Attributes:
        of: Which map it is.
        means: The lookup of its slopes.
        products: The lookup of their products.
        streaks: Whether that makes highlights longer in one direction, or wider in all.
    """

    of: Literal["normal", "bump", "height"]
    means: int
    products: int
    streaks: bool


@dataclass(frozen=True, slots=True)
class ReliefLayout:
    """What moves and tilts a point before anything else is read.

    Attributes:
        normal: The lookup of a map of normals, if there is one.
        normal_space: What these are relative to.
        bump: The lookup of a bump map.
        roughened_by_normal: Whether what of the map of normals is finer than a pixel is roughness.
        roughened_by_bump: The same of the bump map.
        height: The lookup of a relief's heights and slopes.
        parallax: The lookup of a relief that the eye looks into.
        parallax_method: How it looks.
        spreads: How fine slopes vary, where that is told by products.
    """

    normal: int | None
    normal_space: Literal["tangent", "object"]
    bump: int | None
    roughened_by_normal: bool
    roughened_by_bump: bool
    height: int | None
    parallax: int | None
    parallax_method: Literal["offset", "occlusion"]
    spreads: tuple[Spread, ...]

    @property
    def tilting(self) -> tuple[int, ...]:
        """The lookups that tilt the normal, and tell how it varies."""
        found = (self.normal, self.bump, self.height, *(one.products for one in self.spreads))
        return tuple(lookup for lookup in found if lookup is not None)


@dataclass(frozen=True, slots=True)
class ShadingLayout:
    """What decides a program; equal layouts share a program object.

    Attributes:
        technique: The surface's.
        parameters: In the order of its struct.
        alpha_mode: Whether opacity is ignored, cuts holes, or lets through what is behind.
        opacity: How it is read, unless it is ignored.
        relief: What moves and tilts the point.
        light_map: How baked light is read, if there is any.
        selection: How the number is read that says which surface is where, if there are several.
        lookups: Readings of pictures.
        pictures: Texture units of maps, then of tables.
        tables: What the surface's own tables are called.
        streaked: Whether highlights may be longer in one direction than in others.
    """

    technique: str
    parameters: tuple[Parameter, ...]
    alpha_mode: AlphaMode
    opacity: Parameter | None
    relief: ReliefLayout
    light_map: Parameter | None
    selection: Parameter | None
    lookups: tuple[LookupLayout, ...]
    pictures: tuple[PictureLayout, ...]
    tables: tuple[str, ...]
    streaked: bool

    @property
    def has_holes(self) -> bool:
        """Whether not all of the mesh may be there."""
        return self.alpha_mode != "opaque" or self.selection is not None

    @property
    def samplers(self) -> tuple[str, ...]:
        """The names of the texture units in the program."""
        maps = len(self.pictures) - len(self.tables)
        return (*(f"picture_{index}" for index in range(maps)), *self.tables)
