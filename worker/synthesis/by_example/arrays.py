"""Names of the arrays that textures are made from examples with."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Bytes: TypeAlias = NDArray[np.uint8]
"""Features: pixels as they are compared."""
Mask: TypeAlias = NDArray[np.bool_]
Integers: TypeAlias = NDArray[np.int32]
"""Places and what they cost."""
Numbers: TypeAlias = NDArray[np.float64]
