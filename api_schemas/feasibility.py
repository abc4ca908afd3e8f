"""Requests that are well-formed and still cannot be drawn: told before any work starts."""

from collections.abc import Iterator, Sequence

from api_schemas.camera import Camera, FramedCamera, ModelCamera
from api_schemas.cookies import COOKIES_MAX
from api_schemas.environment import Environment, Surroundings
from api_schemas.families import LayoutSpec, TextureSpec
from api_schemas.geometry import IDENTITY, Affine, Vector3, affine, cross, length, triple
from api_schemas.light_cost import cookies_of
from api_schemas.lights import DirectionalLight, Light, PointLight, SpotLight
from api_schemas.map_feasibility import formula_obstacles, map_obstacles
from api_schemas.maps import MAPS_MAX, Map
from api_schemas.meshes import Box
from api_schemas.model_mesh import ModelMesh
from api_schemas.obstacle import Obstacle
from api_schemas.output import SIDE_MAX, RenderOutput, TextureOutput
from api_schemas.requests import Request, TextureRequest
from api_schemas.scene import NODES_MAX, Node
from api_schemas.sky import SKY_MAPS
from api_schemas.solid import flat_parts
from api_schemas.surface_spec import SurfaceSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.transforms import MatrixPlacement, Placement
from api_schemas.walk import deepest, escaped, parts

LEVELS_MAX = 32
TEXTURES_MAX = 256
SHORTEST_DIRECTION = 1e-12
SMALLEST_SINE = 1e-7
"""Sine of the angle between viewing and up direction below which float32 cannot tell up."""


def obstacles(request: Request) -> list[Obstacle]:
    """Return all that stands in the way, in the order of the body; empty when all is well."""
    found = list(_limits(request))
    if found:
        return found
    found += _refusals(request)
    if isinstance(request, TextureRequest):
        output = request.output
        found += [*_slices(request), *_layer_names(request), *_layers(output)]
        return [*found, *_mipmaps(output)]
    found += _camera(request.scene.camera)
    found += _cookies(request.scene.lights or [])
    for index, light in enumerate(request.scene.lights or []):
        found += _light(light, f"/scene/lights/{index}")
    for index, node in enumerate(request.scene.nodes):
        found += _node(node, f"/scene/nodes/{index}", IDENTITY)
    return found + list(_layers(request.output)) + list(_turntable(request.output))


def assets_in(request: Request) -> list[tuple[str, str]]:
    """Return the pointer and the SHA-256 of every asset a request speaks of."""
    found = []
    for pointer, part in parts(request):
        if isinstance(part, ImageSpec | ModelMesh):
            found.append((f"{pointer}/asset", part.asset))
        if isinstance(part, ModelMesh):
            found += [
                (f"{pointer}/files/{escaped(name)}", asset) for name, asset in part.files.items()
            ]
    return found


def _limits(request: Request) -> Iterator[Obstacle]:
    levels, place = deepest(request, (TextureSpec, Node))
    if levels > LEVELS_MAX:
        yield Obstacle(
            "nesting_too_deep", place, f"{levels} levels within each other; at most {LEVELS_MAX}"
        )
    textures, nodes = 0, 0
    surrounded = any(isinstance(part, Environment | Surroundings) for _, part in parts(request))
    most = MAPS_MAX - SKY_MAPS * surrounded
    for pointer, part in parts(request):
        textures += isinstance(part, TextureSpec)
        nodes += isinstance(part, Node)
        if isinstance(part, SurfaceSpec):
            maps = sum(value.units for _, value in parts(part) if isinstance(value, Map))
            if maps > most:
                yield Obstacle(
                    "too_many_maps", pointer, f"{maps} maps on one surface; at most {most}"
                )
            yield from formula_obstacles(part, pointer)
        if isinstance(part, LayoutSpec) and (mistake := part.mistake()) is not None:
            field, message = mistake
            yield Obstacle("layout_impossible", f"{pointer}/{field}", message)
        if isinstance(part, Map):
            yield from map_obstacles(part, pointer)
    for count, limit, things in (
        (textures, TEXTURES_MAX, "textures"),
        (nodes, NODES_MAX, "scene nodes"),
    ):
        if count > limit:
            yield Obstacle("too_many_nodes", "", f"{count} {things}; at most {limit}")


def _refusals(request: Request) -> Iterator[Obstacle]:
    for pointer, part in parts(request):
        if isinstance(part, TextureSpec):
            for refusal in part.refusals():
                place = f"{pointer}/{refusal.field}" if refusal.field else pointer
                yield Obstacle(refusal.code, place, refusal.message)


def _slices(request: TextureRequest) -> Iterator[Obstacle]:
    output = request.output
    if output.slices is None:
        return
    for place, part in flat_parts(request.texture, "/texture"):
        yield Obstacle("texture_not_solid", place, f"{part.technique} does not fill space")
    if output.layers:
        yield Obstacle("layer_unknown", "/output/layers", "a solid has no layers of its own")
    if output.arrangement != "atlas" and output.format != "exr":
        message = f"a PNG holds no slices as {output.arrangement}"
        yield Obstacle("layers_need_exr", "/output/arrangement", message)
    if output.arrangement == "parts" and output.mipmaps:
        message = "a file of several parts holds one size of each"
        yield Obstacle("mipmaps_need_one_part", "/output/mipmaps", message)
    if max(output.file_size) > SIDE_MAX:
        width, height = output.file_size
        yield Obstacle(
            "atlas_too_large",
            "/output/slices",
            f"the slices beside each other take {width} x {height} pixels; "
            f"at most {SIDE_MAX} along a side",
        )


def _layer_names(request: TextureRequest) -> Iterator[Obstacle]:
    texture = request.texture
    for index, name in enumerate(request.output.layers):
        if not texture.has_layer(name):
            known = ", ".join(filter(texture.has_layer, texture.layers)) or "none"
            yield Obstacle(
                "layer_unknown",
                f"/output/layers/{index}",
                f"{texture.technique} has no such layer; it has {known}",
            )


def _turntable(output: RenderOutput) -> Iterator[Obstacle]:
    turntable = output.turntable
    if turntable is None:
        return
    if turntable.arrangement == "layers" and output.format != "exr":
        message = "a PNG holds no frames as layers"
        yield Obstacle("layers_need_exr", "/output/turntable/arrangement", message)
    if max(output.file_size) > SIDE_MAX:
        width, height = output.file_size
        yield Obstacle(
            "atlas_too_large",
            "/output/turntable/frames",
            f"the frames beside each other take {width} x {height} pixels; "
            f"at most {SIDE_MAX} along a side",
        )


def _mipmaps(output: TextureOutput) -> Iterator[Obstacle]:
    if output.mipmaps and output.format != "exr":
        yield Obstacle(
            "mipmaps_need_exr", "/output/mipmaps", "a PNG holds one size; an EXR holds them all"
        )


def _layers(output: RenderOutput | TextureOutput) -> Iterator[Obstacle]:
    if output.format != "exr" and len(output.layers) > 1:
        yield Obstacle(
            "layers_need_exr",
            "/output/layers",
            f"a PNG shows one layer, not {len(output.layers)}; an EXR holds them all",
        )


def _camera(camera: Camera | None) -> Iterator[Obstacle]:
    code = "camera_degenerate"
    pointer = "/scene/camera"
    if camera is None or isinstance(camera, ModelCamera):
        return
    if isinstance(camera, FramedCamera):
        direction = triple(camera.direction)
        if length(direction) < SHORTEST_DIRECTION:
            yield Obstacle(code, f"{pointer}/direction", "the direction has no length")
        else:
            yield from _upright(direction, triple(camera.up), f"{pointer}/up")
        return
    if camera.near >= camera.far:
        yield Obstacle(
            code, f"{pointer}/near", f"near {camera.near:g} is not below far {camera.far:g}"
        )
    pose = camera.pose
    if isinstance(pose, MatrixPlacement):
        placed = affine(pose)
        if placed is None or placed.is_degenerate():
            yield Obstacle(
                code, f"{pointer}/pose/matrix", "the matrix is not an invertible affine map"
            )
        return
    eye, target, up = triple(pose.eye), triple(pose.target), triple(pose.up)
    view = (target[0] - eye[0], target[1] - eye[1], target[2] - eye[2])
    if length(view) < SHORTEST_DIRECTION:
        yield Obstacle(code, f"{pointer}/pose/target", "eye and target are the same point")
    else:
        yield from _upright(view, up, f"{pointer}/pose/up")


def _upright(view: Vector3, up: Vector3, pointer: str) -> Iterator[Obstacle]:
    code = "camera_degenerate"
    if length(up) < SHORTEST_DIRECTION:
        yield Obstacle(code, pointer, "up has no direction")
    elif length(cross(view, up)) <= SMALLEST_SINE * length(view) * length(up):
        yield Obstacle(code, pointer, "the camera looks along its up vector")


def _cookies(lights: Sequence[Light]) -> Iterator[Obstacle]:
    pictures = {cookie.unit for cookie in cookies_of(lights)}
    if len(pictures) > COOKIES_MAX:
        yield Obstacle(
            "too_many_maps",
            "/scene/lights",
            f"{len(pictures)} pictures before lights; at most {COOKIES_MAX}",
        )


def _light(light: Light, pointer: str) -> Iterator[Obstacle]:
    if (
        isinstance(light, DirectionalLight | SpotLight)
        and length(triple(light.direction)) < SHORTEST_DIRECTION
    ):
        yield Obstacle("light_degenerate", f"{pointer}/direction", "the light has no direction")
    if isinstance(light, PointLight) and light.cookie is not None:
        shade = Placement(rotation=light.cookie.rotation)
        if affine(shade) is None:
            yield Obstacle("light_degenerate", f"{pointer}/cookie/rotation", "the turn is none")
    if isinstance(light, SpotLight) and light.outer_angle < light.inner_angle:
        yield Obstacle(
            "light_degenerate",
            f"{pointer}/outer_angle",
            f"outer angle {light.outer_angle:g} is below inner angle {light.inner_angle:g}",
        )


def _node(node: Node, pointer: str, parent: Affine) -> Iterator[Obstacle]:
    placed = affine(node.transform)
    world = parent @ placed if placed else None
    if world is None or world.is_degenerate():
        yield Obstacle(
            "transform_singular",
            f"{pointer}/transform",
            "the transform, with those above it, is not an invertible affine map of usable size",
        )
        return
    yield from _boxes(node, pointer)
    for index, child in enumerate(node.children):
        yield from _node(child, f"{pointer}/children/{index}", world)


def _boxes(node: Node, pointer: str) -> Iterator[Obstacle]:
    """Yield what fills a box and has none; a box that is displaced is one no more."""
    if isinstance(node.mesh, Box) and node.displacement is None:
        return
    for field in ("mesh", "surface", "surface_map"):
        for place, part in parts(getattr(node, field), f"{pointer}/{field}"):
            if isinstance(part, SurfaceSpec) and part.fills_box:
                yield Obstacle("volume_without_box", place, f"a {part.technique} needs a plain box")
