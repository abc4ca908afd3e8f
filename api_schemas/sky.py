"""What is made of an environment before it shines: textures as anyone could ask for them."""

from collections.abc import Mapping
from dataclasses import dataclass

from api_schemas.cost import Cost
from api_schemas.environment import Environment, Surroundings
from api_schemas.layouts.cube import CubeSpec
from api_schemas.layouts.hemispheres import HemispheresSpec
from api_schemas.layouts.latlong import LatlongSpec
from api_schemas.textures.convert_layout import ConvertLayoutSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.textures.irradiance import IrradianceSpec
from api_schemas.textures.prefiltered_environment import PrefilteredEnvironmentSpec

SKY_ROUGHNESS = [0.2, 0.4, 0.6, 0.8, 1.0]
"""Of the levels of a rough cube: lib/environment.glsl counts on equal steps from 0 to 1."""
SKY_SECONDS_PER_SAMPLE = 1.5e-7
SKY_SECONDS_TO_COMPILE = 0.5
_SECONDS_PER_DISC_TEXEL = 3e-6
_BYTES_PER_DISC_TEXEL = 400.0
LIGHT_FROM_BELOW = -0.1
"""L1-1 / L00 below which a picture is likely to stand on its head: outdoors and indoors light comes
from above, and of ten probes in use the ratio is 0.2 to 1.3."""
SKY_MAPS = 3
"""Texture units that an environment takes, and maps then cannot."""

SKY_CUBE = CubeSpec(technique="cube", arrangement="column", orientation="gl")
"""How a cube lies that OpenGL takes as it is."""
SKY_LAYOUTS: Mapping[str, CubeSpec | HemispheresSpec] = {
    "cube": SKY_CUBE,
    "hemispheres": HemispheresSpec(technique="hemispheres"),
}
"""Of what a thing sees around itself."""


@dataclass(frozen=True, slots=True)
class SkyTextures:
    """As it is, if it must be brought to a cube; as rough mirrors see it; as chalk shows it."""

    whole: ConvertLayoutSpec | None
    rough: PrefilteredEnvironmentSpec
    matt: IrradianceSpec

    def cost(self) -> Cost:
        """Estimate what making them takes, the environment itself left out."""
        cost = Cost(SKY_SECONDS_TO_COMPILE)
        for texture in (self.whole, self.rough, self.matt):
            if texture is not None:
                width, height = texture.surface_size
                cost += texture.cost(width * height)
        return cost


def surroundings_cost(surroundings: Surroundings, shading: float, drawing: float) -> Cost:
    """Estimate the six pictures of a scene that one thing mirrors, and what is made of them.

    Args:
        surroundings: How finely.
        shading: Seconds that a sample takes.
        drawing: Seconds that all vertices take once.
    """
    samples = 6 * surroundings.side**2 * 4
    image = ImageSpec(technique="image", asset="0" * 64)
    made = sky_textures(Environment(texture=image)).cost()
    made += Cost(samples * shading + 6 * drawing, samples * 20.0)
    if surroundings.layout == "cube":
        return made
    texels = 2 * (2 * surroundings.side) ** 2
    return made + Cost(texels * _SECONDS_PER_DISC_TEXEL, texels * _BYTES_PER_DISC_TEXEL)


def sky_textures(environment: Environment) -> SkyTextures:
    """Return the textures of an environment; a picture in latitude and longitude is read itself."""
    picture, layout = environment.texture, environment.layout
    whole = None
    if not isinstance(layout, LatlongSpec):
        whole = ConvertLayoutSpec(
            technique="convert_layout", environment=picture, layout=layout, to=SKY_CUBE
        )
    return SkyTextures(
        whole=whole,
        rough=PrefilteredEnvironmentSpec(
            technique="prefiltered_environment",
            environment=picture,
            layout=layout,
            to=SKY_CUBE,
            roughness=SKY_ROUGHNESS,
        ),
        matt=IrradianceSpec(
            technique="irradiance",
            environment=picture,
            layout=layout,
            to=SKY_CUBE,
            method=environment.matt,
        ),
    )
