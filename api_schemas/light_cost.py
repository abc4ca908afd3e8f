"""What shadows and cookies cost: maps drawn once for each picture, readings for each sample."""

from collections.abc import Iterator, Sequence

from api_schemas.cookies import Cookie
from api_schemas.cost import Cost
from api_schemas.lights import AmbientLight, Light, PointLight, SpotLight
from api_schemas.shadows import Shadow

WIDEST_CONE = 1.2
"""Half angle beyond which a spot light's map has six faces: one is coarse in the middle."""

_SECONDS_PER_TAP = 1e-8
_SECONDS_PER_TEXEL = 2.5e-8
_BYTES_PER_TEXEL = 4


def faces_of(light: Light) -> int:
    """Return how many shadow maps a light draws, if it draws any."""
    if isinstance(light, SpotLight):
        return 6 if light.outer_angle > WIDEST_CONE else 1
    return 6 if isinstance(light, PointLight) else 1


def shadow_maps(lights: Sequence[Light], drawing: float) -> Cost:
    """Return the cost of all shadow maps; `drawing` is the seconds that all things take once."""
    shadows = list(_shadows(lights))
    faces = sum(count for count, _ in shadows)
    texels = sum(count * shadow.resolution**2 for count, shadow in shadows)
    # One array holds them all, each as large as the largest.
    largest = max((shadow.resolution for _, shadow in shadows), default=0)
    seconds = texels * _SECONDS_PER_TEXEL + faces * drawing
    return Cost(seconds, float(faces * largest**2 * _BYTES_PER_TEXEL))


def seconds_of_shadows(lights: Sequence[Light]) -> float:
    """Return the seconds that asking all shadow maps takes for one sample."""
    taps = sum((2 * shadow.radius + 2) ** 2 for _, shadow in _shadows(lights))
    return taps * _SECONDS_PER_TAP


def cookies_of(lights: Sequence[Light]) -> list[Cookie]:
    """Return the pictures before lights."""
    return [
        light.cookie
        for light in lights
        if not isinstance(light, AmbientLight) and light.cookie is not None
    ]


def _shadows(lights: Sequence[Light]) -> Iterator[tuple[int, Shadow]]:
    for light in lights:
        if not isinstance(light, AmbientLight) and light.shadow is not None:
            yield faces_of(light), light.shadow
