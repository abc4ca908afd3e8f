"""What turns textures of the language into what a surface is drawn with."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol

from api_schemas.families import Meaning, TextureSpec
from worker.closed_form import ClosedForm
from worker.images.image import Image
from worker.images.volume import Volume


class PictureMaker(Protocol):
    """Makes pictures."""

    def __call__(
        self,
        spec: TextureSpec,
        meaning: Meaning,
        proportion: tuple[int, int] = (1, 1),
        rendered: Mapping[str, Image] = MappingProxyType({}),
        /,
    ) -> Image:
        """Return the picture, read as colour or as data.

        Unless it has a size of its own, its sides are whole multiples of the proportion's. Assets
        that nobody uploaded are sought among the rendered ones.
        """


class ClosedFormMaker(Protocol):
    """Knows formulas."""

    def __call__(
        self, spec: TextureSpec, *, solid: bool, meaning: Meaning = "colour"
    ) -> ClosedForm | None:
        """Return a texture as a formula in the plane or in space, if there is one."""


@dataclass(frozen=True, slots=True)
class TextureMaker:
    """Makes pictures; and volumes and formulas, of textures that can be such."""

    picture: PictureMaker
    volume: Callable[[TextureSpec, Meaning], Volume]
    closed_form: ClosedFormMaker

    def __call__(self, spec: TextureSpec, meaning: Meaning, /) -> Image:
        """Return the picture of a texture, square unless it has a size of its own."""
        return self.picture(spec, meaning)
