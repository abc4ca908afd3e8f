"""How much a glTF file may ask for. Everything is counted before memory is taken for it."""

from typing import Final

JSON_BRACKETS_MAX: Final = 1_000_000
"""Objects and arrays. A parsed one takes some hundred bytes; a large scene has 100 000."""
JSON_COMMAS_MAX: Final = 4_000_000
JSON_DEPTH_MAX: Final = 64
"""The deepest value that glTF defines lies nine levels down; the rest is room for extras."""

DATA_URI_BYTES_MAX: Final = 128 * 2**20
"""Base64 text of all data URIs together. Larger things travel in a GLB, a quarter shorter."""

PICTURE_BYTES_MAX: Final = 256 * 2**20
"""Bytes of all pictures together, as files."""

NODES_MAX: Final = 10_000
PARTS_MAX: Final = 10_000
VERTICES_MAX: Final = 4_000_000
TRIANGLES_MAX: Final = 8_000_000
"""Triangles, lines and points drawn together, a mesh that stands in two places counted twice."""
ELEMENTS_MAX: Final = 32_000_000
"""Elements of one accessor: what fits an upload of the usual limit and more."""
MORPHED_VERTICES_MAX: Final = 64_000_000
"""Vertices times the targets that move them."""
JOINT_SETS_MAX: Final = 4
FARTHEST: Final = 1e9
"""Largest coordinate in the model's frame; float32 squares of it are still numbers."""
WARNINGS_MAX: Final = 64
