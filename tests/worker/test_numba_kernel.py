import threading
from concurrent.futures import ThreadPoolExecutor

import numba
import numpy as np
import pytest

from worker.numba_kernel import compiled_once, kernel, parallel_kernel, prange


@kernel
def quotient(a, b):
    return a / b


@kernel
def product_sum(a, b, c):
    return a * b + c


@parallel_kernel
def fill_squares(values):
    for i in prange(len(values)):
        values[i] = i * i


def test_division_by_zero_follows_ieee():
    assert quotient(1.0, 0.0) == np.inf
    assert np.isnan(quotient(0.0, 0.0))


def test_products_are_rounded_before_they_are_added():
    a = 1 + 2.0**-30

    # A fused multiply-add would keep the 2^-60 of the square
    assert product_sum(a, a, -(1 + 2.0**-29)) == 0.0


def test_threads_may_call_a_parallel_kernel_at_once():
    start = threading.Barrier(4)

    def squares(_):
        values = np.empty(1000)
        start.wait()
        for _ in range(50):
            fill_squares(values)
        return values

    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(squares, range(4)))

    for values in results:
        assert (values == np.arange(1000.0) ** 2).all()


def test_kernels_in_the_cache_are_not_compiled_again(tmp_path, monkeypatch):
    compiled = []
    for cache, times in ((tmp_path / "a", 1), (tmp_path / "b", 2), (tmp_path / "a", 2)):
        monkeypatch.setattr(numba.config, "CACHE_DIR", str(cache))
        compiled_once("perlin", lambda: compiled.append("perlin"))
        assert len(compiled) == times
    compiled_once("worley", lambda: compiled.append("worley"))
    assert compiled == ["perlin", "perlin", "worley"]


def test_kernels_that_could_not_be_compiled_are_tried_again(tmp_path, monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path))
    compiled = []

    def fails():
        raise MemoryError

    with pytest.raises(MemoryError):
        compiled_once("perlin", fails)
    compiled_once("perlin", lambda: compiled.append("perlin"))
    assert compiled == ["perlin"]


def test_without_a_cache_kernels_are_always_compiled(monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")
    compiled = []
    for _ in range(2):
        compiled_once("perlin", lambda: compiled.append("perlin"))
    assert compiled == ["perlin", "perlin"]
