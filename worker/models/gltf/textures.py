"""From a reference to a texture to what the maps of our surfaces have in common."""

import math
from dataclasses import dataclass, field
from typing import Any, Final, Literal

from api_schemas.coordinates.uv import UvSpec
from api_schemas.families import Wrap
from api_schemas.maps import ColorMap, Filter, NormalMap, NumberMap, TextureTransform
from api_schemas.textures.image import ImageSpec
from worker.models.gltf.document import pictures as gltf
from worker.models.gltf.document.root import Document
from worker.models.gltf.resources import Picture

Channel = Literal["r", "g", "b", "a"]

_WRAPS: Final[dict[int, Wrap]] = {10497: "repeat", 33648: "mirror", 33071: "clamp"}
_NEAREST, _LINEAR = 9728, 9729
_FILTERS: Final = frozenset({_NEAREST, _LINEAR, 9984, 9985, 9986, 9987})
_TURN: Final = 2 * math.pi


@dataclass(frozen=True, slots=True)
class Textures:
    """A document's textures as maps; `warnings` gets what cannot be had.

    A reference whose picture cannot be drawn gives no map: then the factor stands alone.
    """

    document: Document
    pictures: tuple[Picture | None, ...]
    warnings: list[str] = field(default_factory=list)

    def has_alpha(self, info: gltf.TextureInfo | None) -> bool:
        """Whether a picture is there and brings an alpha channel."""
        picture = self._picture(info)
        return picture is not None and picture.header.has_alpha

    def color(
        self, info: gltf.TextureInfo | None, tint: list[float], scale: float = 1.0
    ) -> ColorMap | list[float]:
        """Map a colour: sRGB texels without their alpha, times tint and scale."""
        picture = self._picture(info)
        if info is None or picture is None:
            return [scale * part for part in tint]
        image = _image(picture, "srgb")
        return ColorMap(texture=image, tint=tint, scale=scale, **self._shared(info))

    def number(
        self,
        info: gltf.TextureInfo | None,
        channel: Channel,
        scale: float,
        bias: float = 0.0,
    ) -> NumberMap | float:
        """Map a number: one linear channel, scaled and shifted; without a picture 1 is read."""
        picture = self._picture(info)
        if info is None or picture is None:
            return scale + bias
        image = _image(picture, "linear", "use" if channel == "a" else "ignore")
        return NumberMap(
            texture=image, channel=channel, scale=scale, bias=bias, **self._shared(info)
        )

    def normal(self, info: gltf.NormalTextureInfo | None) -> NormalMap | None:
        """Map the normal; the green of glTF's maps points up in the picture."""
        picture = self._picture(info)
        if info is None or picture is None:
            return None
        image = _image(picture, "linear")
        return NormalMap(texture=image, strength=info.scale, green="up", **self._shared(info))

    def _picture(self, info: gltf.TextureInfo | None) -> Picture | None:
        if info is None:
            return None
        source = self.document.textures[info.index].source
        if source is None:
            self.warnings.append("a texture without a picture that can be drawn is left out")
            return None
        return self.pictures[source]

    def _shared(self, info: gltf.TextureInfo) -> dict[str, Any]:
        number = self.document.textures[info.index].sampler
        sampler = gltf.Sampler() if number is None else self.document.samplers[number]
        return {
            "coordinates": UvSpec(technique="uv", set=info.uv_set),
            "transform": _transform(info.extensions.transform),
            "wrap": [self._wrap(sampler.wrap_s), self._wrap(sampler.wrap_t)],
            "filter": self._filter(sampler),
        }

    def _wrap(self, code: int) -> Wrap:
        if code not in _WRAPS:
            self.warnings.append("an unknown wrapping mode is taken as repeat")
        return _WRAPS.get(code, "repeat")

    def _filter(self, sampler: gltf.Sampler) -> Filter:
        """Follow the sampler where it asks for hard texels or no levels; else do the best."""
        for code in (sampler.mag_filter, sampler.min_filter):
            if code is not None and code not in _FILTERS:
                self.warnings.append("an unknown filter is taken as the best")
        if sampler.mag_filter == _NEAREST:
            return "nearest"
        return "bilinear" if sampler.min_filter in (_NEAREST, _LINEAR) else "anisotropic"


def _image(
    picture: Picture,
    encoding: Literal["srgb", "linear"],
    alpha: Literal["use", "ignore"] = "ignore",
) -> ImageSpec:
    return ImageSpec(technique="image", asset=picture.sha256, encoding=encoding, alpha=alpha)


def _transform(transform: gltf.TextureTransform | None) -> TextureTransform:
    """Write KHR_texture_transform for coordinates whose v runs up.

    With x = (u, v) running down, glTF means x' = o + R S x, R = [[c, s], [-s, c]] for a turn that
    is counter-clockwise *to the eye*. Ours are w = F(x) = D x + e with D = diag(1, -1), e = (0, 1),
    and F is its own inverse, so
        w' = F(o + R S F(w)) = D R D S w + D o + e - D R D S e,
    since S and D are both diagonal. D R D = [[c, -s], [s, c]] is our counter-clockwise turn by the
    same angle, the scale stays, and the shift is
        (o_u + s scale_v, 1 - o_v - c scale_v).
    """
    if transform is None:
        return TextureTransform()
    rotation = math.remainder(transform.rotation, _TURN)
    sine, cosine = math.sin(rotation), math.cos(rotation)
    scale_v = transform.scale[1]
    return TextureTransform(
        offset=[
            transform.offset[0] + sine * scale_v,
            1 - transform.offset[1] - cosine * scale_v,
        ],
        rotation=rotation,
        scale=transform.scale,
    )
