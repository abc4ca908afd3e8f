"""The environment in which the same request gives the same bytes on every machine.

It has to be in place before numpy, numba or OpenGL is loaded, which is why a child sets it first.
"""

import hashlib
import platform
from importlib.metadata import version
from pathlib import Path
from typing import Final

PORTABLE_CPU: Final = {
    "OPENBLAS_CORETYPE": "Haswell",
    "NUMBA_CPU_NAME": "x86-64-v3",
    # Unset would mean the features of this host, whatever the CPU's name says.
    "NUMBA_CPU_FEATURES": "",
    "LP_NATIVE_VECTOR_WIDTH": "256",
}
SOURCES: Final = Path(__file__).parents[1]


def child_environment(data: Path, *, gl: str, native_cpu: bool) -> dict[str, str]:
    """Environment variables of every child.

    Args:
        data: the data folder, in which compiled kernels and shaders are kept.
        gl: the OpenGL platform, `osmesa` or `egl`.
        native_cpu: compile for this very machine: faster, and other bytes than elsewhere.
    """
    portable = PORTABLE_CPU if platform.machine() == "x86_64" and not native_cpu else {}
    return portable | {
        "OPENBLAS_NUM_THREADS": "1",
        "GALLIVM_PERF": "no_aos_sampling",
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "PYOPENGL_PLATFORM": gl,
        "MESA_SHADER_CACHE_DIR": str(data / "cache" / "mesa"),
        "NUMBA_CACHE_DIR": str(kernel_cache(data, native_cpu=native_cpu)),
    }


def kernel_cache(data: Path, *, native_cpu: bool) -> Path:
    """The folder of compiled kernels, one for every state of the sources.

    numba looks at the file of the kernel it loads but not at the kernels that one calls, and would
    answer with yesterday's code.
    """
    key = hashlib.sha256(f"{version('numba')} native={native_cpu}".encode())
    for source in sorted(SOURCES.rglob("*.py")):
        key.update(f"{source.relative_to(SOURCES)}\0".encode() + source.read_bytes())
    return data / "cache" / f"numba-{key.hexdigest()[:16]}"
