"""Pictures of all directions made of functions, and techniques run on them."""

import importlib
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydantic import TypeAdapter

from api_schemas.members import Layout, Texture
from worker import layouts
from worker.images.image import Image
from worker.outcome import Outcome
from worker.stages import silent

TEXTURE = TypeAdapter(Texture)
ASSET = {"technique": "image", "asset": "0" * 64}
LATLONG = TypeAdapter(Layout).validate_python({"technique": "latlong"})
Light = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def picture(light: Light, size: tuple[int, int], layout: Any = LATLONG, fine: int = 4) -> Image:
    """Give the mean over each texel of light(directions) (n, 3) -> (n,) or (n, 3)."""
    width, height = size
    places = layouts.texel_middles(width * fine, height * fine)
    towards, valid = layouts.direction(layout, places)
    values = np.asarray(light(towards), np.float64)
    values = (values if values.ndim == 2 else np.repeat(values[:, None], 3, axis=1)).copy()
    values[~valid] = 0
    weights = (
        layouts.solid_angles(layout, width * fine, height * fine).reshape(-1, 1) * valid[:, None]
    )
    shape = (height, fine, width, fine, -1)
    total = weights.reshape(shape).sum(axis=(1, 3))
    summed = (values * weights).reshape(shape).sum(axis=(1, 3))
    mean = np.divide(summed, total, out=np.zeros_like(summed), where=total > 0)
    return Image(mean.astype(np.float32), "colour")


def run(spec: dict[str, Any], size: tuple[int, int], image: Image | None = None) -> Outcome:
    """Run a technique whose `environment` is a picture with its own pixels, if there is one."""
    body = spec if image is None else {"environment": ASSET, **spec}
    inputs = {} if image is None else {"environment": image}
    module = importlib.import_module(f"worker.synthesis.{spec['technique']}")
    made: Outcome = module.synthesize(TEXTURE.validate_python(body), size, inputs, silent)
    return made


def directions(layout: dict[str, Any], size: tuple[int, int]) -> NDArray[np.float64]:
    """Give the unit directions (height, width, 3) of a picture's texels."""
    width, height = size
    spec = TypeAdapter(Layout).validate_python(layout)
    return layouts.direction(spec, layouts.texel_middles(width, height))[0].reshape(
        height, width, 3
    )
