"""The eye: a projection and where it stands. It looks along its own -z with y up, as in glTF."""

from typing import Annotated, Literal

from pydantic import Field, Tag

from api_schemas.base import Length, Schema, Vector
from api_schemas.model_mesh import Part
from api_schemas.transforms import MatrixPlacement, by_key


class LookAt(Schema):
    """Stand here, look there."""

    eye: Vector = Field(description="Where the camera is.")
    target: Vector = Field(
        default=[0.0, 0.0, 0.0], description="What is in the middle of the picture."
    )
    up: Vector = Field(default=[0.0, 1.0, 0.0], description="What points upwards in the picture.")


Pose = Annotated[
    Annotated[LookAt, Tag("without matrix")] | Annotated[MatrixPlacement, Tag("with matrix")],
    by_key("matrix"),
]


class _Camera(Schema):
    pose: Pose = Field(description="Where the camera stands: eye, target and up, or its matrix.")
    near: Length = Field(default=0.05, description="Nothing nearer than this is drawn.")
    far: Length = Field(default=1000.0, description="Nothing farther than this is drawn.")


class PerspectiveCamera(_Camera):
    """Far things are small."""

    type: Literal["perspective"]
    fov_y: Annotated[float, Field(ge=0.001, le=3.1)] = Field(
        default=0.8, description="Angle in radians from the lower to the upper edge of the picture."
    )


class OrthographicCamera(_Camera):
    """Parallel lines stay parallel."""

    type: Literal["orthographic"]
    height: Length = Field(
        default=2.0, description="World units from the lower to the upper edge of the picture."
    )


class FramedCamera(Schema):
    """Looks at everything there is from one side, as near as it can."""

    type: Literal["framed"]
    direction: Vector = Field(
        default=[0.5, 0.4, 1.0],
        description="Towards the camera, which looks the other way and comes as near as it can.",
    )
    up: Vector = Field(default=[0.0, 1.0, 0.0], description="What points upwards in the picture.")
    fov_y: Annotated[float, Field(ge=0.001, le=3.1)] = Field(
        default=0.8, description="Angle in radians from the lower to the upper edge of the picture."
    )
    margin: Annotated[float, Field(ge=0, le=10)] = Field(
        default=0.05,
        description="Free space round the scene, as a part of its size in the picture.",
    )


class ModelCamera(Schema):
    """A camera that an uploaded model of the scene brings."""

    type: Literal["model"]
    camera: Part | None = Field(
        default=None, description="Which one, by name or by index; the first one without."
    )


PosedCamera = PerspectiveCamera | OrthographicCamera
"""A camera that says itself where it stands."""

Camera = Annotated[PosedCamera | FramedCamera | ModelCamera, Field(discriminator="type")]
