"""The house flags of numba, so that no kernel chooses its own.

Kernels take scalars and arrays and fill arrays that numpy allocated (numpy asks the kernel for huge
pages, numba does not). IEEE arithmetic is kept as written: no reassociation and no contraction into
fused multiply-adds, so a kernel gives the same bits on every CPU, in the vectorised body of a loop
and in its remainder, and for any number of threads. LLVM still vectorises a loop that writes one
array and has no reduction.

Compiled code is cached in NUMBA_CACHE_DIR, which the environment keys by the sources: numba itself
does not notice that a kernel called by another one has changed.
"""

from __future__ import annotations

import functools
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, cast

import numba
from numba.extending import overload

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["by_type", "compiled_once", "is_array", "kernel", "parallel_kernel", "prange"]

P = ParamSpec("P")
R = TypeVar("R")

# Built into numba (omp needs the system's libgomp, the licence of tbb is not free), its idle
# threads sleep. It aborts the process when two threads enter it at once: parallel_kernel waits.
numba.config.THREADING_LAYER = "workqueue"

prange: type[range] = numba.prange
_one_at_a_time = threading.Lock()


def kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a serial kernel on first use; division by zero follows IEEE instead of raising."""
    return cast("Callable[P, R]", numba.njit(cache=True, error_model="numpy")(function))


def by_type(function: Callable[..., Any]) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Let what is decorated choose, by the types of the arguments, the code of a function.

    What is decorated takes types in the place of arguments and returns a function of these.
    """
    return cast("Callable[[Callable[P, R]], Callable[P, R]]", overload(function, strict=False))


def is_array(argument: Any) -> bool:
    """Whether a type that `by_type` passes is an array's."""
    return isinstance(argument, numba.types.Array)


def compiled_once(name: str, compile_all: Callable[[], None]) -> None:
    """Compile kernels that are not in the cache yet; a file beside them says which are.

    What is there is not even loaded: whoever needs it first does that, within 20 to 200 ms, and
    nobody pays a worker's memory for what no job asks of it.

    Args:
        name: Of these kernels together.
        compile_all: Runs each of them once.
    """
    cache = numba.config.CACHE_DIR
    mark = Path(cache, f"{name}.compiled")
    if cache and mark.exists():
        return
    compile_all()
    if cache:
        mark.parent.mkdir(parents=True, exist_ok=True)
        mark.touch()


def parallel_kernel(function: Callable[P, R]) -> Callable[P, R]:
    """Compile a kernel whose `prange` runs over blocks of fixed size, independent of each other.

    The blocks must not depend on the number of threads: that is what keeps pixels equal. Parallel
    kernels are entry points: called from Python only, one at a time in a process.
    """
    compiled = numba.njit(cache=True, error_model="numpy", parallel=True)(function)

    @functools.wraps(function)
    def enter(*args: P.args, **kwargs: P.kwargs) -> R:
        with _one_at_a_time:
            return cast("R", compiled(*args, **kwargs))

    return enter
