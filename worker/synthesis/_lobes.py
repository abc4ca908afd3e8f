"""What a rough mirror gathers round the direction it faces: the lobes of T35.

They are those of a surface seen head-on, n = v = r, so that looking up what they gathered is exact
there; seen from the side, real lobes are longer and lean.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from worker.numba_kernel import kernel

GGX, PHONG = 0, 1
SMOOTHEST = 1e-4  # alpha; below, a lobe is a point to float32


@dataclass(frozen=True, slots=True)
class Lobe:
    """GGX, whose `sharpness` is alpha, or PHONG, whose `sharpness` is the exponent."""

    kind: int
    sharpness: float

    @property
    def width(self) -> float:
        """About how far from its middle it has fallen by half, in radians."""
        return self.sharpness if self.kind == GGX else 1 / math.sqrt(self.sharpness + 1)


def ggx(roughness: float) -> Lobe:
    """Return D V n.l of GGX (Walter et al., 2007) with Heitz's shadowing (2014), for n = v = r."""
    return Lobe(GGX, max(float(roughness * roughness), SMOOTHEST))


def phong(exponent: float) -> Lobe:
    """Return max(0, w.r)^exponent (Phong, 1975); at 1 it is what a matt surface gathers."""
    return Lobe(PHONG, float(exponent))


@kernel
def value(kind: int, sharpness: float, cosine: float) -> float:
    """Return a lobe's value, but for a constant, at a cosine above 0 from its middle."""
    if kind == PHONG:
        return cosine if sharpness == 1 else math.pow(cosine, sharpness)
    a2 = sharpness * sharpness
    spread = (1 + cosine) / 2 * (a2 - 1) + 1
    shadowed = cosine + math.sqrt(cosine * cosine * (1 - a2) + a2)
    return a2 * cosine / (spread * spread * shadowed)
