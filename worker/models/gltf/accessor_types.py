"""How the elements of an accessor lie in memory."""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

COMPONENTS: Final[dict[int, np.dtype[Any]]] = {
    5120: np.dtype("<i1"),
    5121: np.dtype("<u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
FLOAT: Final = 5126
_SHAPES: Final = {
    "SCALAR": (1, 1),
    "VEC2": (1, 2),
    "VEC3": (1, 3),
    "VEC4": (1, 4),
    "MAT2": (2, 2),
    "MAT3": (3, 3),
    "MAT4": (4, 4),
}


@dataclass(frozen=True, slots=True)
class Element:
    """One element: columns of rows of components, each column of a matrix on a multiple of 4."""

    component: np.dtype[Any]
    columns: int
    rows: int

    @property
    def numbers(self) -> int:
        """How many components it has."""
        return self.columns * self.rows

    @property
    def column_bytes(self) -> int:
        """From one column to the next."""
        tight = self.rows * self.component.itemsize
        return tight if self.columns == 1 else -(-tight // 4) * 4

    @property
    def size_bytes(self) -> int:
        """What it occupies."""
        return self.columns * self.column_bytes


def element_of(component_type: int, kind: str) -> Element | None:
    """Return the layout, or None for a type that glTF does not have."""
    if component_type not in COMPONENTS or kind not in _SHAPES:
        return None
    return Element(COMPONENTS[component_type], *_SHAPES[kind])
