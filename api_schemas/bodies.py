"""What a mesh is to an estimate: so many triangles round a middle, whoever made them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from api_schemas.assets import AssetFacts, ImageFacts, ModelFacts
from api_schemas.cost import Cost
from api_schemas.geometry import Vector3
from api_schemas.meshes import Mesh
from api_schemas.model_mesh import ModelMesh
from api_schemas.relief import Displacement
from api_schemas.surface_spec import SurfaceSpec

SECONDS_PER_TRIANGLE = 4e-7
BYTES_PER_TRIANGLE = 200
SECONDS_PER_DISPLACED_TRIANGLE = 8e-6
BYTES_PER_DISPLACED_TRIANGLE = 900
SECONDS_PER_FRAMED_TRIANGLE = 6e-6
BYTES_PER_FRAMED_TRIANGLE = 750
SECONDS_PER_READ_VERTEX = 1e-6
BYTES_PER_READ_VERTEX = 250
SECONDS_PER_TEXEL = 1e-7
BYTES_PER_TEXEL = 64
BYTES_PER_KEPT_TEXEL = 24
SHARE_OF_THE_LARGEST = 0.5
"""Pictures are decoded one after another; how large each one inside a model is, is not known."""


@dataclass(frozen=True, slots=True)
class Body:
    """One mesh.

    Attributes:
        key: Equal keys are made once.
        making: What that takes.
        pieces: Triangles, lines and points.
        draws: How many meshes with a material each these are.
        lights: How many lights it brings.
        cameras: How many cameras it brings.
        pictures: Whether its own materials wear pictures.
        middle: Of a ball that holds it, in its own frame.
        reach: That ball's radius.
    """

    key: str
    making: Cost
    pieces: int
    draws: int
    lights: int
    cameras: int
    pictures: bool
    middle: Vector3
    reach: float


def body(mesh: Mesh, facts: Mapping[str, AssetFacts]) -> Body | None:
    """Return what an estimate needs to know of a mesh; nothing of a model without facts."""
    if not isinstance(mesh, ModelMesh):
        count = mesh.triangles
        return Body(
            key=mesh.model_dump_json(),
            making=Cost(count * SECONDS_PER_TRIANGLE, count * BYTES_PER_TRIANGLE),
            pieces=count,
            draws=1,
            lights=0,
            cameras=0,
            pictures=False,
            middle=(0, 0, 0),
            reach=mesh.reach,
        )
    found = facts.get(mesh.asset)
    if not isinstance(found, ModelFacts):
        return None
    beside = [facts.get(asset) for asset in mesh.files.values()]
    pictures = [item.width * item.height for item in beside if isinstance(item, ImageFacts)]
    texels = found.texels + sum(pictures)
    pieces = found.triangles + found.lines + found.points
    at_once = max([SHARE_OF_THE_LARGEST * found.texels, *pictures])
    low, high = found.bounds_min or [0.0] * 3, found.bounds_max or [0.0] * 3
    return Body(
        key=f"{mesh.asset} {sorted(mesh.files.items())} {mesh.scene}",
        making=Cost(
            pieces * SECONDS_PER_TRIANGLE
            + found.vertices * SECONDS_PER_READ_VERTEX
            + texels * SECONDS_PER_TEXEL,
            float(
                pieces * BYTES_PER_TRIANGLE
                + found.vertices * BYTES_PER_READ_VERTEX
                + texels * BYTES_PER_KEPT_TEXEL
                + at_once * BYTES_PER_TEXEL
            ),
        ),
        pieces=pieces,
        draws=found.draws,
        lights=found.lights,
        cameras=len(found.cameras),
        pictures=texels > 0,
        middle=(
            low[0] / 2 + high[0] / 2,
            low[1] / 2 + high[1] / 2,
            low[2] / 2 + high[2] / 2,
        ),
        reach=math.dist(low, high) / 2,
    )


def framed(found: Body, surfaces: Sequence[SurfaceSpec]) -> Cost:
    """Return what it takes to know where u and v grow on a mesh, and where nothing says so."""
    wanted = any(
        surface.needs_tangents
        or surface.bump is not None
        or (surface.normal is not None and surface.normal.space == "tangent")
        for surface in surfaces
    )
    pieces = found.pieces if wanted else 0
    return Cost(pieces * SECONDS_PER_FRAMED_TRIANGLE, float(pieces * BYTES_PER_FRAMED_TRIANGLE))


def displaced(found: Body, spec: Displacement | None) -> Body:
    """Return what a mesh becomes by a displacement, whose values are taken to be from 0 to 1."""
    if spec is None:
        return found
    pieces = spec.triangles(found.pieces)
    work = Cost(
        pieces * SECONDS_PER_DISPLACED_TRIANGLE, float(pieces * BYTES_PER_DISPLACED_TRIANGLE)
    )
    moved = abs(spec.depth) * max(abs(spec.middle), abs(1 - spec.middle))
    return replace(
        found,
        key=f"{found.key} {spec.model_dump_json()}",
        making=found.making + work,
        pieces=pieces,
        reach=found.reach + moved,
    )
