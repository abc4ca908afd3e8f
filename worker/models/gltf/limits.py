"""How much a glTF file may ask for, besides what `worker.models.limits` says of every model.

Everything is counted before memory is taken for it.
"""

from typing import Final

JSON_BRACKETS_MAX: Final = 300_000
"""Objects and arrays. Ten thousand nodes with a mesh each have 250 000."""
JSON_COMMAS_MAX: Final = 4_000_000
JSON_BYTES_MAX: Final = 160 * 2**20

DATA_URI_BYTES_MAX: Final = 128 * 2**20
"""Base64 text of all data URIs together. Larger things travel in a GLB, a quarter shorter."""

PICTURE_BYTES_MAX: Final = 256 * 2**20
"""Bytes of all pictures together, as files."""

ITEMS_MAX: Final = 10_000
"""Nodes, meshes, materials and so on, of each."""
ACCESSORS_MAX: Final = 50_000
"""Accessors or buffer views: five for each mesh."""
PARTS_MAX: Final = 10_000
VERTEX_BYTES_MAX: Final = 512 * 2**20
"""What all vertices occupy in float64."""
ELEMENTS_MAX: Final = 32_000_000
"""Elements of one accessor: what fits an upload of the usual limit and more."""
MORPHED_VERTICES_MAX: Final = 64_000_000
"""Vertices times the targets that move them."""
JOINT_SETS_MAX: Final = 4
