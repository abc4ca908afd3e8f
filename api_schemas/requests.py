"""The bodies people send."""

from typing import Annotated, Literal

from pydantic import Field

from api_schemas.base import Schema
from api_schemas.maps import COLOUR
from api_schemas.members import Texture
from api_schemas.output import RenderOutput, TextureOutput
from api_schemas.scene import Scene

Priority = Literal["interactive", "batch"]
Kind = Literal["texture", "render"]


class _Request(Schema):
    priority: Priority = Field(
        default="interactive", description="Whether somebody waits; batch work comes after."
    )


class TextureRequest(_Request):
    """A texture to be made."""

    texture: Annotated[Texture, COLOUR] = Field(description="What the picture shows.")
    output: TextureOutput = Field(default=TextureOutput(), description="The file to be made.")


class RenderRequest(_Request):
    """A scene to be rendered."""

    scene: Scene = Field(description="What the picture shows.")
    output: RenderOutput = Field(default=RenderOutput(), description="The file to be made.")


Request = TextureRequest | RenderRequest
REQUESTS: dict[Kind, type[TextureRequest] | type[RenderRequest]] = {
    "texture": TextureRequest,
    "render": RenderRequest,
}
"""The body of each kind of job."""

for _model in REQUESTS.values():
    # Schemas are built when first used; the first caller should not be the one to wait for it
    _model.model_rebuild()
