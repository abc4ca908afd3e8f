"""What must hold for every technique in the folders, new ones included."""

import copy

import numpy as np
import pytest
from hypothesis import given, settings
from pydantic import TypeAdapter

from api_schemas.assets import ImageFacts
from api_schemas.estimate import estimate
from api_schemas.families import TextureSpec
from api_schemas.feasibility import obstacles
from api_schemas.language import FAMILIES
from api_schemas.layouts.cube import CubeSpec
from api_schemas.maps import Map
from api_schemas.members import Texture
from api_schemas.output import RenderOutput, TextureOutput
from api_schemas.requests import RenderRequest, TextureRequest
from api_schemas.scene import Scene
from api_schemas.textures.image import ImageSpec
from api_schemas.walk import parts
from tests.spec_strategies import ASSET, bodies
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis import closed_form, synthesize, synthesize_volume

SIZE = (16, 16)
TEXTURES = sorted(FAMILIES["textures"])
SURFACES = sorted(FAMILIES["surfaces"])
TEXTURE = TypeAdapter(Texture)
FACTS = ImageFacts(
    sha256=ASSET, media_type="image/png", format="png", bytes=1, kind="image",
    width=7, height=5, channels=3, bits=8, float=False, has_alpha=False,
)  # fmt: skip
STAGE = {
    "camera": {"type": "orthographic", "height": 3.0, "pose": {"eye": [0, 0, 3]}},
    "lights": [
        {"type": "ambient"},
        {"type": "directional", "direction": [1, -1, -1]},
        {"type": "point", "position": [-2, 2, 2], "intensity": 5},
    ],
}
BALL = {"mesh": {"type": "sphere"}}
BOX = {"mesh": {"type": "box"}}


def picture(spec, meaning):
    assert spec.asset == ASSET
    columns, rows = np.meshgrid(np.linspace(0, 1, 7), np.linspace(0, 1, 5))
    pixels = np.stack([columns, rows, columns * rows], axis=-1).astype(np.float32)
    pixels.setflags(write=False)  # whoever changes its input fails
    return Image(pixels, meaning)


def seconds(spec):
    request = TextureRequest(texture=spec, output=TextureOutput(size=list(SIZE)))
    return estimate(request, {ASSET: FACTS}).seconds


def refused(spec):
    return any(
        True for _, part in parts(spec) if isinstance(part, TextureSpec) for _ in part.refusals()
    )


def specs(name):
    return bodies(FAMILIES["textures"][name], levels=1).map(
        lambda body: TEXTURE.validate_python({"technique": name, **body})
    )


@pytest.mark.parametrize("name", TEXTURES)
def test_any_valid_spec_runs_is_finite_deterministic_and_leaves_its_spec_alone(name):
    @settings(max_examples=20)
    @given(specs(name))
    def holds(spec):
        if seconds(spec) > 0.1 or refused(spec):
            # As valid, but a technique's own tests have the patience, or it cannot be done
            return
        before = copy.deepcopy(spec)

        try:
            image = synthesize(spec, SIZE, picture)
        except RenderError as error:
            assert error.code == "exemplar_unusable"  # noqa: PT017 only a mask of noise can tell
            return
        again = synthesize(spec, SIZE, picture)

        assert image.pixels.shape[:2] == SIZE[::-1]
        assert image.pixels.dtype == np.float32
        assert np.isfinite(image.pixels).all()
        assert image.pixels.tobytes() == again.pixels.tobytes()
        assert spec == before

    holds()


@pytest.mark.gl
@pytest.mark.parametrize("name", SURFACES)
def test_any_valid_surface_is_drawn_finite_deterministic_and_leaves_its_spec_alone(name):
    # Imported here: they need OpenGL.
    from worker.rendering.packing import PICTURE  # noqa: PLC0415
    from worker.rendering.renderer import render  # noqa: PLC0415
    from worker.rendering.texture_maker import TextureMaker  # noqa: PLC0415

    def faceless(part):
        """Whether it is a map that wants a cube of an upload that is none."""
        cube = isinstance(part[1], Map) and isinstance(part[1].layout, CubeSpec)
        return cube and isinstance(part[1].texture, ImageSpec)

    def drawn(scene):
        output = RenderOutput(size=list(SIZE), supersampling=1)

        def worn(spec, meaning, proportion=(1, 1)):
            # The renderer keeps the small ones, a surface's own tables, for those that come after.
            if max(spec.surface_size) <= 64:
                return synthesize(spec, spec.surface_size, picture, meaning)
            size = (SIZE[0] * proportion[0], SIZE[1] * proportion[1])
            return synthesize(spec, size, picture, meaning)

        def volume(spec, meaning):
            return synthesize_volume(spec, (8, 8, 8), meaning)

        maker = TextureMaker(worn, volume, closed_form)

        rendering = render(
            scene,
            output,
            maker,
            lambda mesh: pytest.fail("there is no model in the scene"),
            unheard,
        )
        return np.concatenate([band[PICTURE].pixels for band in rendering.bands])

    # Each example compiles a program of its own.
    @settings(max_examples=8)
    @given(bodies(FAMILIES["surfaces"][name], levels=1, number_limit=100))
    def holds(surface):
        shape = BOX if FAMILIES["surfaces"][name].fills_box else BALL
        scene = Scene.model_validate({**STAGE, "nodes": [{**shape, "surface": surface}]})
        if list(obstacles(RenderRequest(scene=scene))) or any(map(faceless, parts(scene))):
            return
        before = copy.deepcopy(scene)

        pixels = drawn(scene)

        assert pixels.shape == (*SIZE[::-1], 4)
        assert np.isfinite(pixels).all()
        assert pixels[..., 3].any() or scene.nodes[0].surface.alpha_mode != "opaque"
        assert pixels.tobytes() == drawn(scene).tobytes()
        assert scene == before

    holds()


def unheard(_share, _stage):
    pass
