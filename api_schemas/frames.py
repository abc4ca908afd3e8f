"""The frames that places and directions may be told in."""

from typing import Literal

Frame = Literal["world", "object", "view"]
"""The scene's axes, the mesh's own, or the eye's: x to the right, y up, z backwards."""
