"""Every layout, against closed forms and against itself."""

import math

import numpy as np
import pytest
from pydantic import TypeAdapter

from api_schemas.language import FAMILIES
from api_schemas.members import Layout
from worker import layouts

LAYOUT = TypeAdapter(Layout)
VARIANTS = [
    {"technique": "latlong"},
    {"technique": "angular_probe"},
    {"technique": "angular_probe", "centre": "+z"},
    {"technique": "mirror_ball"},
    {"technique": "fisheye", "angle": 2 * math.pi},
    {"technique": "fisheye", "angle": 2 * math.pi, "model": "equisolid", "towards": "+x"},
    {"technique": "fisheye", "model": "stereographic", "angle": 6.0, "towards": "+y"},
    {"technique": "fisheye", "model": "orthographic", "towards": "-y"},
    {"technique": "fisheye", "towards": "+z", "angle": 2.0},
    {"technique": "hemispheres"},
    {"technique": "hemispheres", "second": "photograph"},
    {"technique": "dual_paraboloid"},
    {"technique": "dual_paraboloid", "second": "photograph"},
    {"technique": "octahedral"},
    *(
        {"technique": "cube", "arrangement": arrangement, "orientation": orientation}
        for arrangement in ("column", "row", "cross", "tall_cross")
        for orientation in ("openexr", "gl")
    ),
]


def spec_of(body):
    return LAYOUT.validate_python(body)


def random_directions(count=2000):
    directions = np.random.default_rng(7).normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True)


def held(spec, directions):
    """Which directions the layout has a place for."""
    if spec.technique != "fisheye":
        return np.ones(len(directions), bool)
    axis = np.array({"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}[spec.towards[1]])
    towards = directions @ axis * float(spec.towards[0] + "1")
    return towards > math.cos(spec.angle / 2) + 1e-6


def place(body, *directions):
    return layouts.place(spec_of(body), np.array(directions, dtype=np.float64))


def test_every_layout_has_its_variants_here():
    assert {body["technique"] for body in VARIANTS} == set(FAMILIES["layouts"])


@pytest.mark.parametrize("body", VARIANTS)
def test_there_and_back(body):
    spec, directions = spec_of(body), random_directions()
    directions = directions[held(spec, directions)]

    uv = layouts.place(spec, directions)
    back, valid = layouts.direction(spec, uv)

    assert valid.all()
    assert ((uv >= 0) & (uv <= 1)).all()
    # An orthographic disc is steep at its rim: its sines lose half their digits there
    np.testing.assert_allclose(back, directions, atol=1e-7)
    assert np.median(np.abs(back - directions)) < 1e-15


@pytest.mark.parametrize("body", VARIANTS)
def test_solid_angles_make_what_the_layout_holds(body):
    spec = spec_of(body)
    width, height = (64 * side for side in spec.proportion)

    angles = layouts.solid_angles(spec, width, height)
    _, valid = layouts.direction(spec, layouts.texel_middles(width, height))

    angle = spec.angle if spec.technique == "fisheye" else 2 * math.pi
    whole = 2 * math.pi * (1 - math.cos(angle / 2))  # of a cap
    assert angles.shape == (height, width)
    # Parts of texels on a disc's rim are in or out; an eighth of a texel wide
    assert angles.sum() == pytest.approx(whole, rel=2e-3)
    assert (angles >= 0).all()
    assert (angles.ravel()[valid] > 0).all()


@pytest.mark.parametrize("body", VARIANTS)
def test_solid_angles_are_those_of_the_texel_s_corners(body):
    # Four-sided pyramids from the middle of the world, in the middle of a texel of 128 per square
    spec = spec_of(body)
    width, height = (128 * side for side in spec.proportion)
    rows, columns = int(0.45 * height), int(0.4 * width)
    corners = [
        layouts.direction(spec, np.array([[(columns + i) / width, 1 - (rows + j) / height]]))
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))
    ]
    a, b, c, d = (found[0] for found, _ in corners)

    angle = layouts.solid_angles(spec, width, height)[rows, columns]

    expected = triangle(a, b, c) + triangle(a, c, d)
    # Its sides are no great circles; parts of it stand for it by their middles
    assert angle == pytest.approx(expected, rel=3e-3)


def triangle(a, b, c):
    """Solid angle of a triangle (Van Oosterom and Strackee, 1983)."""
    return abs(2 * math.atan2(np.dot(a, np.cross(b, c)), 1 + a @ b + b @ c + c @ a))


def test_t08_an_angular_probe_has_the_camera_s_view_in_the_middle():
    # REFERENCE 0.3: r = acos(-d_z) / pi, x to the right
    probe = {"technique": "angular_probe"}

    uv = place(probe, [0, 0, -1], [1, 0, 0], [0, 1, 0], [1, 0, 1])

    half = 0.5 + 0.25  # r = 1/2 in a picture from -1 to 1
    far = 0.5 + 0.375  # 135 degrees
    np.testing.assert_allclose(uv, [[0.5, 0.5], [half, 0.5], [0.5, half], [far, 0.5]], atol=1e-15)


def test_t08_lenses_have_their_radii():
    # 60 degrees to the right of what is looked at, in pictures of 180 degrees
    angle = math.radians(60)
    direction = [math.sin(angle), 0, -math.cos(angle)]

    radii = {
        model: 2 * place({"technique": "fisheye", "model": model}, direction)[0, 0] - 1
        for model in ("equidistant", "equisolid", "stereographic", "orthographic")
    }

    assert radii == pytest.approx(
        {
            "equidistant": 2 / 3,
            "equisolid": math.sin(angle / 2) / math.sin(math.pi / 4),
            "stereographic": math.tan(angle / 2),
            "orthographic": math.sin(angle),
        },
        abs=1e-15,
    )


def test_t08_a_mirrored_ball_reflects():
    # The point (x, y) of a unit ball seen from +z reflects (0, 0, 1) to (2xz, 2yz, 2z^2 - 1)
    x, y = 0.6, -0.48
    z = math.sqrt(1 - x * x - y * y)

    uv = place({"technique": "mirror_ball"}, [2 * x * z, 2 * y * z, 2 * z * z - 1])

    np.testing.assert_allclose(uv, [[0.5 + 0.5 * x, 0.5 + 0.5 * y]], atol=1e-15)


def test_a5_t20_a_face_of_opengl_s_cube():
    # (1, 2, -3) / 6 = (1/6, 1/3, -1/2); on -z of OpenGL s = 1/3 and t = 1/6 from the top
    uv = place({"technique": "cube", "arrangement": "row", "orientation": "gl"}, [1, 2, -3])

    np.testing.assert_allclose(uv, [[(5 + 1 / 3) / 6, 1 - 1 / 6]], atol=1e-15)


def test_a5_t20_solid_angles_of_a_face():
    angles = layouts.solid_angles(spec_of({"technique": "cube", "arrangement": "row"}), 6 * 64, 64)

    face = angles[:, :64]
    assert face.sum() == pytest.approx(2.094395102, abs=1e-9)
    assert face[31, 31] / face[0, 0] == pytest.approx(5.030693102, abs=1e-9)


@pytest.mark.parametrize("towards", ["+x", "-x", "+y", "-y", "+z", "-z"])
def test_t20_openexr_s_faces_are_right_as_seen_from_within(towards):
    # ImfEnvmap: +x has z to the right and y up, and so on; right = forward x up has no mirror in it
    spec = spec_of({"technique": "cube"})
    forward = np.array({"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}[towards[1]]) * float(
        towards[0] + "1"
    )
    row = ["+x", "-x", "+y", "-y", "+z", "-z"].index(towards)

    middle, right, up = layouts.direction(
        spec,
        np.array(
            [[0.5, 1 - (row + 0.5) / 6], [0.75, 1 - (row + 0.5) / 6], [0.5, 1 - (row + 0.25) / 6]]
        ),
    )[0]

    np.testing.assert_allclose(middle, forward, atol=1e-15)
    assert np.cross(right - middle, up - middle) @ middle < 0
    expected = {"+x": [0, 0, 1], "-x": [0, 0, -1], "+z": [-1, 0, 0]}.get(towards, [1, 0, 0])
    assert right @ expected > 0.4


@pytest.mark.parametrize("orientation", ["openexr", "gl"])
@pytest.mark.parametrize("arrangement", ["cross", "tall_cross"])
def test_t20_faces_of_a_cross_meet_without_a_jump(arrangement, orientation):
    spec = spec_of({"technique": "cube", "arrangement": arrangement, "orientation": orientation})
    columns, rows = spec.proportion
    # Steps across all inner edges between valid cells that are folded there
    edges = [((c / columns, 1 - 1.4 / rows), (1, 0)) for c in range(1, min(columns, 4))]
    edges += [((1.4 / columns, 1 - r / rows), (0, 1)) for r in range(1, rows)]

    for (u, v), (across, along) in edges:
        step = np.array([across, along]) * 1e-6
        pair, valid = layouts.direction(spec, np.array([u, v]) + np.array([-step, step]))
        assert valid.all()
        assert np.linalg.norm(pair[0] - pair[1]) < 1e-4


def test_t22_hemispheres_use_a_quarter_pi_of_their_squares():
    spec = spec_of({"technique": "hemispheres"})

    uv = layouts.place(spec, np.array([[0.6, 0.64, 0.48], [0.6, -0.64, 0.48]]))
    _, valid = layouts.direction(spec, layouts.texel_middles(512, 256))

    np.testing.assert_allclose(uv, [[0.4, 0.74], [0.9, 0.74]], atol=1e-15)
    assert valid.mean() == pytest.approx(math.pi / 4, abs=1 / 256)
    # d omega / dA is 4 / |y| per unit of a square's area
    texel = layouts.solid_angles(spec, 2048, 1024)[512, 512 + 256]
    y = math.sqrt(1 - (0.5 + 1 / 1024) ** 2 - (1 / 1024) ** 2)
    assert texel * 1024**2 == pytest.approx(4 / y, rel=1e-5)


def test_a6_t68_a_paraboloid():
    spec = spec_of({"technique": "dual_paraboloid"})

    uv = layouts.place(spec, np.array([[0.48, -0.64, 0.6], [0.48, -0.64, -0.6]]))
    densities = [
        layouts.solid_angles(spec, 2048, 1024)[512, 512 + round(rho * 512)] * 1024**2 / 4
        for rho in (0.0, 0.5)
    ]

    np.testing.assert_allclose(uv, [[0.325, 0.3], [0.825, 0.3]], atol=1e-15)
    assert densities == pytest.approx([4, 2.56], rel=2e-3)


def test_x24_octahedral():
    uv = place({"technique": "octahedral"}, [1, 2, -3])

    np.testing.assert_allclose(uv, [[5 / 6, 11 / 12]], atol=1e-15)


@pytest.mark.parametrize(
    ("body", "fields"),
    [
        ({"technique": "fisheye", "model": "orthographic", "angle": 3.2}, "angle"),
        ({"technique": "fisheye", "model": "stereographic", "angle": 6.28}, "angle"),
    ],
)
def test_impossible_lenses_are_named(body, fields):
    mistake = spec_of(body).mistake()

    assert mistake is not None
    assert mistake[0] == fields
