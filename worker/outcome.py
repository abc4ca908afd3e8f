"""What a texture technique makes: a picture, and what else came of making it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from worker.images.image import Image


@dataclass(frozen=True, slots=True)
class Outcome:
    """A picture with what stands beside it.

    Attributes:
        image: The picture; all that a texture, or a surface, that holds this one sees.
        layers: More pictures of the same size, by the names that the spec's class declares.
        report: What there is to say in words and numbers: JSON-able, told with the job's result.

    Raises:
        ValueError: A layer is of another size.
    """

    image: Image
    layers: Mapping[str, Image] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse what does not lie beside the picture."""
        size = self.image.pixels.shape[:2]
        for name, layer in self.layers.items():
            if layer.pixels.shape[:2] != size:
                raise ValueError(f"{name} is {layer.pixels.shape[:2]}; the picture is {size}")
