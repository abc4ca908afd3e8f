"""From materials of an MTL library to `phong` surfaces.

Kd is the matt part, Ks and Ns the highlight (none with illum 0 or 1), Ke the emission, d and Tr the
opacity. Colours are linear, as Blender writes them. Ka is passed over and the ambient colour is
that of the matt part: exporters fill it with anything. A picture multiplies its value; where the
value is black it stands alone, since exporters write 0 beside it. Pictures in bump with colours in
them are normal maps (so writes Blender), grey ones are heights.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from api_schemas.base import FLOAT32_MAX, LENGTH_MAX
from api_schemas.maps import ColorMap, NormalMap, NumberMap, TextureTransform
from api_schemas.surfaces.phong import PhongSpec
from api_schemas.textures.normal_from_height import NormalFromHeightSpec
from worker.models.model import NamedSurface
from worker.models.obj.mtl import Material, TextureStatement
from worker.models.pictures import PictureSet
from worker.models.siblings import shown

BUMP_DEPTH = 0.02
"""Height of white in tiles where -bm is 1: the format gives no unit."""

_CHANNELS: dict[str, Literal["r", "g", "b", "a"]] = {"r": "r", "g": "g", "b": "b", "m": "a"}
_NOT_DRAWN = {
    "map_ka": "map_Ka",
    "map_tr": "map_Tr",
    "disp": "disp",
    "decal": "decal",
    "refl": "refl",
    "map_pr": "map_Pr",
    "map_pm": "map_Pm",
    "map_ps": "map_Ps",
}
_NO_EFFECT = ("-boost", "-cc", "-t", "-texres", "-type")


@dataclass(slots=True)
class Surfaces:
    """What a model's materials became, their pictures, and what is not as it was asked for."""

    surfaces: list[NamedSurface] = field(default_factory=list)
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


def surfaces_of(
    names: tuple[str, ...], library: Mapping[str, Material], files: Mapping[str, bytes]
) -> Surfaces:
    """Make a surface for each material that a model names.

    Raises:
        AssetMissingError: `asset_file_missing`: a picture that would be drawn is not in the set.
        UnusableAssetError: Such a picture is none, or its name cannot be one.
    """
    pictures = PictureSet(files)
    made = Surfaces(pictures=pictures.used)
    for name in names:
        material = library.get(name)
        if material is None:
            if library:
                made.warnings.append(f"material {shown(name)} is in no library: it is plain grey")
            made.surfaces.append(NamedSurface(name, PhongSpec(technique="phong")))
        else:
            surface = _Translation(material, pictures, made).surface()
            made.surfaces.append(NamedSurface(name, surface))
    return made


class _Translation:
    """One material on its way to a surface."""

    def __init__(self, material: Material, pictures: PictureSet, made: Surfaces) -> None:
        self._material = material
        self._pictures = pictures
        self._made = made

    def surface(self) -> PhongSpec:
        material = self._material
        for slot, spelling in _NOT_DRAWN.items():
            if slot in material.textures:
                self._warn(f"{spelling} is not drawn")
        if material.others:
            self._warn("colours given as spectra or as CIE XYZ are not read")
        if self._number("illum", 2.0) in (4.0, 6.0, 7.0, 9.0):
            self._warn("refraction is not drawn")
        shiny = self._shiny()
        opacity = self._opacity()
        return PhongSpec(
            technique="phong",
            diffuse_color=self._coloured("kd", [0.8, 0.8, 0.8]),
            specular_weight=1.0 if shiny else 0.0,
            specular_color=self._coloured("ks", [1.0, 1.0, 1.0]) if shiny else [1.0, 1.0, 1.0],
            exponent=self._exponent() if shiny else 32.0,
            emission=self._coloured("ke", [0.0, 0.0, 0.0]),
            opacity=opacity,
            alpha_mode="opaque" if opacity == 1.0 else "blend",
            normal=self._normal(),
        )

    def _warn(self, what: str) -> None:
        self._made.warnings.append(f"material {shown(self._material.name)}: {what}")

    def _number(self, keyword: str, default: float) -> float:
        return self._material.numbers.get(keyword, (default,))[0]

    def _colour(self, keyword: str) -> list[float] | None:
        """Read one grey or three numbers, held within what a colour may be."""
        numbers = self._material.numbers.get(keyword)
        if numbers is None:
            return None
        three = numbers[:3] if len(numbers) >= 3 else numbers[:1] * 3
        return [min(max(number, 0.0), FLOAT32_MAX) for number in three]

    def _coloured(self, keyword: str, default: list[float]) -> list[float] | ColorMap:
        colour = self._colour(keyword)
        texture = self._material.textures.get(f"map_{keyword}")
        if texture is None:
            return default if colour is None else colour
        if colour is not None and not any(colour):
            self._warn(f"K{keyword[1]} is black beside its picture and is taken as white")
            colour = None
        base, gain = self._base_and_gain(texture)
        return ColorMap(
            texture=self._pictures.spec(texture.file, "colour"),
            tint=colour or [1.0, 1.0, 1.0],
            scale=gain,
            bias=base,
            **self._place(texture),
        )

    def _shiny(self) -> bool:
        if self._number("illum", 2.0) < 2:
            return False
        if "map_ks" not in self._material.textures and not any(self._colour("ks") or [0.0]):
            return False
        if self._number("ns", 32.0) <= 0:
            self._warn("a highlight with Ns 0 covers everything and is not drawn")
            return False
        return True

    def _exponent(self) -> float | NumberMap:
        exponent = min(self._number("ns", 32.0), FLOAT32_MAX)
        texture = self._material.textures.get("map_ns")
        return exponent if texture is None else self._numbers(texture, exponent)

    def _opacity(self) -> float | NumberMap:
        transparency = self._number("tr", 0.0)
        if "d" not in self._material.numbers and transparency >= 1:
            self._warn("Tr 1 would make it invisible and is taken as opaque")
            transparency = 0.0
        opacity = min(max(self._number("d", 1.0 - transparency), 0.0), 1.0)
        texture = self._material.textures.get("map_d")
        if texture is None:
            return opacity
        if opacity == 0:
            self._warn("d is 0 beside its picture and is taken as 1")
            opacity = 1.0
        return self._numbers(texture, opacity, prefer_alpha=True)

    def _numbers(
        self, texture: TextureStatement, factor: float, *, prefer_alpha: bool = False
    ) -> NumberMap:
        asked = texture.options.get("-imfchan", ("",))[:1]
        channel = _CHANNELS.get(asked[0] if asked else "")
        if channel is None and prefer_alpha and self._pictures.has_alpha(texture.file):
            channel = "a"
        base, gain = self._base_and_gain(texture)
        return NumberMap(
            texture=self._pictures.spec(texture.file, "data"),
            channel=channel or "r",
            scale=gain * factor,
            bias=base * factor,
            **self._place(texture),
        )

    def _normal(self) -> NormalMap | None:
        texture = self._material.textures.get("norm")
        if texture is not None:
            return NormalMap(
                texture=self._pictures.spec(texture.file, "data"), **self._place(texture)
            )
        texture = self._material.textures.get("bump")
        if texture is None:
            return None
        strength = (texture.numbers("-bm") or (1.0,))[0]
        picture = self._pictures.spec(texture.file, "data")
        if not self._pictures.is_grey(texture.file):
            return NormalMap(
                texture=picture, strength=_held(strength, FLOAT32_MAX), **self._place(texture)
            )
        relief = NormalFromHeightSpec(
            technique="normal_from_height", height=picture, depth=_held(strength * BUMP_DEPTH, 16.0)
        )
        return NormalMap(texture=relief, **self._place(texture))

    def _base_and_gain(self, texture: TextureStatement) -> tuple[float, float]:
        numbers = texture.numbers("-mm")
        if len(numbers) < 2:
            return 0.0, 1.0
        return _held(numbers[0], 1e6), _held(numbers[1], 1e6)

    def _place(self, texture: TextureStatement) -> dict[str, Any]:
        """Give the fields of a map that say where its picture lies."""
        for option in _NO_EFFECT:
            if option in texture.options:
                self._warn(f"the option {option} of a picture has no effect")
        clamped = texture.options.get("-clamp") == ("on",)
        scale, offset = texture.numbers("-s"), texture.numbers("-o")
        # Numbers that are left out keep their defaults: one alone is along u.
        return {
            "transform": TextureTransform(
                scale=[_held(n, LENGTH_MAX) for n in (*scale, *(1.0, 1.0)[len(scale) :])[:2]],
                offset=[_held(n, LENGTH_MAX) for n in (*offset, *(0.0, 0.0)[len(offset) :])[:2]],
            ),
            "wrap": ["clamp", "clamp"] if clamped else ["repeat", "repeat"],
        }


def _held(number: float, most: float) -> float:
    return min(max(number, -most), most)
