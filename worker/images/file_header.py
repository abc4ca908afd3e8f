"""What a file's header says, held against every bound before anything is allocated for texels."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import SIDE_MAX
from worker.errors import UnusableAssetError
from worker.images.colour import REC709_CHROMATICITIES, rec709_from
from worker.images.file_kinds import FileKind
from worker.images.linearise import Alpha
from worker.images.windows import Window

TEXELS_MAX = 2**26  # 1 GiB as float32 RGBA

# Bits of the stored numbers, and whether they are floats.
_NUMBERS = {"uint8": (8, False), "uint16": (16, False), "half": (16, True), "float": (32, True)}
_CHANNEL_CHOICES = ("RGBA", "RGB", "RG", "YA", "Y")


@dataclass(frozen=True, slots=True)
class Header:
    """A header within all bounds.

    Attributes:
        data: The window of the stored texels.
        display: The window of the picture, before it is turned.
        orientation: As `windows.turn` takes it.
        channels: How many channels make the picture: the first ones.
        alpha: What the last of them is.
        bits: Of a stored number.
        is_float: Whether stored numbers are floats.
        rec709: From the file's linear RGB to Rec.709, or None if it is that already.
    """

    data: Window
    display: Window
    orientation: int
    channels: int
    alpha: Alpha
    bits: int
    is_float: bool
    rec709: NDArray[np.float64] | None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height as displayed."""
        upright = (self.display.width, self.display.height)
        return upright[::-1] if self.orientation in (5, 6, 7, 8) else upright


def inspect(spec: Any, kind: FileKind) -> Header:
    """Take what matters from an OpenImageIO ImageSpec.

    Raises:
        UnusableAssetError: `asset_unsupported`, `asset_too_large`, or `asset_unusable` for
            chromaticities that make no colour space.
    """
    if spec.deep:
        raise _unsupported("deep pictures are not supported")
    if spec.depth > 1 or spec.full_depth > 1:
        raise _unsupported("volumes are not supported")
    is_exr = kind.format == "openexr"
    data = Window(spec.x, spec.y, spec.width, spec.height)
    full = Window(spec.full_x, spec.full_y, spec.full_width, spec.full_height)
    # The library gives a cube of OpenEXR the display window of one face.
    is_cube = spec.getattribute("textureformat") == "CubeFace Environment"
    display = full if is_exr and not is_cube else data
    for window in (data, display):
        if max(window.width, window.height) > SIDE_MAX or window.width * window.height > TEXELS_MAX:
            raise too_large(f"{window.width} x {window.height} texels")
    channels, alpha = _choose_channels(spec)
    bits, is_float = _choose_numbers(spec, channels)
    return Header(
        data=data,
        display=display,
        orientation=spec.get_int_attribute("Orientation", 1),
        channels=channels,
        alpha=alpha,
        bits=bits,
        is_float=is_float,
        rec709=_matrix_to_rec709(spec) if is_exr and channels >= 3 else None,
    )


def too_large(size: str) -> UnusableAssetError:
    """Refuse a size, given in words."""
    return UnusableAssetError(
        f"the picture has {size}; the most is {SIDE_MAX} a side and {TEXELS_MAX} in all",
        code="asset_too_large",
    )


def _unsupported(what: str) -> UnusableAssetError:
    return UnusableAssetError(what, code="asset_unsupported")


def _choose_channels(spec: Any) -> tuple[int, Alpha]:
    """Find the picture among the channels; OpenImageIO puts R, G, B, A and Y, A first."""
    names = [name.upper() for name in spec.channelnames]
    for choice in _CHANNEL_CHOICES:
        if names[: len(choice)] == list(choice):
            if not choice.endswith("A"):
                return len(choice), "none"
            straight = spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0
            return len(choice), "straight" if straight else "associated"
    if len(names) == 1:
        return 1, "none"
    raise _unsupported(
        f"of its {len(names)} channels none is named R, G, B or Y: which to take is unknown"
    )


def _choose_numbers(spec: Any, channels: int) -> tuple[int, bool]:
    formats = spec.channelformats or [spec.format] * channels
    stored = {str(number) for number in formats[:channels]}
    if stored == {"half", "float"}:
        stored = {"float"}
    if len(stored) > 1 or not stored <= _NUMBERS.keys():
        raise _unsupported("its numbers are none of 8 or 16 bit unsigned, half and float")
    return _NUMBERS[stored.pop()]


def _matrix_to_rec709(spec: Any) -> NDArray[np.float64] | None:
    chromaticities = spec.getattribute("chromaticities")
    # Half the distance between two half-precision numbers near the x of red.
    if chromaticities is None or np.allclose(chromaticities, REC709_CHROMATICITIES, atol=2.5e-4):
        return None
    try:
        return rec709_from(chromaticities)
    except ValueError as error:
        raise UnusableAssetError(str(error)) from error
