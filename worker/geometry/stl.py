"""STL: triangles without a connection, in text or in binary, flat as their geometry is.

Normals in the file are passed over: many writers leave them 0. Colours in the two spare bytes of a
binary triangle are read as VisCAM and SolidView write them, or as Magics does where the header
says COLOR=; they are 5-bit sRGB.

Source: 3D Systems, StereoLithography Interface Specification, 1988.
"""

import numpy as np
from numpy.typing import NDArray

from worker.errors import UnusableAssetError
from worker.geometry.mesh import Mesh
from worker.geometry.model import Model, Part
from worker.geometry.model_limits import TRIANGLES_MAX, check_positions, check_size
from worker.geometry.outline import Outline, outline_of
from worker.geometry.stl_scan import read_vertices
from worker.geometry.vertices import flat_normals
from worker.images.colour import linear_from_srgb

_HEADER = 84
_TRAILER_MAX = 512  # some writers append a line end or a few words
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])  # 50 bytes


def is_binary_stl(data: bytes) -> bool:
    """Whether a file is as long as the number of triangles in it says, or little longer."""
    if len(data) < _HEADER:
        return False
    count = _binary_count(data)
    beyond = len(data) - _HEADER - count * _RECORD.itemsize
    return beyond == 0 or (0 < beyond <= _TRAILER_MAX and count > 0)


def is_text_stl(data: bytes) -> bool:
    """Whether a text begins as the format wants, and has a facet or an end."""
    start = data[:256].lstrip()
    return start[:5].lower() == b"solid" and (
        b"facet" in data[:4096].lower() or b"endsolid" in data[:4096].lower()
    )


def read(data: bytes) -> Model:
    """Read an STL of either kind.

    Raises:
        UnusableAssetError: `asset_unusable` or `asset_too_large`.
    """
    colours = None
    if is_binary_stl(data):
        check_size(_binary_count(data), TRIANGLES_MAX, "triangles")
        records = np.frombuffer(data, _RECORD, _binary_count(data), offset=_HEADER)
        with np.errstate(invalid="ignore"):  # a NaN may be a signalling one
            corners = records["corners"].astype(np.float64)
        colours = _colours(data[:80], records["spare"])
    else:
        corners = _corners_in_text(data)
    if not len(corners):
        raise UnusableAssetError("it has no triangles")
    check_positions(corners)
    mesh = Mesh(
        positions=corners.reshape(-1, 3),
        normals=np.repeat(flat_normals(corners), 3, axis=0),
        uv_sets=(),
        triangles=np.arange(3 * len(corners), dtype=np.uint32).reshape(-1, 3),
        colors=None if colours is None else np.repeat(colours, 3, axis=0),
    )
    part = Part(mesh=mesh, matrix=np.eye(4), node=None, material=None, key="0")
    return Model(
        parts=(part,),
        node_names=(),
        surfaces=(),
        cameras=(),
        lights=(),
        pictures={},
        warnings=(),
    )


def outline(data: bytes) -> Outline:
    """Measure an STL.

    Raises:
        UnusableAssetError: As `read`.
    """
    return outline_of([read(data).parts[0].mesh], has_normals=False)


def _binary_count(data: bytes) -> int:
    return int.from_bytes(data[80:84], "little")


def _corners_in_text(data: bytes) -> NDArray[np.float64]:
    text = np.frombuffer(data, np.uint8)
    count = read_vertices(text, np.empty((0, 3)))
    if count < 0:
        raise UnusableAssetError("its facets have not three vertices each, or it is cut short")
    check_size(count // 3, TRIANGLES_MAX, "triangles")
    corners = np.empty((count, 3))
    read_vertices(text, corners)
    return corners.reshape(-1, 3, 3)


def _colours(header: bytes, spare: NDArray[np.uint16]) -> NDArray[np.float64] | None:
    """Linear colours (m, 4) of the triangles, or None if none has one."""
    at = header.find(b"COLOR=")
    is_magics = 0 <= at <= len(header) - 10
    has_one = (spare & 0x8000 == 0) if is_magics else (spare & 0x8000 != 0)
    if not has_one.any():
        return None
    shifts = (0, 5, 10) if is_magics else (10, 5, 0)
    encoded = np.stack([(spare >> shift & 31) / 31 for shift in shifts], axis=1)
    others = np.frombuffer(header[at + 6 : at + 9], np.uint8) / 255 if is_magics else np.ones(3)
    colours = np.ones((len(spare), 4))
    colours[:, :3] = linear_from_srgb(np.where(has_one[:, None], encoded, others))
    return colours
