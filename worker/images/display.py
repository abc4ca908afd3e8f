"""From linear light to the integer codes of a picture to look at."""

import numpy as np

from api_schemas.output import PngBits, ToneCurve
from worker.images.codes import Codes, Transfer, codes_from_linear
from worker.images.colour import unpremultiply
from worker.images.image import Image
from worker.images.tone_curves import apply_tone_curve, expose

_BLOCK_TEXELS = 1 << 16


# Pictures may hold infinity and NaN.
@np.errstate(over="ignore", invalid="ignore")
def display_codes(
    image: Image, bits: PngBits, transfer: Transfer, exposure: float, tone_curve: ToneCurve
) -> Codes:
    """Expose, bend and encode a picture, alpha straight and linear: shape (H, W, C).

    Args:
        image: Linear light; colour is divided by its alpha first.
        bits: Of a code, 8 or 16.
        transfer: The curve of the codes of every channel but alpha.
        exposure: In stops, of colour; data keeps its numbers.
        tone_curve: From scene light to 0..1, of colour; "none" clips.
    """
    codes = np.empty(image.pixels.shape, np.uint8 if bits == 8 else np.uint16)
    # Some rows at a time: what lies between the steps then stays in the cache.
    step = max(1, _BLOCK_TEXELS // image.width)
    for start in range(0, image.height, step):
        rows = slice(start, start + step)
        light = unpremultiply(image.pixels[rows]) if image.has_alpha else image.pixels[rows]
        alpha = light[..., -1]
        if image.meaning == "colour":
            light = apply_tone_curve(expose(light, exposure), tone_curve)
        codes[rows] = codes_from_linear(light, bits, transfer)
        # Alpha took part above only because whole texels are quicker than parts of them.
        if image.has_alpha:
            codes[rows, :, -1] = codes_from_linear(alpha, bits, "linear")
    return codes
