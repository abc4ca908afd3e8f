"""What it takes to hold a texture in the form that its filter reads: smaller levels, or a table."""

from collections.abc import Mapping

from api_schemas.cookies import Cookie
from api_schemas.cost import Cost
from api_schemas.maps import TABLE_FILTERS
from api_schemas.relief import AnyMap

BYTES_PER_KEPT_TEXEL: Mapping[str, int] = {"box": 24, "kaiser": 24, "ripmap": 64, "summed_area": 32}
BYTES_TO_SUM_A_TEXEL = 96
SECONDS_PER_TEXEL: Mapping[str, float] = {
    "box": 0.0,
    "kaiser": 5e-7,
    "ripmap": 1e-7,
    "summed_area": 2e-7,
}
"""Beyond what making plain levels takes, which counts as a part of making the texture."""
_Read = AnyMap | Cookie


def form_of(item: _Read) -> str:
    """Name the form; what else lies beside the texels is a part of it."""
    kind = _kind(item)
    if kind == "box" or isinstance(item, Cookie):
        return kind
    return f"{kind} {item.wrap} {item.border_color}"


def storing(item: _Read, texels: int) -> Cost:
    """Return the seconds to make the form of so many texels, and the bytes that are kept."""
    held = _held(item, texels) * (1 if isinstance(item, Cookie) else item.units)
    kind = _kind(item)
    return Cost(held * SECONDS_PER_TEXEL[kind], float(held * BYTES_PER_KEPT_TEXEL[kind]))


def at_once(item: _Read, texels: int) -> float:
    """Return the bytes that only making it takes."""
    return float(_held(item, texels) * BYTES_TO_SUM_A_TEXEL * (_kind(item) == "summed_area"))


def _kind(item: _Read) -> str:
    if isinstance(item, Cookie):
        return "box"
    return item.filter if item.filter in TABLE_FILTERS else item.pyramid


def _held(item: _Read, texels: int) -> int:
    """A sum holds its mirrored copies, too."""
    if isinstance(item, Cookie) or _kind(item) != "summed_area":
        return texels
    return int(texels * 2 ** item.wrap.count("mirror"))
