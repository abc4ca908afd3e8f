"""A small studio: pictures as textures, scenes as dictionaries, pixels back."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.families import Meaning, TextureSpec
from api_schemas.output import RenderOutput
from api_schemas.scene import Scene
from api_schemas.solid import worn_depth, worn_size
from api_schemas.textures.image import ImageSpec
from worker.geometry.mesh import Mesh
from worker.images.image import Image
from worker.images.volume import Volume
from worker.models.model import Model, Part
from worker.rendering.texture_maker import TextureMaker
from worker.synthesis import closed_form, synthesize, synthesize_volume

Pixels = NDArray[np.float32]


class Studio:
    """Draws scenes whose textures are arrays."""

    def __init__(self, render: Callable[..., Any]) -> None:
        self._render = render
        self._arrays: dict[str, Pixels] = {}
        self.models: dict[str, Model] = {}
        self.facts: dict[str, Any] = {}
        self.found: dict[str, Any] = {}
        self.warnings: tuple[str, ...] = ()
        self.reports: list[tuple[float, str]] = []

    def texture(self, array: Any) -> dict[str, Any]:
        """Make a texture spec of an array (height, width) or (height, width, channels)."""
        pixels = np.ascontiguousarray(array, dtype=np.float32)
        if pixels.ndim == 2:
            pixels = pixels[:, :, None]
        name = hashlib.sha256(repr(pixels.shape).encode() + pixels.tobytes()).hexdigest()
        self._arrays[name] = pixels
        return {"technique": "image", "asset": name}

    def array(self, texture: dict[str, Any]) -> Pixels:
        """The array of a texture spec."""
        return self._arrays[texture["asset"]]

    def make(
        self,
        spec: TextureSpec,
        meaning: Meaning,
        proportion: tuple[int, int] = (1, 1),
        rendered: Mapping[str, Image] = MappingProxyType({}),
    ) -> Image:
        """Give a texture's picture: the array behind an image, else as its technique makes it."""
        if isinstance(spec, ImageSpec):
            return rendered.get(spec.asset) or Image(self._arrays[spec.asset], meaning)

        def found(spec: ImageSpec, meaning: Meaning) -> Image:
            return self.make(spec, meaning, (1, 1), rendered)

        return synthesize(spec, worn_size(spec, proportion), found, meaning)

    @property
    def maker(self) -> TextureMaker:
        """What makes textures of arrays, and all others as their techniques do."""

        def volume(spec: TextureSpec, meaning: Meaning) -> Volume:
            return synthesize_volume(spec, (worn_depth(spec),) * 3, meaning)

        return TextureMaker(self.make, volume, closed_form)

    def mesh(self, mesh: Mesh) -> dict[str, Any]:
        """Make a mesh spec of vertices."""
        arrays = (mesh.positions, mesh.normals, *mesh.uv_sets, mesh.triangles)
        more = (mesh.tangents, mesh.colors)
        name = hashlib.sha256(
            b"".join(repr(a.shape).encode() + a.tobytes() for a in arrays)
            + b"".join(b"-" if a is None else a.tobytes() for a in more)
            + mesh.kind.encode()
        ).hexdigest()
        part = Part(mesh, np.eye(4), None, None, "")
        self.models[name] = Model((part,), (), (), (), (), {}, ())
        return {"type": "model", "asset": name}

    def draw(
        self, scene: dict[str, Any], size: tuple[int, int] = (32, 32), supersampling: int = 1
    ) -> Pixels:
        """Draw a scene given as JSON; float32 (height, width, 4)."""
        return self.layers(scene, [], size, supersampling)["picture"]

    def layers(
        self,
        scene: dict[str, Any],
        names: Sequence[str],
        size: tuple[int, int] = (32, 32),
        supersampling: int = 1,
    ) -> dict[str, Pixels]:
        """Draw a scene with some layers; float32 (height, width, channels), by name."""
        rendering = self._render(
            Scene.model_validate_json(json.dumps(scene)),
            RenderOutput(size=list(size), supersampling=supersampling, layers=list(names)),
            self.maker,
            lambda mesh: self.models[mesh.asset],
            lambda fraction, stage: self.reports.append((fraction, stage)),
        )
        bands = list(rendering.bands)
        self.facts = rendering.timings | rendering.counts
        self.found = rendering.report
        self.warnings = rendering.warnings
        return {name: np.concatenate([band[name].pixels for band in bands]) for name in bands[0]}

    def poster(
        self, surface: dict[str, Any], size: tuple[int, int] = (32, 32), **more: Any
    ) -> Pixels:
        """Draw a surface on a square that fills the picture: v = n, uv = the pixel's place."""
        return self.draw(
            {
                "camera": {
                    "type": "orthographic",
                    "height": 2.0,
                    "pose": {"eye": [0.0, 0.0, 2.0]},
                },
                "lights": more.get("lights", []),
                "nodes": [
                    {
                        "mesh": {"type": "plane", "width": 2.0 * size[0] / size[1]},
                        "transform": more.get("transform", {}),
                        "surface": surface,
                    }
                ],
            },
            size,
            more.get("supersampling", 1),
        )

    def read(self, picture: dict[str, Any], u: float, v: float, **how: Any) -> Pixels:
        """Read a texture at one place with no footprint, as a colour."""
        mapped = {
            "texture": picture,
            "transform": {"scale": [0.0, 0.0], "offset": [u, v]},
            **how,
        }
        return self.poster({"technique": "unlit", "color": mapped}, (1, 1))[0, 0]
