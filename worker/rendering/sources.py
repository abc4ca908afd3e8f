"""Where the renderer has its textures and models from: whoever calls it gives functions."""

from typing import Protocol

from api_schemas.families import Meaning, TextureSpec
from api_schemas.model_mesh import ModelMesh
from worker.images.image import Image
from worker.models.model import Model


class TextureMaker(Protocol):
    """Turns a texture of the language into a picture."""

    def __call__(self, spec: TextureSpec, meaning: Meaning, /) -> Image:
        """Return the picture, read as colour or as data."""


class ModelReader(Protocol):
    """Reads uploaded models."""

    def __call__(self, mesh: ModelMesh, /) -> Model:
        """Return the model."""
