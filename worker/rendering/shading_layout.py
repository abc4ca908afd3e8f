"""What decides a surface's program: everything the compiler must know, and nothing else."""

from dataclasses import dataclass

from api_schemas.families import AlphaMode
from api_schemas.maps import Filter
from worker.rendering.calls import Call
from worker.rendering.samplers import Sampling
from worker.rendering.textures import TextureFormat


@dataclass(frozen=True, slots=True)
class Parameter:
    """One field of a surface. `lookup` is the index of the lookup it is read from, if mapped."""

    name: str
    type: str
    lookup: int | None


@dataclass(frozen=True, slots=True)
class LookupLayout:
    """One reading of a picture; parameters that share a lookup cost one.

    Attributes:
        calls: Which say where: that of the coordinates, then that of the layout, if there is one.
        filter: How texels become a pixel.
        picture: Which unit is read.
    """

    calls: tuple[Call, ...]
    filter: Filter
    picture: int


@dataclass(frozen=True, slots=True)
class PictureLayout:
    """A texture unit: how it is read, and what the JIT knows about the texture."""

    sampling: Sampling
    format: TextureFormat


@dataclass(frozen=True, slots=True)
class ShadingLayout:
    """What decides a program; equal layouts share a program object.

    Attributes:
        technique: The surface's.
        parameters: In the order of its struct.
        alpha_mode: Whether opacity is ignored, cuts holes, or lets through what is behind.
        opacity: How it is read, unless it is ignored.
        normal: The lookup that tilts the normal, if there is a normal map.
        lookups: Readings of pictures.
        pictures: Texture units of maps, then of tables.
        tables: What the surface's own tables are called.
    """

    technique: str
    parameters: tuple[Parameter, ...]
    alpha_mode: AlphaMode
    opacity: Parameter | None
    normal: int | None
    lookups: tuple[LookupLayout, ...]
    pictures: tuple[PictureLayout, ...]
    tables: tuple[str, ...]

    @property
    def samplers(self) -> tuple[str, ...]:
        """The names of the texture units in the program."""
        maps = len(self.pictures) - len(self.tables)
        return (*(f"picture_{index}" for index in range(maps)), *self.tables)
