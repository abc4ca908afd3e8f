"""Which extensions a document uses, where they stand, and what that means for the picture."""

import re
from collections.abc import Iterator
from typing import Any, Final

from worker.models.gltf.document.root import Document
from worker.models.gltf.faults import spoken, unsupported, unusable

_MATERIAL: Final = r"/materials/\d+"
_PLACES: Final = {
    "KHR_texture_transform": re.compile(r"/materials/\d+/.*Texture"),
    "KHR_materials_unlit": re.compile(_MATERIAL),
    "KHR_materials_emissive_strength": re.compile(_MATERIAL),
    "KHR_materials_ior": re.compile(_MATERIAL),
    "KHR_materials_specular": re.compile(_MATERIAL),
    "KHR_materials_clearcoat": re.compile(_MATERIAL),
    "KHR_materials_anisotropy": re.compile(_MATERIAL),
    "KHR_lights_punctual": re.compile(r"|/nodes/\d+"),
    "KHR_mesh_quantization": re.compile(r"(?!)"),
}
"""The extensions that are read, and the objects on which they may stand."""

QUANTIZATION: Final = "KHR_mesh_quantization"


def check_extensions(document: Document, value: dict[str, Any]) -> list[str]:
    """Check what is declared against what is there, and what is required against what is read.

    Args:
        document: The document.
        value: Its JSON.

    Returns:
        Warnings: the extensions that are used and not read.

    Raises:
        UnusableAssetError: A required extension is not read (`asset_unsupported`); one is used
            without a word or in a wrong place (`asset_unusable`).
    """
    for index, name in enumerate(document.extensions_required):
        if name not in _PLACES:
            raise unsupported(
                f"/extensionsRequired/{index}", f"the extension {spoken(name)} is not supported"
            )
        if name not in document.extensions_used:
            raise unusable(f"/extensionsRequired/{index}", "the extension is not in extensionsUsed")
    declared = set(document.extensions_used)
    for place, name in _present(value):
        if name not in declared:
            raise unusable(place, f"the extension {spoken(name)} is not in extensionsUsed")
        if name in _PLACES and not _PLACES[name].fullmatch(place):
            raise unusable(place, f"{name} cannot stand here")
    return [
        f"the extension {spoken(name)} is ignored"
        for name in document.extensions_used
        if name not in _PLACES
    ]


def _present(value: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield place and name of every extension object outside of extras."""
    waiting: list[tuple[str, Any]] = [("", value)]
    while waiting:
        place, item = waiting.pop()
        if isinstance(item, dict):
            extensions = item.get("extensions")
            if isinstance(extensions, dict):
                yield from ((place, name) for name in extensions)
            waiting += [
                (f"{place}/{spoken(key)}", child)
                for key, child in item.items()
                if isinstance(child, dict | list) and key != "extras"
            ]
        elif isinstance(item, list):
            waiting += [
                (f"{place}/{index}", child)
                for index, child in enumerate(item)
                if isinstance(child, dict | list)
            ]
