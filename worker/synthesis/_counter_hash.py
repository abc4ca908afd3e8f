"""Random numbers without a stream: a hash of (seed, use, counter), equal for any order of work."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def mixed(counter: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Scramble 64-bit counters one to one: the finaliser of splitmix64 (Steele et al., 2014)."""
    state = counter * np.uint64(0x9E3779B97F4A7C15)
    state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    scrambled: NDArray[np.uint64] = state ^ (state >> np.uint64(31))
    return scrambled


def key(seed: int, use: int) -> int:
    """Return what the counters of a use of a seed are combined with."""
    return int(mixed(np.array([seed * 2**32 + use], np.uint64))[0])


def hashes(seed: int, use: int, count: int, first: int = 0) -> NDArray[np.uint64]:
    """Return random 64-bit numbers `first` to `first + count`; every `use` of a seed has others."""
    counters = np.arange(first, first + count, dtype=np.uint64)
    return mixed(np.uint64(key(seed, use)) ^ counters)


def uniforms(seed: int, use: int, count: int, first: int = 0) -> NDArray[np.float64]:
    """Return `count` random numbers in [0, 1), multiples of 2^-53."""
    return (hashes(seed, use, count, first) >> np.uint64(11)).astype(np.float64) * 2.0**-53
