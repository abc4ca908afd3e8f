"""An uploaded model as the worker holds it: everything placed in the model's own frame."""

from collections.abc import Mapping
from dataclasses import dataclass

from api_schemas.camera import PosedCamera
from api_schemas.lights import Light
from api_schemas.surface_spec import SurfaceSpec
from worker.geometry.mesh import Mesh
from worker.geometry.transforms import Matrix


@dataclass(frozen=True, slots=True)
class Part:
    """One mesh with one material at one place.

    Attributes:
        mesh: In the frame of its node.
        matrix: model_from_node.
        node: Index of the node that carries it, where the format has nodes.
        material: Index of its material, if it has one.
        key: Equal keys within a model mean the same mesh.
    """

    mesh: Mesh
    matrix: Matrix
    node: int | None
    material: int | None
    key: str


@dataclass(frozen=True, slots=True)
class NamedSurface:
    """A material; the name is empty where the file gives none.

    Its ImageSpecs name pictures by the SHA-256 of their bytes.
    """

    name: str
    surface: SurfaceSpec


@dataclass(frozen=True, slots=True)
class NamedCamera:
    """A camera whose pose is a matrix in the model's frame."""

    name: str
    camera: PosedCamera


@dataclass(frozen=True, slots=True)
class Model:
    """Everything an uploaded model brings.

    Attributes:
        parts: What is drawn.
        node_names: By index; empty where the file gives none.
        surfaces: Materials by index.
        cameras: By index.
        lights: In the model's frame.
        pictures: Encoded picture files by the SHA-256 of their bytes.
        warnings: What the file asks for and does not get.
    """

    parts: tuple[Part, ...]
    node_names: tuple[str, ...]
    surfaces: tuple[NamedSurface, ...]
    cameras: tuple[NamedCamera, ...]
    lights: tuple[Light, ...]
    pictures: Mapping[str, bytes]
    warnings: tuple[str, ...]

    @property
    def triangles(self) -> int:
        """How many it draws."""
        solid = (part.mesh for part in self.parts if part.mesh.kind == "triangles")
        return sum(len(mesh.triangles) for mesh in solid)

    @property
    def size_bytes(self) -> int:
        """What its meshes and pictures occupy."""
        meshes = {part.key: part.mesh for part in self.parts}
        held = sum(mesh.size_bytes for mesh in meshes.values())
        return held + sum(len(picture) for picture in self.pictures.values())
