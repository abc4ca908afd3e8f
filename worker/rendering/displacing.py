"""From a displacement of the language to a mesh whose vertices have moved."""

import numpy as np

from api_schemas.base import LENGTH_MAX
from api_schemas.coordinates.uv import UvSpec
from api_schemas.relief import DISPLACED_TRIANGLES_MAX, Displacement
from worker.errors import RenderError
from worker.geometry.displacement import displaced
from worker.geometry.mesh import Mesh
from worker.geometry.subdivision import subdivided
from worker.geometry.topology import Floats
from worker.images.image import Image
from worker.images.pyramids import mip_chain
from worker.images.sampling import sample
from worker.rendering.lookups import texture_from_uv
from worker.rendering.samplers import Sampling


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


def with_relief(mesh: Mesh, spec: Displacement, levels: int, image: Image) -> Mesh:
    """Subdivide a mesh and move its vertices by the heights of a picture.

    Lines and points stay as they are.

    Args:
        mesh: In the object's frame.
        spec: How.
        levels: How often its edges are halved.
        image: The relief, data; what is no number in it is 0.

    Raises:
        RenderError: It has no texture coordinates (`coordinates_missing`).
    """
    if mesh.kind != "triangles" or not mesh.triangles.size:
        return mesh
    if not mesh.uv_sets:
        message = "a displaced mesh needs texture coordinates"
        raise RenderError(message, code="coordinates_missing")
    fine = subdivided(mesh, levels, spec.longest_edge)
    return displaced(fine, _heights(fine, spec, image))


def _heights(mesh: Mesh, spec: Displacement, image: Image) -> Floats:
    """Read how far each vertex is moved; a grey is red, green and blue, a missing alpha is 1."""
    channel = "rgba".index(spec.channel)
    channel = 0 if image.channels == 1 and channel < 3 else channel
    if channel >= image.channels:
        values = np.full(len(mesh.positions), float(spec.channel == "a"))
    else:
        values = _values(mesh, spec, np.nan_to_num(image.pixels[..., channel : channel + 1]))
    return np.clip(spec.depth * (values - spec.middle), -LENGTH_MAX, LENGTH_MAX)


def _values(mesh: Mesh, spec: Displacement, pixels: np.ndarray) -> Floats:
    u, v = spec.wrap
    sampling = Sampling.of((u, v), spec.filter)
    matrix = texture_from_uv(spec.transform, sampling.period[:2])
    uv = mesh.uv(spec.coordinates.set if isinstance(spec.coordinates, UvSpec) else 0)
    places = uv @ matrix[:2, :2].T + matrix[:2, 2]
    levels = mip_chain(pixels) if sampling.levels else [pixels]
    detail = None
    if sampling.levels:
        reach = _reach(places * pixels.shape[1::-1], mesh.triangles.astype(np.int64))
        detail = np.log2(np.maximum(reach, 1.0))
    return sample(
        [level[..., 0] for level in levels],
        places,
        (u, v),
        border=spec.border_color["rgba".index(spec.channel)],
        smooth=sampling.smooth,
        detail=detail,
    )


def _reach(texels: Floats, corners: np.ndarray) -> Floats:
    """Return for each vertex the length of its longest edge in texels: finer detail has no room."""
    reach = np.zeros(len(texels))
    for one, other in ((0, 1), (1, 2), (2, 0)):
        length = np.linalg.norm(texels[corners[:, one]] - texels[corners[:, other]], axis=1)
        np.maximum.at(reach, corners[:, one], length)
        np.maximum.at(reach, corners[:, other], length)
    return reach
