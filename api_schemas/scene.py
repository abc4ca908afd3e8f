"""A scene: a camera, lights, and a tree of nodes that carry meshes."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from api_schemas.base import Schema
from api_schemas.camera import Camera
from api_schemas.environment import Environment, Surroundings
from api_schemas.lights import LIGHTS_MAX, Light
from api_schemas.maps import MappableColor
from api_schemas.meshes import Mesh
from api_schemas.relief import Displacement
from api_schemas.surface_maps import SurfaceMap
from api_schemas.surface_spec import Surface
from api_schemas.transforms import Placement, Transform

NODES_MAX = 1024
"""Nodes of one scene."""


class Node(Schema):
    """A place in the scene; what hangs below it moves with it."""

    name: Annotated[str, Field(max_length=64)] | None = Field(
        default=None, description="A word for people and for reports."
    )
    transform: Transform = Field(
        default=Placement(), description="Where the node stands in its parent's frame."
    )
    mesh: Mesh | None = Field(default=None, description="The shape drawn here.")
    surface: Surface | None = Field(
        default=None,
        description="How the shape reflects light; without one a model has its own materials, and "
        "everything else is matt grey Phong.",
    )
    surface_map: SurfaceMap | None = Field(
        default=None,
        description="Several surfaces on one shape, and a picture that says which one is where; in "
        "the place of surface.",
    )
    casts_shadows: bool = Field(
        default=True, description="Whether its own mesh keeps light from what is behind it."
    )
    displacement: Displacement | None = Field(
        default=None, description="A relief that moves the shape's own points, outlines included."
    )
    surroundings: Surroundings | None = Field(
        default=None,
        description="Lets its own mesh mirror, and be lit by, the rest of the scene as it is seen "
        "from the mesh's middle, in the place of the environment alone.",
    )
    children: Annotated[list[Node], Field(max_length=NODES_MAX)] = Field(
        default=[], description="Nodes that move with this one."
    )


class Scene(Schema):
    """Everything a picture is made of."""

    camera: Camera | None = Field(
        default=None,
        description="The eye; without one, the first camera that a model brings, else one that "
        "sees everything.",
    )
    lights: Annotated[list[Light], Field(max_length=LIGHTS_MAX)] | None = Field(
        default=None,
        description="What shines: nothing if empty, so that only emission and unlit surfaces show. "
        "Without the list, the lights that models bring, else, where there is no environment, "
        "those of a studio: a lamp over the eye's shoulder in a bright room.",
    )
    background: MappableColor | None = Field(
        default=None,
        description="What is seen where nothing is: a linear colour, or a picture over the whole "
        "width and height, read once for each pixel; transparent without, and where the picture "
        "is. Layers do not show it.",
    )
    environment: Environment | None = Field(
        default=None,
        description="The light from all around: it shines on what is there, and is seen in mirrors "
        "and behind everything.",
    )
    nodes: Annotated[list[Node], Field(max_length=NODES_MAX)] = Field(description="What is there.")
