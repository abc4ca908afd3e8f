"""The one OpenGL context of a worker process, on the one thread that opened it.

Everything in worker.rendering takes `GL` from here, so that PyOpenGL is configured before its
first import. Importing this module opens nothing.
"""

import atexit
import os
import threading
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

PLATFORMS = ("osmesa", "egl")

if os.environ.get("PYOPENGL_PLATFORM") not in PLATFORMS:
    raise ImportError("PYOPENGL_PLATFORM must be osmesa or egl before worker.rendering is imported")

import OpenGL  # noqa: E402  PyOpenGL reads the platform when it is imported

if os.environ["PYOPENGL_PLATFORM"] == "egl":
    import OpenGL.EGL  # PyOpenGL cannot import EGL once ERROR_CHECKING is off

OpenGL.ERROR_CHECKING = False  # a glGetError after every call costs a third; `check` asks per tile

from OpenGL import GL  # noqa: E402
from OpenGL.GL.ARB.clip_control import glClipControl  # noqa: E402  OSMesa exports no 4.5 symbols

from worker.errors import RenderError  # noqa: E402

if TYPE_CHECKING:
    from pyrender.platforms.base import Platform


@dataclass(frozen=True, slots=True)
class GLContext:
    """A current context, kept alive by the platform object that made it.

    Attributes:
        platform: pyrender's; dropping it would destroy the context.
        thread: The identity of the only thread that may draw. Another thread would read
            uninitialised memory without an error.
    """

    platform: "Platform"
    thread: int

    @classmethod
    def open(cls) -> Self:
        """Make a context and make it current on this thread; framebuffers do all the drawing.

        Raises:
            RenderError: The platform gives no context, or one without clip control (OpenGL 4.5).
        """
        if cache := os.environ.get("MESA_SHADER_CACHE_DIR"):
            Path(cache).mkdir(parents=True, exist_ok=True)  # Mesa makes no parents and does without
        platform = _new_platform()
        platform.init_context()
        platform.make_current()
        GL.glEnable(GL.GL_TEXTURE_CUBE_MAP_SEAMLESS)
        context = cls(platform=platform, thread=threading.get_ident())
        atexit.register(platform.delete_context)
        if not bool(glClipControl):
            raise RenderError(f"OpenGL 4.5 is needed; this is {context.version()}")
        # Reversed depth needs clip space from 0 to 1, else the float's precision is lost again.
        glClipControl(GL.GL_LOWER_LEFT, GL.GL_ZERO_TO_ONE)
        return context

    def check_thread(self) -> None:
        """Refuse to go on outside the thread that owns the context.

        Raises:
            RenderError: Another thread calls.
        """
        if threading.get_ident() != self.thread:
            raise RenderError("drawing was called from a thread that does not own the GL context")

    def version(self) -> str:
        """Say which OpenGL and Mesa draw."""
        return _text(GL.GL_VERSION)

    def fingerprint(self) -> str:
        """Name what decides the pixels: renderer and Mesa, not whether OSMesa or EGL opened it."""
        return f"{_text(GL.GL_RENDERER)}; {self.version()}"


def _new_platform() -> "Platform":
    # Importing one platform fails where only the other one's library is installed.
    if os.environ["PYOPENGL_PLATFORM"] == "egl":
        from pyrender.platforms.egl import EGLPlatform, get_device_by_index  # noqa: PLC0415

        return EGLPlatform(16, 16, device=get_device_by_index(0))
    from pyrender.platforms.osmesa import OSMesaPlatform  # noqa: PLC0415

    return OSMesaPlatform(16, 16)


def _text(name: int) -> str:
    value = GL.glGetString(name)
    return value.decode() if isinstance(value, bytes) else str(value)


def check(doing: str) -> None:
    """Raise what OpenGL has to complain about since the last check.

    Raises:
        RenderError: An OpenGL error, with its number.
    """
    code = int(GL.glGetError())
    if code != int(GL.GL_NO_ERROR):
        raise RenderError(f"OpenGL error {code:#x} while {doing}")


def floats(values: Any) -> np.ndarray:
    """Make the contiguous float32 array that OpenGL reads from."""
    return np.ascontiguousarray(values, dtype=np.float32)


__all__ = ["GL", "PLATFORMS", "GLContext", "check", "floats"]
