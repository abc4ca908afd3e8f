"""Exposure and tone curves: from scene light to what a display can show."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.output import ToneCurve
from worker.images.colour import luminance


def expose(colour: NDArray[np.float32], stops: float) -> NDArray[np.float32]:
    """Double the light `stops` times; negative stops halve it."""
    return colour * np.float32(2.0**stops) if stops != 0 else colour


def apply_tone_curve(colour: NDArray[np.float32], curve: ToneCurve) -> NDArray[np.float32]:
    """Bend linear light, shape (..., C), not multiplied by alpha, by the named curve.

    From three channels on the first three are a colour. A channel after the colour is bent along.

    Negative light and NaN become 0 before the two bending curves, infinity their upper end.
    """
    if curve == "none":
        return colour
    light = np.clip(np.fmax(colour, 0), 0, np.float32(1e18))
    return _reinhard(light) if curve == "reinhard" else _aces(light)


def _reinhard(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Scale each colour by 1 / (1 + its luminance) (Reinhard et al. 2002, equation 3)."""
    grey = luminance(light)[..., None] if light.shape[-1] >= 3 else light
    return light / (1 + grey)


def _aces(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Fit the ACES reference rendering per channel by one rational function (Narkowicz 2015)."""
    bent = (light * (2.51 * light + 0.03)) / (light * (2.43 * light + 0.59) + 0.14)
    return np.minimum(bent, np.float32(1))
