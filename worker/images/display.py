"""From linear light to the integer codes of a picture to look at."""

import numpy as np

from worker.images.codes import Bits, Codes, Transfer, codes_from_linear
from worker.images.colour import unpremultiply
from worker.images.image import Image
from worker.images.tone_curves import ToneCurve, apply_tone_curve, expose


def display_codes(
    image: Image, bits: Bits, transfer: Transfer, exposure: float, tone_curve: ToneCurve
) -> Codes:
    """Expose, bend and encode a picture, alpha straight and linear: shape (H, W, C).

    Args:
        image: Linear light; colour is divided by its alpha first.
        bits: Of a code, 8 or 16.
        transfer: The curve of the codes of every channel but alpha.
        exposure: In stops.
        tone_curve: From scene light to 0..1; "none" clips.
    """
    straight = unpremultiply(image.pixels) if image.has_alpha else image.pixels
    light = straight[..., :-1] if image.has_alpha else straight
    if exposure != 0:
        light = expose(light, exposure)
    shown = codes_from_linear(apply_tone_curve(light, tone_curve), bits, transfer)
    if not image.has_alpha:
        return shown
    alpha = codes_from_linear(straight[..., -1:], bits, "linear")
    return np.concatenate([shown, alpha], axis=2)
