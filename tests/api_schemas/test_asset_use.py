import pytest

from api_schemas.asset_use import misuses
from api_schemas.assets import ASSET_FACTS
from api_schemas.requests import RenderRequest, TextureRequest
from tests.model_facts import model_facts

MODEL, FIRST, SECOND, THIRD = (digit * 64 for digit in "0123")
PICTURE = {
    "kind": "image",
    "format": "png",
    "media_type": "image/png",
    "width": 1,
    "height": 1,
    "channels": 1,
    "bits": 8,
    "float": False,
    "has_alpha": False,
}
BUFFER = {"kind": "buffer", "format": "bin", "media_type": "application/gltf-buffer"}
LIBRARY = {"kind": "material_library", "format": "mtl", "media_type": "model/mtl"}
PLASTIC = {"technique": "phong"}
MESH = "/scene/nodes/0/mesh"


def library(*files):
    return {**LIBRARY, "materials": [], "files": list(files)}


def known(**facts):
    names = {"model": MODEL, "first": FIRST, "second": SECOND, "third": THIRD}
    return {
        names[name]: ASSET_FACTS.validate_python({**told, "sha256": names[name], "bytes": 1})
        for name, told in facts.items()
    }


def scene(mesh, **others):
    node = {"mesh": {"type": "model", "asset": MODEL, **mesh}}
    return RenderRequest.model_validate({"scene": {"nodes": [node], **others}})


def found(request, facts):
    return [(item.code, item.pointer) for item in misuses(request, facts)]


def test_a_model_that_needs_nothing_and_assets_that_nobody_knows_are_no_misuse():
    request = scene({"files": {"a": FIRST}, "materials": [{"material": 9, "surface": PLASTIC}]})

    assert found(scene({}), known(model=model_facts())) == []
    assert found(request, {}) == []


@pytest.mark.parametrize("other", [model_facts(), BUFFER, library()])
def test_only_a_picture_is_a_texture(other):
    request = TextureRequest.model_validate({"texture": {"technique": "image", "asset": FIRST}})

    assert found(request, known(first=other)) == [("asset_kind_mismatch", "/texture/asset")]
    assert found(request, known(first=PICTURE)) == []


@pytest.mark.parametrize("other", [PICTURE, BUFFER, library()])
def test_only_a_model_is_a_mesh(other):
    assert found(scene({}), known(model=other)) == [("asset_kind_mismatch", f"{MESH}/asset")]


def test_a_picture_in_a_changed_material_is_looked_at_too():
    surface = {
        "technique": "unlit",
        "color": {"texture": {"technique": "image", "asset": FIRST}},
    }
    request = scene({"materials": [{"material": 0, "surface": surface}]})
    facts = known(model=model_facts(materials=["red"]), first=BUFFER)

    assert found(request, facts) == [
        ("asset_kind_mismatch", f"{MESH}/materials/0/surface/color/texture/asset")
    ]


def test_files_that_are_needed_are_named_and_others_do_no_harm():
    facts = known(model=model_facts(files=["a.bin", "b/c.png"]), first=BUFFER, second=PICTURE)
    missing = list(misuses(scene({"files": {"A.bin": FIRST, "c.png": SECOND}}), facts))

    assert [(item.code, item.pointer) for item in missing] == [
        ("asset_file_missing", f"{MESH}/files")
    ]
    assert missing[0].message == "the model needs files of these names: a.bin, b/c.png"
    assert found(scene({"files": {"a.bin": FIRST, "b/c.png": SECOND, "x": FIRST}}), facts) == []


def test_names_from_files_are_told_without_what_could_fool_a_reader():
    names = ["evil\u202egnp.exe", "a\r\nSet-Cookie: x", "<script>", "Größe 2.png", "y" * 256]
    many = [*names, *(f"{number}.png" for number in range(20))]
    (missing,) = misuses(scene({}), known(model=model_facts(files=many)))

    assert "evil?gnp.exe, a??Set-Cookie? x, ?script?, Größe 2.png, yyy" in missing.message
    assert "y" * 65 not in missing.message
    assert missing.message.endswith("4.png and 15 more")


@pytest.mark.parametrize(
    ("model_format", "files", "given", "wrong"),
    [
        ("gltf", ["a"], {"a": BUFFER}, []),
        ("gltf", ["a"], {"a": PICTURE}, []),
        ("gltf", ["a~/b"], {"a~/b": library()}, ["a~0~1b"]),
        ("glb", ["a"], {"a": model_facts()}, ["a"]),
        ("obj", ["a"], {"a": library()}, []),
        ("obj", ["a"], {"a": BUFFER}, ["a"]),
        ("obj", ["a"], {"a": PICTURE}, ["a"]),
        ("ply", ["a"], {"a": PICTURE}, []),
        ("ply", ["a"], {"a": BUFFER}, ["a"]),
    ],
)
def test_a_file_beside_a_model_is_of_a_kind_that_its_format_knows(
    model_format, files, given, wrong
):
    facts = known(
        model=model_facts(format=model_format, files=files), first=next(iter(given.values()))
    )
    request = scene({"files": dict.fromkeys(given, FIRST)})

    assert found(request, facts) == [
        ("asset_kind_mismatch", f"{MESH}/files/{name}") for name in wrong
    ]


def test_what_a_material_library_needs_the_model_needs():
    facts = known(
        model=model_facts(format="obj", files=["a.mtl"]),
        first=library("wood.png", "a.mtl"),
        second=BUFFER,
        third=PICTURE,
    )

    assert found(scene({"files": {"a.mtl": FIRST}}), facts) == [
        ("asset_file_missing", f"{MESH}/files")
    ]
    assert found(scene({"files": {"a.mtl": FIRST, "wood.png": SECOND}}), facts) == [
        ("asset_kind_mismatch", f"{MESH}/files/wood.png")
    ]
    assert found(scene({"files": {"a.mtl": FIRST, "wood.png": THIRD}}), facts) == []


@pytest.mark.parametrize(("part", "there"), [("red", True), (1, True), ("", True), (2, False)])
def test_materials_and_nodes_are_found_by_name_or_index(part, there):
    facts = known(model=model_facts(materials=["red", ""], nodes=["", "red"]))
    request = scene(
        {"materials": [{"material": part, "surface": PLASTIC}], "nodes": [{"node": part}]}
    )
    places = [f"{MESH}/materials/0/material", f"{MESH}/nodes/0/node"]

    assert found(request, facts) == [("model_part_unknown", place) for place in places if not there]


@pytest.mark.parametrize("part", ["Red", "red ", 0])
def test_a_part_that_is_not_there_is_told_with_its_place(part):
    facts = known(model=model_facts(nodes=["red"] if part else []))
    request = scene({"nodes": [{"node": part}]})

    assert found(request, facts) == [("model_part_unknown", f"{MESH}/nodes/0/node")]


@pytest.mark.parametrize(
    ("scenes", "wanted", "there"),
    [(2, 1, True), (2, 2, False), (2, None, True), (0, None, True), (0, 0, False)],
)
def test_a_scene_of_a_file_is_counted_from_0(scenes, wanted, there):
    facts = known(model=model_facts(scenes=scenes))
    problems = [] if there else [("model_part_unknown", f"{MESH}/scene")]

    assert found(scene({"scene": wanted}), facts) == problems


@pytest.mark.parametrize(
    ("cameras", "wanted", "pointer"),
    [
        (["eye", "eye"], None, None),
        (["eye", "eye"], "eye", None),
        (["eye", "eye"], 1, None),
        (["eye", "eye"], 2, "/scene/camera/camera"),
        (["eye", "eye"], "ear", "/scene/camera/camera"),
        ([], None, "/scene/camera"),
        ([], "eye", "/scene/camera"),
    ],
)
def test_a_models_camera_has_to_be_there(cameras, wanted, pointer):
    request = scene({}, camera={"type": "model", "camera": wanted})
    problems = found(request, known(model=model_facts(cameras=cameras)))

    assert problems == ([("model_part_unknown", pointer)] if pointer else [])


def test_a_camera_may_be_in_the_scene_that_is_asked_for_instead_of_the_default_one():
    facts = known(model=model_facts(scenes=2, cameras=[]))

    for camera in (None, "eye", 1):
        request = scene({"scene": 1}, camera={"type": "model", "camera": camera})
        assert found(request, facts) == []


def test_a_camera_of_any_model_will_do_and_a_scene_without_models_has_none():
    nodes = [{"mesh": {"type": "model", "asset": name}} for name in (MODEL, FIRST)]
    body = {"scene": {"nodes": nodes, "camera": {"type": "model", "camera": "eye"}}}
    request = RenderRequest.model_validate(body)
    blind = model_facts(cameras=["ear"])

    assert found(request, known(model=blind, first=model_facts(cameras=["eye"]))) == []
    assert found(request, known(model=blind)) == []  # the other one may bring it
    body["scene"]["nodes"] = []
    assert found(RenderRequest.model_validate(body), {}) == [
        ("model_part_unknown", "/scene/camera")
    ]
