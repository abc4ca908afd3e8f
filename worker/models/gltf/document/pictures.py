"""Pictures, how they are sampled, and where materials refer to them."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from worker.models.gltf.document.base import (
    Code,
    Fraction,
    GltfObject,
    Index,
    Named,
    Real,
    Reals2,
)


class Image(Named):
    """A picture file, beside the asset, in a data URI or in a buffer view."""

    uri: str | None = None
    mime_type: str | None = None
    buffer_view: Index | None = None

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        if (self.uri is None) == (self.buffer_view is None):
            raise ValueError("exactly one of uri and bufferView is needed")
        if self.buffer_view is not None and self.mime_type is None:
            raise ValueError("bufferView needs a mimeType")
        return self


class Sampler(Named):
    """How a picture is read between and beyond its texels, as OpenGL's numbers."""

    mag_filter: Code | None = None
    min_filter: Code | None = None
    wrap_s: Code = 10497
    wrap_t: Code = 10497


class Texture(Named):
    """A picture with a sampler."""

    sampler: Index | None = None
    source: Index | None = None


class TextureTransform(GltfObject):
    """KHR_texture_transform."""

    offset: Reals2 = Field(default=[0.0, 0.0])
    rotation: Real = 0.0
    scale: Reals2 = Field(default=[1.0, 1.0])
    tex_coord: Index | None = None


class TextureInfoExtensions(GltfObject):
    """The extensions of a reference to a texture that are read."""

    transform: Annotated[TextureTransform | None, Field(alias="KHR_texture_transform")] = None


class TextureInfo(GltfObject):
    """A reference to a texture."""

    index: Index
    tex_coord: Index = 0
    extensions: TextureInfoExtensions = TextureInfoExtensions()

    @property
    def uv_set(self) -> int:
        """Which of the mesh's texture coordinates it is read at."""
        transform = self.extensions.transform
        if transform is None or transform.tex_coord is None:
            return self.tex_coord
        return transform.tex_coord


class NormalTextureInfo(TextureInfo):
    """A tangent-space normal map; scale multiplies x and y."""

    scale: Real = 1.0


class OcclusionTextureInfo(TextureInfo):
    """How much ambient light arrives; strength fades the map in."""

    strength: Fraction = 1.0
