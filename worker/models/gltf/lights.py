"""KHR_lights_punctual where its nodes stand, as lights of our language.

glTF counts in lux and candela, we in W/m2 and W/sr. The numbers are taken over as they are: then a
picture's numbers are luminances in cd/m2 instead of radiances, and nothing else changes.
"""

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from api_schemas.lights import DirectionalLight, Light, PointLight, SpotLight
from worker.models.gltf.document import scene as gltf


def light_at(light: gltf.Light, matrix: NDArray[np.float64]) -> Light | str:
    """Place a light, which shines along its own -z.

    Args:
        light: What shines.
        matrix: model_from_node; its scale does not matter, as the extension says.

    Returns:
        The light, or why there is none.
    """
    try:
        placed = _placed(light, matrix)
    except ValidationError:
        placed = None
    return placed or "a light beyond what can be drawn, or of an unknown type, is left out"


def _placed(light: gltf.Light, matrix: NDArray[np.float64]) -> Light | None:
    position = matrix[:3, 3].tolist()
    length = float(np.linalg.norm(matrix[:3, 2]))
    direction = (-matrix[:3, 2] / length).tolist() if length > 0 else [0.0, 0.0, -1.0]
    if light.type == "directional":
        return DirectionalLight(
            type="directional",
            direction=direction,
            color=light.color,
            irradiance=light.intensity,
        )
    if light.type == "point":
        return PointLight(
            type="point", position=position, color=light.color, intensity=light.intensity
        )
    if light.type == "spot" and light.spot is not None:
        return SpotLight(
            type="spot",
            position=position,
            direction=direction,
            color=light.color,
            intensity=light.intensity,
            inner_angle=light.spot.inner_cone_angle,
            outer_angle=light.spot.outer_cone_angle,
        )
    return None
