import pytest

from api_schemas.assets import ASSET_FACTS
from api_schemas.estimate import estimate
from api_schemas.feasibility import obstacles
from api_schemas.relief import DISPLACED_TRIANGLES_MAX, Displacement
from api_schemas.relief_use import relief_misuses
from api_schemas.requests import RenderRequest
from tests.model_facts import model_facts

MODEL = "0" * 64
NOISE = {"texture": {"technique": "perlin"}}


def request(**node):
    return RenderRequest.model_validate({"scene": {"nodes": [node]}})


def model(**mesh):
    return {"type": "model", "asset": MODEL, **mesh}


def facts(**told):
    found = {**model_facts(), **told, "sha256": MODEL, "bytes": 1}
    return {MODEL: ASSET_FACTS.validate_python(found)}


def found(request, known=None):
    return [(item.code, item.pointer) for item in relief_misuses(request, known or {})]


PLANE = {"type": "plane"}


def test_two_million_triangles_are_the_most():
    body = request(mesh=PLANE, displacement={**NOISE, "subdivisions": 10})

    assert body.scene.nodes[0].displacement.triangles(2) == 2**21 == DISPLACED_TRIANGLES_MAX
    assert found(body) == []


def test_more_are_refused_with_a_pointer_to_what_makes_them():
    fine = {"type": "sphere", "segments": 512, "rings": 256}
    body = request(children=[{"mesh": fine, "displacement": {**NOISE, "subdivisions": 2}}])

    assert DISPLACED_TRIANGLES_MAX < 512 * 255 * 2 * 16
    pointer = "/scene/nodes/0/children/0/displacement/subdivisions"
    assert found(body) == [("over_budget", pointer)]


def test_a_model_is_told_by_its_facts():
    body = request(mesh=model(), displacement={**NOISE, "subdivisions": 1})

    assert found(body) == []
    assert found(body, facts(triangles=2**19, uv_sets=1)) == []
    over = [("over_budget", "/scene/nodes/0/displacement/subdivisions")]
    assert found(body, facts(triangles=2**19 + 1, uv_sets=1)) == over


def test_a_model_too_fine_by_itself_is_no_fault_of_a_number():
    body = request(mesh=model(), displacement=NOISE)

    known = facts(triangles=DISPLACED_TRIANGLES_MAX + 1, uv_sets=1)

    assert found(body, known) == [("over_budget", "/scene/nodes/0/displacement")]


@pytest.mark.parametrize("triangles", [1, 2, 12, 3968, 2**18, 2**20])
def test_left_to_itself_a_relief_is_as_fine_as_a_quarter_of_a_million_allows(triangles):
    relief = Displacement.model_validate(NOISE)

    many = relief.triangles(triangles)

    assert many <= max(2**18, triangles)
    assert relief.levels(triangles) == 10 or 4 * many > 2**18


NORMAL = {"normal": NOISE}


@pytest.mark.parametrize(
    ("surface", "pointers"),
    [
        (NORMAL, ["/normal"]),
        ({"bump": NOISE}, ["/bump"]),
        ({"normal": {**NOISE, "space": "object"}}, []),
        ({"height": NOISE, "parallax": NOISE}, []),
        ({**NORMAL, "bump": NOISE}, ["/normal", "/bump"]),
    ],
)
def test_what_tilts_along_u_needs_coordinates(surface, pointers):
    body = request(mesh=model(), surface={"technique": "phong", **surface})

    expected = [("coordinates_missing", f"/scene/nodes/0/surface{name}") for name in pointers]
    assert found(body, facts(uv_sets=0)) == expected
    assert found(body, facts(uv_sets=1)) == []


def test_surfaces_of_changed_materials_and_nodes_are_looked_at_too():
    bumpy = {"technique": "phong", **NORMAL}
    mesh = model(
        materials=[{"material": 0, "surface": bumpy}], nodes=[{"node": 0, "surface": bumpy}]
    )

    assert [pointer for _, pointer in found(request(mesh=mesh), facts(uv_sets=0))] == [
        "/scene/nodes/0/mesh/materials/0/surface/normal",
        "/scene/nodes/0/mesh/nodes/0/surface/normal",
    ]


def test_a_relief_is_read_by_coordinates_that_are_there():
    body = request(mesh=model(), displacement=NOISE)

    pointer = "/scene/nodes/0/displacement/coordinates"
    assert found(body, facts(uv_sets=0)) == [("coordinates_missing", pointer)]


def test_each_halving_costs_four_times_as_much():
    def cost(subdivisions):
        body = request(mesh=PLANE, displacement={**NOISE, "subdivisions": subdivisions})
        return estimate(body, {})

    none = estimate(request(mesh=PLANE), {})
    first, second = cost(8), cost(9)

    assert second.seconds - none.seconds > 3 * (first.seconds - none.seconds) > 0.5
    assert second.bytes > first.bytes + 3 * 2**17 * 500


def test_looking_into_a_relief_costs_its_steps():
    def cost(**how):
        surface = {"technique": "unlit", "parallax": {**NOISE, **how}}
        return estimate(request(mesh=PLANE, surface=surface), {}).seconds

    assert cost(steps=128) > cost(steps=8) > cost(method="offset")


@pytest.mark.parametrize(
    ("coordinates", "suits"),
    [
        ({"technique": "position"}, True),
        ({"technique": "normal", "frame": "object"}, True),
        ({"technique": "normal"}, False),
        ({"technique": "cylindrical", "frame": "view"}, False),
        ({"technique": "reflection"}, False),
        ({"technique": "triplanar"}, False),
    ],
)
def test_vertices_have_but_some_coordinates(coordinates, suits):
    body = request(mesh=PLANE, displacement={**NOISE, "coordinates": coordinates})

    pointer = "/scene/nodes/0/displacement/coordinates"
    assert found(body) == ([] if suits else [("coordinates_unsuited", pointer)])


@pytest.mark.parametrize("name", ["height", "parallax"])
def test_a_relief_is_read_at_one_place(name):
    relief = {**NOISE, "coordinates": {"technique": "triplanar"}}
    body = request(mesh=PLANE, surface={"technique": "phong", name: relief})

    pointer = f"/scene/nodes/0/surface/{name}/coordinates"
    assert [(item.code, item.pointer) for item in obstacles(body)] == [
        ("coordinates_unsuited", pointer)
    ]


@pytest.mark.parametrize("name", ["height", "parallax", "bump"])
def test_a_relief_does_not_lie_on_the_faces_of_a_cube(name):
    faces = {"coordinates": {"technique": "normal"}, "layout": {"technique": "cube"}}
    body = request(mesh=PLANE, surface={"technique": "phong", name: {**NOISE, **faces}})

    pointer = f"/scene/nodes/0/surface/{name}/layout"
    assert [(item.code, item.pointer) for item in obstacles(body)] == [
        ("layout_impossible", pointer)
    ]
