"""From a displacement of the language to a mesh whose vertices have moved."""

import numpy as np
from numpy.typing import NDArray

from api_schemas.base import LENGTH_MAX
from api_schemas.relief import DISPLACED_TRIANGLES_MAX, Displacement
from api_schemas.solid import is_carved
from worker.errors import RenderError
from worker.geometry.displacement import displaced
from worker.geometry.mesh import Mesh
from worker.geometry.subdivision import subdivided
from worker.geometry.topology import Floats, Indices
from worker.images.image import Image
from worker.images.pyramids import mip_chain
from worker.images.sampling import sample
from worker.images.volume import Volume
from worker.images.volume_pyramids import volume_chain
from worker.rendering.lookups import texture_from_uv
from worker.rendering.mesh_coordinates import coordinates_of
from worker.rendering.samplers import Sampling
from worker.rendering.texture_maker import TextureMaker


def levels_of(spec: Displacement, triangles: int) -> int:
    """Return how often edges are halved on something of so many triangles.

    Raises:
        RenderError: It would have too many (`over_budget`).
    """
    count = spec.triangles(triangles)
    if count > DISPLACED_TRIANGLES_MAX:
        message = f"{count} triangles after subdivision; at most {DISPLACED_TRIANGLES_MAX}"
        raise RenderError(message, code="over_budget")
    return spec.levels(triangles)


def with_relief(mesh: Mesh, spec: Displacement, levels: int, texture: Image | Volume) -> Mesh:
    """Subdivide a mesh and move its vertices by the heights of a picture, or of a volume.

    Lines and points stay as they are.

    Args:
        mesh: In the object's frame.
        spec: How.
        levels: How often its edges are halved.
        texture: The relief, data, a volume if it is carved; what is no number in it is 0.

    Raises:
        RenderError: Its vertices have no such coordinates (`coordinates_missing`,
            `coordinates_unsuited`).
    """
    if mesh.kind != "triangles" or not mesh.triangles.size:
        return mesh
    fine = subdivided(mesh, levels, spec.longest_edge)
    return displaced(fine, _heights(fine, spec, texture))


def relief_of(spec: Displacement, maker: TextureMaker) -> Image | Volume:
    """Make the texture that a relief is read from.

    Raises:
        WorkerError: It cannot be made.
    """
    return (maker.volume if is_carved(spec) else maker)(spec.texture, "data")


def _heights(mesh: Mesh, spec: Displacement, texture: Image | Volume) -> Floats:
    """Read how far each vertex is moved; a grey is red, green and blue, a missing alpha is 1."""
    channel = "rgba".index(spec.channel)
    channel = 0 if texture.channels == 1 and channel < 3 else channel
    numbers = texture.pixels if isinstance(texture, Image) else texture.voxels
    if channel >= texture.channels:
        values = np.full(len(mesh.positions), float(spec.channel == "a"))
    else:
        values = _values(mesh, spec, np.nan_to_num(numbers[..., channel : channel + 1]))
    return np.clip(spec.depth * (values - spec.middle), -LENGTH_MAX, LENGTH_MAX)


def _values(mesh: Mesh, spec: Displacement, numbers: NDArray[np.float32]) -> Floats:
    """Read numbers (height, width, 1) or (depth, height, width, 1) at each vertex."""
    u, v = spec.wrap if spec.layout is None else spec.layout.joins
    sampling = Sampling.of((u, v), spec.filter)
    axes = numbers.ndim - 1
    matrix = texture_from_uv(spec.transform, sampling.period[:2])
    places = coordinates_of(spec.coordinates, spec.layout, mesh)[:, :axes].copy()
    places[:, :2] = places[:, :2] @ matrix[:2, :2].T + matrix[:2, 2]
    levels, detail = [numbers], None
    if sampling.levels:
        levels = mip_chain(numbers) if axes == 2 else volume_chain(numbers)
        size = np.array(numbers.shape[-2::-1])
        periods = np.array([*sampling.period[:2], sampling.period[1]][:axes]) * size
        reach = _reach(places * size, mesh.triangles.astype(np.int64), periods)
        detail = np.log2(np.maximum(reach, 1.0))
    return sample(
        [level[..., 0] for level in levels],
        places,
        (u, v, v)[:axes],
        border=spec.border_color["rgba".index(spec.channel)],
        smooth=sampling.smooth,
        detail=detail,
    )


def _reach(texels: Floats, corners: Indices, periods: Floats) -> Floats:
    """Return for each vertex the length of its longest edge in texels: finer detail has no room.

    What repeats is as near as its nearest copy, so that no seam lies between two vertices.
    """
    reach = np.zeros(len(texels))
    copies = np.where(periods > 0, periods, 1.0)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        apart = texels[corners[:, one]] - texels[corners[:, other]]
        apart -= np.where(periods > 0, copies * np.rint(apart / copies), 0.0)
        length = np.linalg.norm(apart, axis=1)
        np.maximum.at(reach, corners[:, one], length)
        np.maximum.at(reach, corners[:, other], length)
    return reach
