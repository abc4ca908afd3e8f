"""What vertex attributes are called, and in which formats they may come."""

import re
from dataclasses import dataclass
from typing import Final

from worker.models.gltf.document.data import Accessor

Component = tuple[int, bool]
_BYTE, _SHORT = 5120, 5122
_UNSIGNED_BYTE, _UNSIGNED_SHORT, _FLOAT = 5121, 5123, 5126
_REAL: Final[frozenset[Component]] = frozenset({(_FLOAT, False)})
_SIGNED_UNIT: Final[frozenset[Component]] = frozenset({(_BYTE, True), (_SHORT, True)})
_UNIT: Final[frozenset[Component]] = frozenset({(_UNSIGNED_BYTE, True), (_UNSIGNED_SHORT, True)})
_WHOLE: Final[frozenset[Component]] = frozenset({(_UNSIGNED_BYTE, False), (_UNSIGNED_SHORT, False)})
_SIGNED_WHOLE: Final[frozenset[Component]] = frozenset({(_BYTE, False), (_SHORT, False)})
_SMALL: Final = _SIGNED_UNIT | _UNIT | _WHOLE | _SIGNED_WHOLE
_NUMBERED: Final = re.compile(r"(TEXCOORD|COLOR|JOINTS|WEIGHTS)_(0|[1-9]\d{0,3})")


@dataclass(frozen=True, slots=True)
class Format:
    """What an attribute's accessor may be.

    Attributes:
        types: Shapes of an element.
        components: Component types with whether they are normalized.
        quantized: More of these where KHR_mesh_quantization is used.
    """

    types: frozenset[str]
    components: frozenset[Component]
    quantized: frozenset[Component] = frozenset()

    def fits(self, accessor: Accessor, *, quantization: bool) -> bool:
        """Whether an accessor has such a format."""
        component = (accessor.component_type, accessor.normalized)
        allowed = self.components | (self.quantized if quantization else frozenset())
        return accessor.type in self.types and component in allowed


_VEC2, _VEC3, _VEC4 = frozenset({"VEC2"}), frozenset({"VEC3"}), frozenset({"VEC4"})

INDICES: Final = Format(
    frozenset({"SCALAR"}),
    frozenset({(_UNSIGNED_BYTE, False), (_UNSIGNED_SHORT, False), (5125, False)}),
)
ATTRIBUTES: Final = {
    "POSITION": Format(_VEC3, _REAL, _SMALL),
    "NORMAL": Format(_VEC3, _REAL, _SIGNED_UNIT),
    "TANGENT": Format(_VEC4, _REAL, _SIGNED_UNIT),
    "TEXCOORD": Format(_VEC2, _REAL | _UNIT, _SMALL),
    "COLOR": Format(_VEC3 | _VEC4, _REAL | _UNIT),
    "JOINTS": Format(_VEC4, _WHOLE),
    "WEIGHTS": Format(_VEC4, _REAL | _UNIT),
}
TARGETS: Final = {
    "POSITION": Format(_VEC3, _REAL, _SIGNED_UNIT | _SIGNED_WHOLE),
    "NORMAL": Format(_VEC3, _REAL, _SIGNED_UNIT),
    "TANGENT": Format(_VEC3, _REAL, _SIGNED_UNIT),
    "TEXCOORD": Format(_VEC2, _REAL | _UNIT | _SIGNED_UNIT, _SMALL),
    "COLOR": Format(_VEC3 | _VEC4, _REAL | _UNIT | _SIGNED_UNIT),
}
INVERSE_BIND_MATRICES: Final = Format(frozenset({"MAT4"}), _REAL)


def kind_of(name: str) -> tuple[str, int] | None:
    """Split a name that glTF knows into its kind and its set, the latter 0 for those without."""
    if name in ("POSITION", "NORMAL", "TANGENT"):
        return name, 0
    match = _NUMBERED.fullmatch(name)
    return (match[1], int(match[2])) if match else None


def sets_of(names: list[str], kind: str) -> list[int]:
    """Return the numbers of the sets of one kind, in order."""
    kinds = (kind_of(name) for name in names)
    return sorted(known[1] for known in kinds if known is not None and known[0] == kind)
