"""Wavefront MTL: the statements of a material library.

Numbers that cannot be read count as not given, unknown statements are passed over.

Source: Wavefront Technologies, Advanced Visualizer, appendix B2 (MTL), version 4.2, 1995.
"""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from worker.errors import UnusableAssetError
from worker.models.siblings import NAME_LENGTH_MAX, decoded, sibling, sibling_name

BYTES_MAX = 1 << 22
"""Of a library: some ten thousand materials."""

_NEWMTL = re.compile(rb"^[ \t]*newmtl\s", re.MULTILINE)
_MAPS = {
    "map_kd": "map_kd",
    "map_ka": "map_ka",
    "map_ks": "map_ks",
    "map_ke": "map_ke",
    "map_ns": "map_ns",
    "map_d": "map_d",
    "map_tr": "map_tr",
    "map_bump": "bump",
    "bump": "bump",
    "norm": "norm",
    "map_norm": "norm",
    "map_kn": "norm",
    "disp": "disp",
    "map_disp": "disp",
    "decal": "decal",
    "refl": "refl",
    "map_refl": "refl",
    "map_pr": "map_pr",
    "map_pm": "map_pm",
    "map_ps": "map_ps",
}
# Values that follow each option, at most; -o, -s and -t may have one to three.
_OPTIONS = {
    "-blendu": 1,
    "-blendv": 1,
    "-boost": 1,
    "-bm": 1,
    "-cc": 1,
    "-clamp": 1,
    "-imfchan": 1,
    "-mm": 2,
    "-o": 3,
    "-s": 3,
    "-t": 3,
    "-texres": 1,
    "-type": 1,
}
_SEVERAL = ("-o", "-s", "-t")


@dataclass(frozen=True, slots=True)
class TextureStatement:
    """A picture in the place of a value: its name as written, and its options by name."""

    file: str
    options: Mapping[str, tuple[str, ...]]

    def numbers(self, option: str) -> tuple[float, ...]:
        """Give the values of an option that are numbers."""
        return tuple(n for n in map(_number, self.options.get(option, ())) if n is not None)


@dataclass(frozen=True, slots=True)
class Material:
    """One material, as written.

    Attributes:
        name: After newmtl.
        numbers: Values of statements with numbers, the statement in lower case.
        textures: Of statements with a picture, under one name for all its spellings.
        others: Values of statements that are given in words: spectral and xyz colours.
    """

    name: str
    numbers: dict[str, tuple[float, ...]] = field(default_factory=dict)
    textures: dict[str, TextureStatement] = field(default_factory=dict)
    others: set[str] = field(default_factory=set)


def is_mtl(data: bytes) -> bool:
    """Whether a text has a statement newmtl."""
    return _NEWMTL.search(data) is not None


def library(names: tuple[str, ...], files: Mapping[str, bytes]) -> dict[str, Material]:
    """Read the material libraries that an OBJ file names in its statements mtllib.

    Raises:
        AssetMissingError: `asset_file_missing`.
        UnusableAssetError: As `parse`.
    """
    materials: dict[str, Material] = {}
    for statement in names:
        for name in [statement] if statement in files else library_names(statement):
            for material in parse(sibling(files, name)):
                materials.setdefault(material.name, material)
    return materials


def library_names(statement: str) -> list[str]:
    """Part the names after one mtllib: each ends with .mtl and may have blanks in it."""
    names: list[str] = []
    words: list[str] = []
    for word in statement.split():
        words.append(word)
        if word.lower().endswith(".mtl"):
            names.append(" ".join(words))
            words = []
    return [*names, " ".join(words)] if words else names


def needed(materials: tuple[Material, ...]) -> tuple[str, ...]:
    """List the names of all pictures that materials speak of, as they are looked up.

    Raises:
        UnusableAssetError: As `sibling_name`.
    """
    written = [t.file for m in materials for slot, t in m.textures.items() if slot in USED_TEXTURES]
    return tuple(dict.fromkeys(sibling_name(name) for name in written))


USED_TEXTURES = ("map_kd", "map_ks", "map_ke", "map_ns", "map_d", "bump", "norm")
"""Those that are drawn, and so have to be there."""


def parse(data: bytes) -> tuple[Material, ...]:
    """Read all materials of a library.

    Raises:
        UnusableAssetError: `asset_too_large`.
    """
    if len(data) > BYTES_MAX:
        raise UnusableAssetError(
            f"the material library has {len(data)} bytes; the most is {BYTES_MAX}",
            code="asset_too_large",
        )
    materials: list[Material] = []
    for keyword, rest in _statements(data):
        if keyword == "newmtl":
            materials.append(Material(rest[:NAME_LENGTH_MAX] or "default"))
        elif materials:
            _read_statement(materials[-1], keyword, rest)
    return tuple(materials)


def _statements(data: bytes) -> Iterator[tuple[str, str]]:
    data = data.removeprefix(b"\xef\xbb\xbf").replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    for line in data.splitlines():
        keyword, _, rest = decoded(line).replace("\t", " ").partition(" ")
        if keyword and not keyword.startswith("#"):
            yield keyword.lower(), rest.strip()


def _read_statement(material: Material, keyword: str, rest: str) -> None:
    if keyword in _MAPS:
        texture = _texture(rest.split(" "))
        if texture.file:
            material.textures[_MAPS[keyword]] = texture
        return
    words = rest.partition("#")[0].split()
    numbers = [_number(word) for word in words if word != "-halo"]
    if numbers and None not in numbers:
        material.numbers[keyword] = tuple(n for n in numbers if n is not None)
    elif words and words[0] in ("spectral", "xyz"):
        material.others.add(keyword)


def _texture(words: list[str]) -> TextureStatement:
    options: dict[str, tuple[str, ...]] = {}
    words = [word for word in words if word]
    while words and words[0].lower() in _OPTIONS:
        option = words.pop(0).lower()
        values: list[str] = []
        # The last word is the name of the file, whatever it looks like.
        while len(words) > 1 and len(values) < _OPTIONS[option]:
            if values and option in _SEVERAL and _number(words[0]) is None:
                break
            values.append(words.pop(0))
        options[option] = tuple(values)
    return TextureStatement(" ".join(words), options)


def _number(word: str) -> float | None:
    try:
        number = float(word)
    except ValueError:
        return None
    return number if math.isfinite(number) and "_" not in word else None
