"""The octaves of fractal noise: their cells, weights and places, shared by grids and points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from api_schemas.textures.perlin import PerlinSpec

SHIFT_UNITS = 256


@dataclass(frozen=True, slots=True)
class Octave:
    """One layer of noise: noise(cells * (u, v, w) + shift / SHIFT_UNITS, beats * t, from `layer`).

    Attributes:
        cells: Lattice cells per tile along u, v and w, which is also the period.
        beats: Lattice cells along time from one repetition to the next.
        gain: What the octave is multiplied by, n-th power of the spec's gain.
        share: The gain over the sum of the gains of all octaves, faded ones included, so that a
            smaller picture shows the same noise with less detail.
        visibility: What is left of it, 0..1, since pixels cannot show what is too fine for them.
        layer: Added to the third lattice index, so that octaves have different gradients.
        shift: Offset along u, v and w in 1/256 of a cell, so that the zeros on the lattices of
            different octaves do not fall together. Octave n is shifted by n steps of the R2
            sequence (Roberts, 2018), (0.7549, 0.5698) of a cell; the first one is not shifted, and
            none along w, so that a picture is the slice w = 0 of the solid.
    """

    cells: int
    beats: int
    gain: float
    share: float
    visibility: float
    layer: int
    shift: tuple[int, int, int]

    @property
    def weight(self) -> float:
        """Its share of the sum, as far as it can be seen."""
        return self.share * self.visibility


def octaves_of(spec: PerlinSpec, pixels_per_tile: float) -> list[Octave]:
    """Return all octaves, coarse to fine; those too fine to be seen have a visibility of 0.

    Args:
        spec: The noise.
        pixels_per_tile: Of the coarser direction; infinity keeps every octave.
    """
    gains = [spec.gain**n for n in range(spec.octaves)]
    octaves = []
    for n, gain in enumerate(gains):
        cells = spec.frequency * spec.lacunarity**n
        octaves.append(
            Octave(
                cells=cells,
                beats=spec.beats * spec.lacunarity**n,
                gain=gain,
                share=gain / sum(gains),
                visibility=visibility(pixels_per_tile / cells),
                layer=n,
                shift=(193 * n % SHIFT_UNITS, 145 * n % SHIFT_UNITS, 0),
            )
        )
    return octaves


def visibility(pixels_per_cell: float) -> float:
    """Return which share of its strength a layer of noise keeps at so many pixels per cell.

    It fades as a smoothstep from all at 4 pixels per cell to nothing at 2: below, the pixels could
    not tell its frequencies apart.
    """
    s = min(max((pixels_per_cell - 2) / 2, 0.0), 1.0)
    return s * s * (3 - 2 * s)
