"""Textures in OpenGL memory that outlive a scene, by what they show."""

from functools import partial

from api_schemas.families import LayoutSpec, Meaning, TextureSpec
from api_schemas.layouts.cube import CubeSpec
from worker.errors import RenderError
from worker.images.pyramids import Cut, mip_chain
from worker.images.relief import Preparation, prepared
from worker.images.stored_form import BOX, StoredForm, stored
from worker.images.volume_pyramids import volume_chain
from worker.layouts import filled
from worker.layouts.cube import faces_of_opengl
from worker.rendering.cache import ByteCache
from worker.rendering.closed_forms import Formula, formula
from worker.rendering.lookups import TextureSource
from worker.rendering.texture_maker import TextureMaker
from worker.rendering.textures import Texture


class TextureStore:
    """Keeps textures within a bound of bytes."""

    def __init__(self, bytes_max: int) -> None:
        """Begin empty; so many bytes may stay after a scene is drawn."""
        self._kept = ByteCache[Texture](bytes_max, Texture.delete)

    def source(self, maker: TextureMaker) -> TextureSource:
        """Return a source of textures that are kept or that a maker makes."""
        return _Source(self._kept, maker)

    def trim(self) -> None:
        """Free what exceeds the bound; call it when nothing is being drawn."""
        self._kept.trim()


class _Source:
    def __init__(self, kept: ByteCache[Texture], maker: TextureMaker) -> None:
        self._kept = kept
        self._maker = maker

    def __call__(
        self,
        spec: TextureSpec,
        meaning: Meaning,
        *,
        levels: bool,
        cut: Cut | None = None,
        preparation: Preparation | None = None,
        layout: LayoutSpec | None = None,
        form: StoredForm = BOX,
    ) -> Texture:
        cut = cut if levels or form.kind == "ripmap" else None
        form = form if levels or form.is_table else BOX
        holding = None if layout is None or layout.whole else layout
        key = (spec.model_dump_json(), meaning, levels, cut, preparation, holding, form)

        def make() -> tuple[Texture, int]:
            image = prepared(self._maker(spec, meaning), preparation)
            pixels = image.pixels if holding is None else filled(holding, image.pixels)
            chain = stored(pixels, form, levels=levels, cut=cut)
            return _sized(Texture.upload(chain, image.meaning, (image.height, image.width)))

        return self._kept.get(key, make)

    def volume(self, spec: TextureSpec, meaning: Meaning, *, levels: bool) -> Texture:
        key = (spec.model_dump_json(), meaning, levels, "volume")

        def make() -> tuple[Texture, int]:
            volume = self._maker.volume(spec, meaning)
            chain = volume_chain(volume.voxels) if levels else [volume.voxels]
            return _sized(Texture.upload_volume(chain, volume.meaning))

        return self._kept.get(key, make)

    def cube(
        self, spec: TextureSpec, meaning: Meaning, layout: CubeSpec, *, levels: bool
    ) -> Texture:
        key = (spec.model_dump_json(), meaning, levels, layout.model_dump_json())
        return self._kept.get(key, partial(self._cube, spec, meaning, layout, levels))

    def formula(
        self, spec: TextureSpec, meaning: Meaning, name: str, *, solid: bool
    ) -> Formula | None:
        form = self._maker.closed_form(spec, solid=solid, meaning=meaning)
        return None if form is None else formula(form, name)

    def _cube(
        self, spec: TextureSpec, meaning: Meaning, layout: CubeSpec, levels: bool
    ) -> tuple[Texture, int]:
        image = self._maker.picture(spec, meaning, layout.proportion)
        columns, rows = layout.proportion
        if image.width * rows != image.height * columns or image.width % columns:
            raise RenderError(
                f"a picture of {image.width} x {image.height} has no {columns} x {rows} faces",
                code="layout_mismatch",
            )
        faces = faces_of_opengl(layout, image.pixels)
        chains = [mip_chain(face) if levels else [face] for face in faces]
        return _sized(Texture.upload_cube(chains, image.meaning))


def _sized(texture: Texture) -> tuple[Texture, int]:
    return texture, texture.size_bytes
