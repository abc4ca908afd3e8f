"""A box round the origin."""

from worker.geometry.mesh import Mesh, join
from worker.geometry.plane import plane


def box(width: float, height: float, depth: float) -> Mesh:
    """Put the whole texture on each of six faces, in the order +x, -x, +y, -y, +z, -z.

    Args:
        width: Extent along x.
        height: Extent along y.
        depth: Extent along z.
    """
    return join(
        [
            plane(depth, height, "+x", width / 2),
            plane(depth, height, "-x", width / 2),
            plane(width, depth, "+y", height / 2),
            plane(width, depth, "-y", height / 2),
            plane(width, height, "+z", depth / 2),
            plane(width, height, "-z", depth / 2),
        ]
    )
