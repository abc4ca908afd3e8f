"""A volume as a file of pictures: its slices beside each other, as layers or as parts."""

import numpy as np

from api_schemas.output import TextureOutput
from worker.images.image import Image
from worker.images.volume import Volume
from worker.rendering.packing import PICTURE


def slices_in(volume: Volume, output: TextureOutput) -> dict[str, Image]:
    """Return the pictures of one file by name, as its output arranges them."""
    if output.arrangement == "atlas":
        return {PICTURE: atlas(volume, output.columns)}
    slices = {f"slice_{index:04}": volume.slice(index) for index in range(volume.depth)}
    return slices if output.has_parts else {PICTURE: volume.slice(0), **slices}


def atlas(volume: Volume, columns: int) -> Image:
    """Lay slices in rows from the upper left; what is left over at the end is 0."""
    rows = -(-volume.depth // columns)
    shape = (rows * columns, volume.height, volume.width, volume.channels)
    cells = np.zeros(shape, np.float32)
    cells[: volume.depth] = volume.voxels
    grid = cells.reshape(rows, columns, *shape[1:]).swapaxes(1, 2)
    pixels = grid.reshape(rows * volume.height, columns * volume.width, volume.channels)
    return Image(np.ascontiguousarray(pixels), volume.meaning)
