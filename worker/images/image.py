"""The one pixel type inside the worker."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning


@dataclass(frozen=True, slots=True)
class Image:
    """A picture: linear light in Rec.709 primaries, or plain numbers.

    Construction checks the kind and shape of the array and never looks at a pixel; NaN and
    infinity are allowed inside and dealt with at the border. The array is not copied: treat it
    as read-only.

    Attributes:
        pixels: float32, shape (height, width, channels), channels 1..4, row 0 is the top row.
            The centre of texel (row r, column c) has u = (c + .5)/width, v = 1 - (r + .5)/height.
        meaning: "colour" with 2 or 4 channels has premultiplied alpha last; "data" is just numbers.

    Raises:
        TypeError: The pixels are not a float32 array.
        ValueError: The shape is not (height >= 1, width >= 1, channels 1..4), or the meaning
            is neither "colour" nor "data".
    """

    pixels: NDArray[np.float32]
    meaning: Meaning

    def __post_init__(self) -> None:
        """Refuse what is not a picture."""
        if not isinstance(self.pixels, np.ndarray) or self.pixels.dtype != np.float32:
            kind = getattr(self.pixels, "dtype", type(self.pixels).__name__)
            raise TypeError(f"pixels are {kind}; they must be a float32 array")
        shape = self.pixels.shape
        if len(shape) != 3 or 0 in shape or shape[2] > 4:
            raise ValueError(f"pixels have shape {shape}; it must be (height, width, 1..4)")
        if self.meaning not in ("colour", "data"):
            raise ValueError("meaning must be 'colour' or 'data'")

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.pixels.shape[0])

    @property
    def width(self) -> int:
        """Columns."""
        return int(self.pixels.shape[1])

    @property
    def channels(self) -> int:
        """Numbers per texel, 1..4."""
        return int(self.pixels.shape[2])

    @property
    def has_alpha(self) -> bool:
        """Whether the last channel is coverage, which the other channels are multiplied by."""
        return self.meaning == "colour" and self.channels in (2, 4)
