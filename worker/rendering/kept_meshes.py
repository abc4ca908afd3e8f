"""Meshes in OpenGL memory that outlive a scene, and where maps have no direction on them."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from worker.geometry.frames import framed
from worker.geometry.singularities import singularities
from worker.rendering.cache import ByteCache
from worker.rendering.placing import Placed
from worker.rendering.relief_shading import TangentsWanted, tangents_wanted
from worker.rendering.vertex_arrays import VertexArray

MESH_BYTES_MAX = 64 << 20


@dataclass(frozen=True, slots=True)
class KeptMesh:
    """A mesh in OpenGL.

    Attributes:
        mesh: What is drawn.
        frames: Where normal and bump maps have no direction on it, if it wears any; JSON-able.
    """

    mesh: VertexArray
    frames: Mapping[str, Any] | None


class MeshCache:
    """Keeps meshes of earlier scenes, by content and by the tangents that they need."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._kept = ByteCache[KeptMesh](MESH_BYTES_MAX, lambda kept: kept.mesh.delete())

    def get(self, item: Placed, tangents: bool) -> KeptMesh:
        """Return a mesh, made and uploaded if it is not kept.

        Args:
            item: What is to be drawn.
            tangents: Whether it needs tangents even if its surface does not.

        Raises:
            WorkerError: It cannot be made.
        """
        asked = tangents_wanted(item.surface)
        wanted = asked or (TangentsWanted(0, item.surface.tangents) if tangents else None)

        def make() -> tuple[KeptMesh, int]:
            mesh = item.mesh()
            told = None
            if asked is not None and mesh.kind == "triangles" and mesh.triangles.size:
                told = asdict(asked) | dict(singularities(mesh, asked.uv_set).as_report())
            if wanted is not None:
                mesh = framed(mesh, wanted.frames, wanted.uv_set)
            uploaded = VertexArray.upload(mesh)
            return KeptMesh(uploaded, told), uploaded.size_bytes

        return self._kept.get((item.key, wanted, asked is None), make)

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._kept.trim()


def frames_report(placed: Sequence[Placed], kept: Sequence[KeptMesh]) -> dict[str, Any]:
    """Tell of each object, by its object_id, that normal or bump maps lie on."""
    frames = [
        {"object": item.thing, **found.frames}
        for item, found in zip(placed, kept, strict=True)
        if found.frames is not None
    ]
    return {"frames": frames} if frames else {}
