"""Whether the assets a request speaks of are what it takes them for, told from their facts."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from api_schemas.assets import AssetFacts, ImageFacts, MaterialLibraryFacts, ModelFacts
from api_schemas.base import Schema
from api_schemas.camera import ModelCamera
from api_schemas.families import LayoutSpec
from api_schemas.maps import TABLE_FILTERS, TABLE_SIDE_MAX, Map
from api_schemas.model_mesh import ModelMesh
from api_schemas.obstacle import Obstacle
from api_schemas.requests import RenderRequest, Request
from api_schemas.textures.image import ImageSpec
from api_schemas.textures.six_faces import FACES, SixFacesSpec
from api_schemas.walk import escaped, parts

NAMES_TOLD: Final = 10
LONGEST_NAME: Final = 64
SAFE: Final = " ._-+()/"

NOUNS: Final = {
    "image": "a picture",
    "model": "a model",
    "buffer": "a buffer",
    "material_library": "a material library",
}
BESIDE: Final[Mapping[str, tuple[str, ...]]] = {
    "gltf": ("image", "buffer"),
    "glb": ("image", "buffer"),
    "obj": ("material_library",),
}
"""What the files that a model names may be, by its format. A picture's bytes may be a buffer's."""
PICTURES: Final = ("image",)


def misuses(request: Request, facts: Mapping[str, AssetFacts]) -> Iterator[Obstacle]:
    """Yield what the facts say against a request, in the order of the body.

    Assets without facts are passed over: that they are missing is another obstacle.
    """
    for pointer, part in parts(request):
        if isinstance(part, ImageSpec):
            yield from _kind(facts.get(part.asset), PICTURES, f"{pointer}/asset")
        elif isinstance(part, ModelMesh):
            yield from _model(part, facts, pointer)
        elif isinstance(part, Map):
            yield from _table(part, facts, pointer)
        yield from _shape(part, facts, pointer)
    if isinstance(request, RenderRequest):
        yield from _camera(request, facts)


def _shape(part: Schema, facts: Mapping[str, AssetFacts], pointer: str) -> Iterator[Obstacle]:
    """Tell of a picture of all directions that has not the shape its layout has."""
    if isinstance(part, SixFacesSpec):
        yield from _faces(part, facts, pointer)
        return
    for name in ("texture", "environment"):
        layout, picture = getattr(part, "layout", None), getattr(part, name, None)
        if isinstance(layout, LayoutSpec) and isinstance(picture, SixFacesSpec):
            if layout != picture.layout:
                message = f"six faces in a {picture.arrangement} need the layout of such a cube"
                yield Obstacle("layout_mismatch", f"{pointer}/layout", message)
            continue
        if not isinstance(layout, LayoutSpec) or not isinstance(picture, ImageSpec):
            continue
        found, (width, height) = facts.get(picture.asset), layout.proportion
        if isinstance(found, ImageFacts) and found.width * height != found.height * width:
            message = (
                f"{layout.technique} needs {width} to {height}; "
                f"the picture is {found.width} x {found.height}"
            )
            yield Obstacle("layout_mismatch", f"{pointer}/{name}/asset", message)


def _faces(cube: SixFacesSpec, facts: Mapping[str, AssetFacts], pointer: str) -> Iterator[Obstacle]:
    for name in FACES:
        face = getattr(cube, name)
        found = facts.get(face.asset) if isinstance(face, ImageSpec) else None
        if isinstance(found, ImageFacts) and found.width != found.height:
            message = f"a face is square; the picture is {found.width} x {found.height}"
            yield Obstacle("layout_mismatch", f"{pointer}/{name}/asset", message)


def needed(mesh: ModelMesh, facts: Mapping[str, AssetFacts]) -> dict[str, tuple[str, ...]]:
    """Return the names of the files a model cannot do without, and what kinds each may be.

    What a material library needs is known only where the library is given.
    """
    model = facts.get(mesh.asset)
    if not isinstance(model, ModelFacts):
        return {}
    found = dict.fromkeys(model.files, BESIDE.get(model.format, PICTURES))
    for name in model.files:
        library = facts.get(mesh.files.get(name, ""))
        if isinstance(library, MaterialLibraryFacts):
            found |= {picture: PICTURES for picture in library.files if picture not in found}
    return found


def _kind(found: AssetFacts | None, wanted: Sequence[str], pointer: str) -> Iterator[Obstacle]:
    if found is not None and found.kind not in wanted:
        nouns = " or ".join(NOUNS[kind] for kind in wanted)
        message = f"{nouns} is wanted here; the asset is {NOUNS[found.kind]}"
        yield Obstacle("asset_kind_mismatch", pointer, message)


def _table(mapped: Map, facts: Mapping[str, AssetFacts], pointer: str) -> Iterator[Obstacle]:
    texture = getattr(mapped, "texture", None)
    found = facts.get(texture.asset) if isinstance(texture, ImageSpec) else None
    if mapped.filter not in TABLE_FILTERS or not isinstance(found, ImageFacts):
        return
    doubled = mapped.filter == "summed_area" and mapped.wrap[1] == "mirror"
    tallest = TABLE_SIDE_MAX // 2 if doubled else TABLE_SIDE_MAX
    if found.width > TABLE_SIDE_MAX or found.height > tallest:
        message = (
            f"the picture has {found.width} x {found.height} texels; a table for {mapped.filter} "
            f"holds at most {TABLE_SIDE_MAX} x {tallest}"
        )
        yield Obstacle("asset_too_large", f"{pointer}/texture/asset", message)


def _model(mesh: ModelMesh, facts: Mapping[str, AssetFacts], pointer: str) -> Iterator[Obstacle]:
    model = facts.get(mesh.asset)
    yield from _kind(model, ("model",), f"{pointer}/asset")
    if not isinstance(model, ModelFacts):
        return
    wanted = needed(mesh, facts)
    missing = [name for name in wanted if name not in mesh.files]
    if missing:
        shown = ", ".join(_shown(name) for name in missing[:NAMES_TOLD])
        more = f" and {len(missing) - NAMES_TOLD} more" if len(missing) > NAMES_TOLD else ""
        message = f"the model needs files of these names: {shown}{more}"
        yield Obstacle("asset_file_missing", f"{pointer}/files", message)
    for name, asset in mesh.files.items():
        if name in wanted:
            place = f"{pointer}/files/{escaped(name)}"
            yield from _kind(facts.get(asset), wanted[name], place)
    if mesh.scene is not None and mesh.scene >= model.scenes:
        message = f"the model has {model.scenes} scenes, counted from 0"
        yield Obstacle("model_part_unknown", f"{pointer}/scene", message)
    materials = [change.material for change in mesh.materials]
    for index in _absent(materials, model.materials):
        place = f"{pointer}/materials/{index}/material"
        yield _unknown("materials", len(model.materials), place)
    for index in _absent([change.node for change in mesh.nodes], model.nodes):
        yield _unknown("nodes", len(model.nodes), f"{pointer}/nodes/{index}/node")


def _camera(request: RenderRequest, facts: Mapping[str, AssetFacts]) -> Iterator[Obstacle]:
    camera = request.scene.camera
    if not isinstance(camera, ModelCamera):
        return
    meshes = [part for _, part in parts(request) if isinstance(part, ModelMesh)]
    models = [facts.get(mesh.asset) for mesh in meshes if mesh.scene is None]
    known = [model.cameras for model in models if isinstance(model, ModelFacts)]
    if len(known) < len(meshes):
        return  # facts tell the cameras of a model's default scene only
    if not any(known):
        message = "no model of the scene brings a camera"
        yield Obstacle("model_part_unknown", "/scene/camera", message)
    elif camera.camera is not None and all(_absent([camera.camera], names) for names in known):
        yield _unknown("cameras", max(map(len, known)), "/scene/camera/camera")


def _absent(wanted: Sequence[str | int], names: Sequence[str]) -> list[int]:
    """Return the places in `wanted` of names and indices that are not there."""
    there = frozenset(names) if wanted else frozenset()
    return [
        place
        for place, part in enumerate(wanted)
        if not (part < len(names) if isinstance(part, int) else part in there)
    ]


def _unknown(what: str, count: int, pointer: str) -> Obstacle:
    message = f"none of the model's {count} {what} has this name or, counted from 0, this index"
    return Obstacle("model_part_unknown", pointer, message)


def _shown(name: str) -> str:
    """Return a name out of a stranger's file with nothing in it that could fool a reader."""
    safe = "".join(sign if sign.isalnum() or sign in SAFE else "?" for sign in name)
    return safe if len(safe) <= LONGEST_NAME else f"{safe[: LONGEST_NAME - 3]}..."
