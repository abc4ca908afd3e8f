"""Directions in which things spread, given or found in a picture, and the flow along them.

Tensors are D11, D22 and D12 of every cell with its rim, (3, height + 2, width + 2). Their second
axis runs down, as rows do: D12 has the other sign than with v up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worker.numba_kernel import kernel
from worker.synthesis._dish import at, channels, fill_rim
from worker.synthesis.blur import smooth

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from api_schemas.dishes import CellsSpec
    from worker.images.image import Image
    from worker.synthesis._dish import Cells, Rows


def angles_of(spec: CellsSpec, direction: Rows, guide: Image | None, radius: float) -> Cells:
    """Return the angle of every cell, (height, width): a direction, or one from a guide on."""
    width, height = spec.size
    angle = np.array(np.broadcast_to(direction[:, 1:-1], (height, width)))
    if guide is not None:
        angle += directions_of(channels(spec, guide)[0], radius)
    return angle


def tensors_along(angle: Cells, along: Cells | float, across: Cells | float, border: str) -> Cells:
    """Return the tensors of cells that spread so fast along and across an angle."""
    height, width = angle.shape
    cosine, sine = np.cos(angle), np.sin(angle)
    tensors = np.zeros((3, height + 2, width + 2))
    inside = tensors[:, 1:-1, 1:-1]
    inside[0] = along * cosine**2 + across * sine**2
    inside[1] = along * sine**2 + across * cosine**2
    inside[2] = (across - along) * cosine * sine
    fill_rim(tensors, "torus" if border == "torus" else "no_flux")
    if border == "no_flux":
        # Seen in the mirror of a wall a direction leans to the other side
        tensors[2, [0, -1]] *= -1
        tensors[2, :, [0, -1]] *= -1
    return tensors


@kernel
def inflow_at(c: Cells, tensors: Cells, x: int) -> float:
    """Return what a cell gains of its neighbours: three rows of cells, and of their tensors."""
    d11, d22, d12 = tensors[0], tensors[1], tensors[2]
    left, right = x - 1, x + 1
    here = c[1, x]
    total: float = (d11[1, x] + d11[1, right]) * (c[1, right] - here) / 2
    total -= (d11[1, x] + d11[1, left]) * (here - c[1, left]) / 2
    total += (d22[1, x] + d22[2, x]) * (c[2, x] - here) / 2
    total -= (d22[1, x] + d22[0, x]) * (here - c[0, x]) / 2
    total += d12[1, right] * (c[2, right] - c[0, right]) / 4
    total -= d12[1, left] * (c[2, left] - c[0, left]) / 4
    total += d12[2, x] * (c[2, right] - c[2, left]) / 4
    total -= d12[0, x] * (c[0, right] - c[0, left]) / 4
    return total


@kernel
def spread_along(
    after: Cells, before: Cells, tensors: Cells, diffusions: tuple[Rows, ...], time_step: float
) -> None:
    """Let every chemical spread for one step, by tensors times its own diffusion."""
    chemicals, height, width = before.shape
    for chemical in range(chemicals):
        for row in range(1, height - 1):
            near = slice(row - 1, row + 2)
            c, t = before[chemical, near], tensors[:, near]
            rates = at(diffusions[chemical], row)
            for x in range(1, width - 1):
                gained = rates[x] * inflow_at(c, t, x)
                after[chemical, row, x] = c[1, x] + time_step * gained


def directions_of(picture: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Return the angle, counter-clockwise from u, along which a picture changes least.

    By its structure tensor (Foerstner and Guelch, 1987).

    Args:
        picture: (height, width), row 0 the top; its edges are joined.
        radius: Standard deviation, in tiles, of the neighbourhood that is looked at.
    """
    height, width = picture.shape
    # Differences per tile, v up
    along_u = (np.roll(picture, -1, 1) - np.roll(picture, 1, 1)) * width
    along_v = (np.roll(picture, 1, 0) - np.roll(picture, -1, 0)) * height
    uu, vv, uv = (
        smooth(product, (radius, radius))
        for product in (along_u * along_u, along_v * along_v, along_u * along_v)
    )
    steepest = 0.5 * np.arctan2(2 * uv, uu - vv)
    flat = (uu + vv) < 1e-20
    angle: NDArray[np.float64] = np.where(flat, 0.0, steepest + np.pi / 2)
    return angle
