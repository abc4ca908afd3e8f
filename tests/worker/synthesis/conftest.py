"""Pictures from bodies, as the worker makes them."""

from typing import Any

import numba
import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import synthesize

TEXTURE = TypeAdapter(Texture)


def no_assets(spec: object, meaning: str) -> Image:
    raise AssertionError("no asset was expected")


@pytest.fixture
def make():
    """Make pixels (height, width, channels) of a body: make(body, (width, height))."""

    def pixels(body: dict[str, Any], size: tuple[int, int], load: Any = no_assets) -> np.ndarray:
        return synthesize(TEXTURE.validate_python(body), size, load).pixels

    return pixels


@pytest.fixture
def with_threads():
    """Run a function with a number of threads, as far as the machine has them."""
    most = numba.get_num_threads()

    def run(threads: int, function: Any) -> Any:
        numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
        return function()

    yield run
    numba.set_num_threads(most)
