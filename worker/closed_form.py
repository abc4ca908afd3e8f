"""A texture as a formula: what synthesis tells of one, and rendering evaluates at each fragment."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Parameter = float | NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """The formula of a texture, with those of the textures in it.

    Attributes:
        technique: Names the chunk shaders/textures/<technique>.glsl.
        parameters: By the names of the chunk's arguments: numbers, vectors, and arrays, which may
            be shorter than the argument.
        inputs: Textures in the spec's fields, by field name.
    """

    technique: str
    parameters: Mapping[str, Parameter] = field(default_factory=dict)
    inputs: Mapping[str, "ClosedForm"] = field(default_factory=dict)
