"""Makes a context on PYOPENGL_PLATFORM and prints its version; run it as a process of its own.

A failed try leaves the process in a mess, and a context stays with it for good.
"""

import os

from OpenGL.GL import GL_RENDERER, GL_VERSION, glGetString

if os.environ["PYOPENGL_PLATFORM"] == "egl":
    from pyrender.platforms.egl import EGLPlatform as Platform
else:
    from pyrender.platforms.osmesa import OSMesaPlatform as Platform


def main() -> None:
    """Make the context; an error ends the process with its message on the last line."""
    platform = Platform(8, 8)
    platform.init_context()
    platform.make_current()
    print(", ".join(glGetString(name).decode() for name in (GL_VERSION, GL_RENDERER)))


if __name__ == "__main__":
    main()
