"""Randomness inside kernels: the counter hash of `_counter_hash`, one number at a time."""

from __future__ import annotations

import numpy as np

from worker.numba_kernel import kernel


@kernel
def scrambled(key: np.uint64, counter: int) -> np.uint64:
    """Return the random 64 bits of a counter, for a key that is random itself."""
    state = (key ^ np.uint64(counter)) * np.uint64(0x9E3779B97F4A7C15)
    state = (state ^ (state >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    state = (state ^ (state >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return state ^ (state >> np.uint64(31))


@kernel
def below(bits: np.uint64, bound: int) -> np.int64:
    """Return a number in [0, bound) from the lower 32 random bits; bound is up to 2^31."""
    return np.int64(((bits & np.uint64(0xFFFFFFFF)) * np.uint64(bound)) >> np.uint64(32))
