"""What a picture costs by its size and file alone, whatever it shows.

A render is drawn in tiles and written in bands, so its memory has a bound; a texture is held whole.
The constants were measured as those of `estimate`.
"""

import math
from collections.abc import Mapping

from api_schemas.cost import Cost
from api_schemas.output import SIDE_MAX, Layer, Output, RenderOutput, TextureOutput

SAMPLES_PER_TILE = 2048 * 2048
SAMPLES_PER_LAYERED_TILE = 1024 * 1024
LAYER_CHANNELS: Mapping[Layer, int] = {
    "depth": 1,
    "position": 3,
    "normal": 3,
    "geometric_normal": 3,
    "tangent": 3,
    "uv": 2,
    "albedo": 4,
    "object_id": 1,
    "material_id": 1,
    "coverage": 1,
    "footprint": 4,
    "texel_density": 1,
    "shading_difference": 3,
    "light_visibility": 1,
    "crypto_object": 15,
    "crypto_material": 15,
}

_SECONDS_TO_START = 0.01
_SECONDS_PER_PNG_PIXEL = {8: 6e-8, 16: 1.4e-7}
_SECONDS_PER_EXR_PIXEL = {"half": 7e-8, "float": 1.2e-7}
_SECONDS_PER_LAYER_NUMBER = 5e-8
_SECONDS_PER_SAMPLE = 4e-8
_SECONDS_PER_FILTERED_SAMPLE = 9e-8
_SECONDS_PER_LAYERED_SAMPLE = 1.4e-7
_SECONDS_PER_LAYERED_PIXEL = 2e-7
_BYTES_PER_PIXEL = 48
_MORE_FOR_MIPMAPS = 2
_BYTES_PER_LAYER_NUMBER = 12
_NUMBERS_PER_TEXTURE_LAYER = 3
_BYTES_PER_SAMPLE = 52
_BYTES_PER_LAYERED_SAMPLE = 272


def writing(output: Output) -> Cost:
    """Return the cost of making a file of pixels that are there."""
    pixels = math.prod(output.file_size)
    if isinstance(output, TextureOutput) and output.slices:
        pixels = max(pixels, math.prod(output.size) * output.slices)
    if output.format == "exr":
        seconds = _SECONDS_PER_EXR_PIXEL[output.exr_type]
    else:
        seconds = _SECONDS_PER_PNG_PIXEL[output.png_bits]
    numbers = 0
    if isinstance(output, RenderOutput):
        if output.format == "exr":
            numbers = sum(LAYER_CHANNELS[layer] for layer in output.layers)
        held = min(pixels, _samples_per_tile(output))
        if output.turntable:
            # A row of the sheet is held whole; frames that become layers are held all.
            rows = math.ceil(output.turntable.cells / output.columns)
            pixels = max(pixels, math.prod(output.size) * output.frames)
            held = pixels // rows
    else:
        held = pixels
        if isinstance(output, TextureOutput):
            numbers = _NUMBERS_PER_TEXTURE_LAYER * len(output.layers)
            if output.mipmaps:
                seconds *= _MORE_FOR_MIPMAPS
                held *= _MORE_FOR_MIPMAPS
    return Cost(
        _SECONDS_TO_START + pixels * (seconds + numbers * _SECONDS_PER_LAYER_NUMBER),
        float(held * (_BYTES_PER_PIXEL + numbers * _BYTES_PER_LAYER_NUMBER)),
    )


def sampling(output: RenderOutput) -> Cost:
    """Return the cost of a picture's samples where nothing is, and of making pixels of them."""
    samples = samples_of(output)
    held = min(samples // output.frames, _samples_per_tile(output))
    filtering = 0.0 if output.pixel_filter == "box" else samples * _SECONDS_PER_FILTERED_SAMPLE
    if not output.layers:
        return Cost(samples * _SECONDS_PER_SAMPLE + filtering, float(held * _BYTES_PER_SAMPLE))
    pixels = output.size[0] * output.size[1] * output.frames
    return Cost(
        samples * _SECONDS_PER_LAYERED_SAMPLE + pixels * _SECONDS_PER_LAYERED_PIXEL + 2 * filtering,
        float(held * _BYTES_PER_LAYERED_SAMPLE),
    )


def samples_of(output: RenderOutput) -> int:
    """Return how many samples are drawn, of all frames and beyond the picture's edges too."""
    more = 0 if output.pixel_filter == "box" else 2
    once = output.size[0] * output.size[1] * ("shading_difference" in output.layers)
    seen = (output.size[0] + more) * (output.size[1] + more) * output.supersampling**2
    return output.frames * (once + seen)


def tiles_of(output: RenderOutput) -> int:
    """Return in about how many tiles they are drawn: each draws every triangle again."""
    columns, rows = (math.ceil(side * output.supersampling / SIDE_MAX) for side in output.size)
    samples = samples_of(output) // output.frames
    return output.frames * max(columns * rows, math.ceil(samples / _samples_per_tile(output)))


def _samples_per_tile(output: RenderOutput) -> int:
    return SAMPLES_PER_LAYERED_TILE if output.layers else SAMPLES_PER_TILE
