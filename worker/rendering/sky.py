"""The light from all around, as the chunks of shaders/skies read it.

What is blurred is made by texture techniques, as anyone could ask for it, and kept by content.
"""

import hashlib
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from api_schemas.environment import Environment
from api_schemas.families import Meaning, TextureSpec
from api_schemas.language import FAMILIES
from api_schemas.layouts.cube import CubeSpec
from api_schemas.layouts.hemispheres import HemispheresSpec
from api_schemas.layouts.latlong import LatlongSpec
from api_schemas.sky import SKY_ROUGHNESS, SkyTextures, sky_textures
from api_schemas.textures.image import ImageSpec
from worker import layouts
from worker.errors import RenderError
from worker.images.image import Image
from worker.images.mending import mended
from worker.images.pyramids import mip_chain
from worker.rendering.cache import ByteCache
from worker.rendering.calls import choice
from worker.rendering.cube_textures import CubeTexture, faces_in
from worker.rendering.gl_context import GL
from worker.rendering.programs import Program
from worker.rendering.samplers import SamplerCache, Sampling
from worker.rendering.shading_layout import SkyKind
from worker.rendering.sky_harmonics import comes_from_below, harmonics_in
from worker.rendering.sky_lamps import lamps_of
from worker.rendering.texture_maker import TextureMaker
from worker.rendering.textures import Texture

if TYPE_CHECKING:
    from api_schemas.surface_spec import SurfaceSpec

CUBES_BYTES_MAX = 64 << 20
_UNITS = {"sky_picture": 23, "sky_rough": 24, "sky_matt": 25, "sky_lamps": 23}
"""Below those of lights; a scene with an environment has room for that many maps less."""

_SAMPLING = Sampling(wrap=("repeat", "clamp"), smooth=True, levels=True)
Maker = Callable[[TextureSpec, Meaning], Image]


@dataclass(frozen=True, slots=True)
class Sky:
    """An environment in OpenGL.

    Attributes:
        kind: Which chunk reads it.
        picture: As it is, with its mip levels.
        rough: As rough mirrors see it, a level for each of SKY_ROUGHNESS.
        matt: Irradiance over pi.
        uniforms: What else the chunk wants to know.
        from_below: Whether its light does, as in a picture that is stored upside down.
        lamps: The same light as lamps, where surfaces add it up: directions over irradiances.
    """

    kind: SkyKind
    picture: Texture | CubeTexture
    rough: CubeTexture
    matt: CubeTexture
    uniforms: Mapping[str, Any]
    from_below: bool = False
    lamps: Texture | None = None

    def kind_for(self, technique: str) -> SkyKind:
        """Return the chunk by which a surface reads it."""
        return "lamps" if self.lamps is not None and _sums_sky(technique) else self.kind

    def bind(self, program: Program, samplers: SamplerCache) -> None:
        """Give the bound program the environment, as far as it wants it."""
        for name, value in self.uniforms.items():
            if name in program.uniforms:
                program.set(name, value)
        if self.lamps is not None and "sky_lamps" in program.uniforms:
            program.set("sky_lamp_count", self.lamps.width)
        for name, unit in _UNITS.items():
            texture = getattr(self, name.removeprefix("sky_"))
            if texture is None or name not in program.uniforms:
                continue
            program.set(name, unit)
            flat = isinstance(texture, Texture)
            GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
            GL.glBindTexture(GL.GL_TEXTURE_2D if flat else GL.GL_TEXTURE_CUBE_MAP, texture.number)
            GL.glBindSampler(unit, samplers.get(_SAMPLING, (0.0,) * 4) if flat else 0)


@dataclass(frozen=True, slots=True)
class _Matt:
    """Irradiance over pi: a cube, and the nine numbers that hold it where it is so smooth."""

    cube: CubeTexture
    uniforms: Mapping[str, Any]
    from_below: bool


class Skies:
    """Keeps the environments of earlier scenes, by content."""

    def __init__(self) -> None:
        """Begin with nothing in OpenGL."""
        self._cubes = ByteCache[CubeTexture](CUBES_BYTES_MAX, CubeTexture.delete)
        self._matt = ByteCache[_Matt](CUBES_BYTES_MAX, lambda matt: matt.cube.delete())
        self._pictures = ByteCache[Texture](CUBES_BYTES_MAX, Texture.delete)

    def sky(self, spec: Environment, maker: TextureMaker) -> Sky:
        """Make or find what a scene's environment needs.

        Raises:
            WorkerError: A texture cannot be made, or has numbers that are refused.
        """
        if spec.broken_texels == "refuse":
            _look_for_broken(spec, maker)
        textures = sky_textures(spec)
        uniforms: dict[str, Any] = {
            "sky_from_world": turned(spec.rotation_y),
            "sky_intensity": spec.intensity,
        }
        picture: Texture | CubeTexture
        if isinstance(spec.layout, LatlongSpec):
            proportion = spec.layout.proportion
            picture = self._pictures.get(
                spec.texture.model_dump_json(),
                lambda: _flat(maker.picture(spec.texture, "colour", proportion).pixels),
            )
            uniforms["sky_centre"] = choice(spec.layout, "centre")
        else:
            assert textures.whole is not None
            picture = self._cube(textures.whole, maker.picture, sharp_levels)
        kind: SkyKind = "latlong" if isinstance(picture, Texture) else "cube"
        sky = self._blurred(kind, picture, textures, uniforms, maker.picture)
        if spec.gathered == "prefiltered":
            return sky
        name = f"lamps {spec.layout.model_dump_json()} {spec.texture.model_dump_json()}"
        return replace(sky, lamps=self._pictures.get(name, lambda: _lamps(spec, maker)))

    def rendered_sky(
        self, picture: NDArray[np.float32], layout: CubeSpec | HemispheresSpec, maker: TextureMaker
    ) -> Sky:
        """Make or find the same of a picture (height, width, 3) of a scene, as SKY_CUBE or discs.

        Raises:
            WorkerError: A texture cannot be made.
        """
        light, _ = mended(np.ascontiguousarray(picture))
        name = hashlib.sha256(repr(light.shape).encode() + light.tobytes()).hexdigest()
        image = ImageSpec(technique="image", asset=name, encoding="linear")
        spec = Environment(texture=image, layout=layout)
        rendered = {name: Image(light, "colour")}

        def made(texture: TextureSpec, meaning: Meaning) -> Image:
            return maker.picture(texture, meaning, (1, 1), rendered)

        sharp: Texture | CubeTexture
        if isinstance(layout, CubeSpec):
            sharp = self._cubes.get(name, lambda: _uploaded(sharp_levels(light)))
        else:
            sharp = self._pictures.get(name, lambda: _flat(layouts.filled(layout, light)))
        uniforms = {"sky_from_world": np.eye(3), "sky_intensity": 1.0}
        return self._blurred(layout.technique, sharp, sky_textures(spec), uniforms, made)

    def _blurred(
        self,
        kind: SkyKind,
        picture: Texture | CubeTexture,
        textures: SkyTextures,
        uniforms: Mapping[str, Any],
        maker: Maker,
    ) -> Sky:
        matt = self._matt.get(
            textures.matt.model_dump_json(),
            lambda: _matt(maker(textures.matt, "colour").pixels, textures.matt.method),
        )
        return Sky(
            kind,
            picture,
            self._cube(textures.rough, maker, _panels),
            matt.cube,
            {**uniforms, **matt.uniforms},
            matt.from_below,
        )

    def trim(self) -> None:
        """Free what exceeds the bounds; call it when nothing is being drawn."""
        self._cubes.trim()
        self._matt.trim()
        self._pictures.trim()

    def _cube(
        self,
        spec: TextureSpec,
        maker: Maker,
        levels: Callable[[NDArray[np.float32]], list[NDArray[np.float32]]],
    ) -> CubeTexture:
        return self._cubes.get(
            spec.model_dump_json(), lambda: _uploaded(levels(maker(spec, "colour").pixels))
        )


def _look_for_broken(spec: Environment, maker: TextureMaker) -> None:
    pixels = maker.picture(spec.texture, "colour", spec.layout.proportion).pixels
    _, count = mended(pixels[..., : 3 if pixels.shape[2] >= 3 else 1])
    if count:
        message = f"{count} numbers of the environment are infinite or no numbers"
        raise RenderError(message, "/scene/environment/texture", code="environment_texels")


def turned(angle: float) -> NDArray[np.float64]:
    """Return the rotation (3, 3) from the world to an environment turned by an angle round y."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]])


def sharp_levels(column: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Return faces, and their mip levels, of a column of six."""
    chains = [mip_chain(face) for face in faces_in(column)]
    return [np.stack(faces) for faces in zip(*chains, strict=True)]


def _panels(pixels: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    """Cut the pictures that stand on each other, each half as large, into faces."""
    height, width = pixels.shape[0] // 2, pixels.shape[1]
    levels, top = [], 0
    for index in range(len(SKY_ROUGHNESS)):
        rows, columns = height >> index, width >> index
        levels.append(faces_in(np.ascontiguousarray(pixels[top : top + rows, :columns])))
        top += rows
    return levels


def _matt(column: NDArray[np.float32], method: str) -> tuple[_Matt, int]:
    smooth = method == "harmonics"
    numbers = harmonics_in(column) if smooth else np.zeros((9, 3))
    cube, size = _uploaded([faces_in(column)])
    uniforms = {"sky_matt_smooth": smooth, "sky_harmonics": numbers}
    return _Matt(cube, uniforms, comes_from_below(column)), size


def _lamps(spec: Environment, maker: TextureMaker) -> tuple[Texture, int]:
    pixels = maker.picture(spec.texture, "colour", spec.layout.proportion).pixels
    table = np.stack(lamps_of(pixels, spec.layout)).astype(np.float32)
    texture = Texture.upload([table], "colour")
    return texture, texture.size_bytes


def _sums_sky(technique: str) -> bool:
    return cast("type[SurfaceSpec]", FAMILIES["surfaces"][technique]).sums_sky


def _flat(pixels: NDArray[np.float32]) -> tuple[Texture, int]:
    light, _ = mended(pixels[..., : 3 if pixels.shape[2] >= 3 else 1])
    texture = Texture.upload(mip_chain(light), "colour")
    return texture, texture.size_bytes


def _uploaded(levels: list[NDArray[np.float32]]) -> tuple[CubeTexture, int]:
    cube = CubeTexture.upload(levels)
    return cube, cube.size_bytes
