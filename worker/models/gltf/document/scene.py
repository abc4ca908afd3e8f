"""Nodes, scenes, cameras and lights."""

import math
from typing import Annotated, Self

from pydantic import Field, model_validator

from worker.models.gltf.document.base import (
    Fractions3,
    GltfObject,
    Index,
    Indices,
    Named,
    NonNegativeReal,
    Real,
    Reals3,
    Reals16,
)
from worker.models.gltf.document.meshes import Weights

Positive = Annotated[float, Field(gt=0, le=3.4028234663852886e38)]
Rotation = Annotated[list[Annotated[float, Field(ge=-1, le=1)]], Field(min_length=4, max_length=4)]
_UNIT_TOLERANCE = 5e-3
"""How far a rotation may be from unit length: five times what eight-bit components cost."""


class Perspective(GltfObject):
    """Far things are small; without zfar there is no farthest."""

    yfov: Positive
    znear: Positive
    zfar: Positive | None = None
    aspect_ratio: Positive | None = None

    @model_validator(mode="after")
    def _far_is_beyond_near(self) -> Self:
        if self.zfar is not None and self.zfar <= self.znear:
            raise ValueError("zfar is not more than znear")
        return self


class Orthographic(GltfObject):
    """Parallel lines stay parallel."""

    xmag: Real
    ymag: Real
    zfar: Positive
    znear: NonNegativeReal

    @model_validator(mode="after")
    def _has_a_volume(self) -> Self:
        if self.zfar <= self.znear:
            raise ValueError("zfar is not more than znear")
        if self.xmag == 0 or self.ymag == 0:
            raise ValueError("xmag or ymag is zero")
        return self


class Camera(Named):
    """A projection; the node says where it stands."""

    type: str
    perspective: Perspective | None = None
    orthographic: Orthographic | None = None

    @model_validator(mode="after")
    def _one_projection(self) -> Self:
        given = {"perspective": self.perspective, "orthographic": self.orthographic}
        present = {name for name, projection in given.items() if projection is not None}
        if self.type in given and present != {self.type}:
            raise ValueError("it has not just the projection of its type")
        return self


class Spot(GltfObject):
    """The cone of a spot light: half angles in radians."""

    inner_cone_angle: Annotated[float, Field(ge=0, lt=math.pi / 2)] = 0.0
    outer_cone_angle: Annotated[float, Field(gt=0, le=math.pi / 2)] = math.pi / 4

    @model_validator(mode="after")
    def _outer_is_wider(self) -> Self:
        if self.outer_cone_angle <= self.inner_cone_angle:
            raise ValueError("outerConeAngle is not more than innerConeAngle")
        return self


class Light(Named):
    """A light of KHR_lights_punctual; the node says where it stands."""

    type: str
    color: Fractions3 = Field(default=[1.0, 1.0, 1.0])
    intensity: NonNegativeReal = 1.0
    range: Positive | None = None
    spot: Spot | None = None

    @model_validator(mode="after")
    def _spot_has_a_cone(self) -> Self:
        if self.type == "spot" and self.spot is None:
            raise ValueError("spot is missing")
        return self


class Lights(GltfObject):
    """KHR_lights_punctual of the document."""

    lights: Annotated[list[Light], Field(min_length=1)]


class LightReference(GltfObject):
    """KHR_lights_punctual of a node."""

    light: Index


class NodeExtensions(GltfObject):
    """The extensions of a node that are read."""

    light: Annotated[LightReference | None, Field(alias="KHR_lights_punctual")] = None


class Node(Named):
    """A place that moves with its parent, and what stands there."""

    camera: Index | None = None
    children: Indices | None = None
    skin: Index | None = None
    matrix: Reals16 | None = None
    mesh: Index | None = None
    rotation: Rotation | None = None
    scale: Reals3 | None = None
    translation: Reals3 | None = None
    weights: Weights | None = None
    extensions: NodeExtensions = NodeExtensions()

    @model_validator(mode="after")
    def _is_consistent(self) -> Self:
        placed = (self.rotation, self.scale, self.translation)
        if self.matrix is not None and any(part is not None for part in placed):
            raise ValueError("matrix stands beside translation, rotation or scale")
        if self.rotation is not None and abs(math.hypot(*self.rotation) - 1) > _UNIT_TOLERANCE:
            raise ValueError("rotation is not of unit length")
        if self.mesh is None and (self.skin is not None or self.weights is not None):
            raise ValueError("skin or weights need a mesh")
        return self


class Scene(Named):
    """Which trees of nodes are shown together."""

    nodes: Indices | None = None
