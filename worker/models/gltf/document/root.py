"""The document as a whole."""

import re
from typing import Annotated, Any, Self

from pydantic import Field, ValidationError, model_validator
from pydantic.alias_generators import to_camel

from worker.errors import UnusableAssetError
from worker.models.gltf.document.base import GltfObject, Index, Words
from worker.models.gltf.document.data import Accessor, Buffer, BufferView
from worker.models.gltf.document.materials import Material
from worker.models.gltf.document.meshes import Mesh, Skin
from worker.models.gltf.document.pictures import Image, Sampler, Texture
from worker.models.gltf.document.scene import Camera, Lights, Node, Scene
from worker.models.gltf.faults import spoken, too_large, unusable
from worker.models.gltf.limits import ACCESSORS_MAX, ITEMS_MAX

_VERSION = re.compile(r"([0-9]{1,6})\.([0-9]{1,6})")


class Asset(GltfObject):
    """Which glTF it is."""

    version: Annotated[str, Field(pattern=rf"^{_VERSION.pattern}$")]
    min_version: Annotated[str, Field(pattern=rf"^{_VERSION.pattern}$")] | None = None

    @model_validator(mode="after")
    def _is_known(self) -> Self:
        version = _numbers(self.version)
        if version[0] != 2:
            raise ValueError("the version is not 2")
        if self.min_version is not None and _numbers(self.min_version) > version:
            raise ValueError("minVersion is more than version")
        return self


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split("."))


class DocumentExtensions(GltfObject):
    """The extensions of the document that are read."""

    lights: Annotated[Lights | None, Field(alias="KHR_lights_punctual")] = None


class Document(GltfObject):
    """All of a glTF file's JSON that matters to a picture at rest."""

    asset: Asset
    extensions_used: Words = Field(default=[])
    extensions_required: Words = Field(default=[])
    accessors: list[Accessor] = Field(default=[], min_length=1)
    animations: list[dict[str, Any]] = Field(default=[], min_length=1)
    buffers: list[Buffer] = Field(default=[], min_length=1)
    buffer_views: list[BufferView] = Field(default=[], min_length=1)
    cameras: list[Camera] = Field(default=[], min_length=1)
    images: list[Image] = Field(default=[], min_length=1)
    materials: list[Material] = Field(default=[], min_length=1)
    meshes: list[Mesh] = Field(default=[], min_length=1)
    nodes: list[Node] = Field(default=[], min_length=1)
    samplers: list[Sampler] = Field(default=[], min_length=1)
    scene: Index | None = None
    scenes: list[Scene] = Field(default=[], min_length=1)
    skins: list[Skin] = Field(default=[], min_length=1)
    textures: list[Texture] = Field(default=[], min_length=1)
    extensions: DocumentExtensions = DocumentExtensions()

    @model_validator(mode="after")
    def _scene_has_scenes(self) -> Self:
        if self.scene is not None and self.scene >= len(self.scenes):
            raise ValueError("scene is not one of scenes")
        return self


def read_document(value: dict[str, Any]) -> Document:
    """Validate a document's types, ranges and shapes.

    Raises:
        UnusableAssetError: `asset_unusable`, with the place of the first mistake; `asset_too_large`
            for too many things of one kind.
    """
    for name in Document.model_fields:
        items = value.get(to_camel(name))
        most = ACCESSORS_MAX if name in ("accessors", "buffer_views") else ITEMS_MAX
        if isinstance(items, list) and len(items) > most:
            raise too_large(f"/{to_camel(name)}", f"{len(items)} items; at most {most} are taken")
    try:
        return Document.model_validate(value)
    except ValidationError as error:
        raise _told(error) from None


def _told(error: ValidationError) -> UnusableAssetError:
    first = error.errors(include_url=False, include_context=False, include_input=False)[0]
    place = "".join(f"/{part if isinstance(part, int) else spoken(part)}" for part in first["loc"])
    what = first["msg"].removeprefix("Value error, ")
    return unusable(place, what[:1].lower() + what[1:])
