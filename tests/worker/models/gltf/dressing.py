"""A triangle that wears a material, with a picture and three sets of texture coordinates."""

from typing import Any

from tests.worker.models.gltf.building import Builder, data_uri, png, shown
from worker.models.gltf.reader import read
from worker.models.model import Model

TRANSLUCENT = png(alpha=True)


def model_of(
    material: dict[str, Any] | None, picture: bytes = TRANSLUCENT, **members: Any
) -> Model:
    builder = Builder(**members)
    builder.add("images", {"uri": data_uri(picture, "image/png")})
    builder.json.setdefault("textures", [{"source": 0}])
    sets = {f"TEXCOORD_{n}": builder.accessor([[0, 0]] * 3) for n in range(3)}
    worn = {}
    if material is not None:
        worn["material"] = builder.add("materials", material)
    builder.mesh(attributes=sets, **worn)
    builder.json |= shown(0)
    if material is not None:
        used = sorted(_extensions(material))
        if used:
            builder.json["extensionsUsed"] = used
    return read(builder.glb(), {})


def _extensions(value: Any) -> set[str]:
    if isinstance(value, list):
        return set().union(*map(_extensions, value))
    if not isinstance(value, dict):
        return set()
    inner = set().union(set(), *map(_extensions, value.values()))
    return inner | set(value.get("extensions", {}))


def surface_of(material: dict[str, Any] | None, **members: Any) -> Any:
    return model_of(material, **members).surfaces[0].surface
