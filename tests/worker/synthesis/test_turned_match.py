"""T59 with angles and scales (Barnes, Shechtman, Goldman and Finkelstein, 2010)."""

import itertools
import math

import numpy as np
import pytest
from scipy import ndimage

from api_schemas.estimate import estimate
from api_schemas.feasibility import obstacles
from api_schemas.requests import TextureRequest
from tests.growing import grow, noise, upload
from worker.images import image_io
from worker.synthesis.by_example.features import FeatureSpace
from worker.synthesis.by_example.patch_match import NEVER
from worker.synthesis.by_example.turned_match import turned_field
from worker.synthesis.by_example.turned_patches import Pair, axis, difference

SIDE = 7
HALF = SIDE // 2


def where(side, of, angle, scale):
    """Rows and columns of a picture that one shows, turned anticlockwise and enlarged, of it."""
    down, right = np.indices((side, side)) - (side - 1) / 2
    cosine, sine = scale * np.cos(angle), scale * np.sin(angle)
    middle = (of - 1) / 2
    return middle + cosine * down - sine * right, middle + sine * down + cosine * right


def waves(rows, columns):
    """A picture that is known between its pixels, too: forty waves of six pixels and more."""
    chance = np.random.default_rng(3)
    waves = chance.uniform(-1, 1, (40, 2)) * 2 * np.pi / 6
    phases = chance.uniform(0, 2 * np.pi, (3, 40))
    turns = rows[..., np.newaxis] * waves[:, 0] + columns[..., np.newaxis] * waves[:, 1]
    sums = np.stack([np.cos(turns + phase).sum(axis=-1) for phase in phases], axis=-1)
    return np.clip(np.rint(127.5 + 20 * sums), 0, 255).astype(np.uint8)


def passes(target, source, rotations, scales, *, usable=None, times=5, side=SIDE, seed=1):
    mask = np.ones(source.shape[:2], bool) if usable is None else usable
    fields = turned_field(Pair.of(target, source, mask, side, rotations, scales), seed)
    return [
        type(field)(*(part.copy() for part in field))
        for field in itertools.islice(fields, times + 1)
    ]


def away(field, rows, columns, angle, scale):
    """How far a field is from the truth: in pixels, radians and octaves."""
    inner = np.s_[HALF:-HALF, HALF:-HALF]
    apart = np.hypot(field.rows / 256 - rows[inner], field.columns / 256 - columns[inner])
    turned = np.abs((field.radians - angle + np.pi) % (2 * np.pi) - np.pi)
    return apart, turned, np.abs(np.log2(field.factors / scale))


@pytest.mark.parametrize(
    ("angle", "scale", "rotations", "scales"),
    [
        (math.radians(30), 1, math.pi, 1),
        (math.radians(-170), 1, math.pi, 1),
        (math.radians(90), 1, math.pi, 1),
        (0, 1.5, 0, 2),
        (math.radians(30), 1.25, math.pi, 2),
        (math.radians(-15), 0.75, 0.5, 2),
    ],
)
def test_a_picture_that_was_turned_and_scaled_is_found_again(angle, scale, rotations, scales):
    source = waves(*np.indices((96, 96)).astype(float))
    rows, columns = where(56, 96, angle, scale)
    target = waves(rows, columns)

    fields = passes(target, source, rotations, scales)

    assert (np.diff([field.costs.astype(float) for field in fields], axis=0) <= 0).all()
    apart, turned, stretched = away(fields[-1], rows, columns, angle, scale)
    # Off by half a pixel at the middle, and by as much again at the corners of a patch, which are
    # sqrt(2) 3 pixels away: 0.118 in angle, 0.16 octaves in scale
    found = (apart < 0.5) & (turned < 0.118) & (stretched < 0.16)
    assert found.mean() > 0.95
    for field in fields:
        assert np.abs(field.radians).max() <= rotations
        assert np.abs(np.log2(field.factors)).max() <= math.log2(scales)


@pytest.mark.parametrize("turns", [0, 1, 2, 3])
def test_quarters_of_a_turn_are_exact(turns):
    # What lies turned anticlockwise in the source is as it was before in the target
    target = np.random.default_rng(1).integers(0, 256, (30, 30, 3)).astype(np.uint8)
    pair = Pair.of(target, np.rot90(target, turns), np.ones((30, 30), bool), SIDE, math.pi, 1)

    for y, x in ((0, 0), (3, 17), (23, 23)):
        down, right = y + HALF - 14.5, x + HALF - 14.5
        for _ in range(turns):
            down, right = -right, down
        middle = round((down + 14.5) * 256), round((right + 14.5) * 256)
        assert difference(pair, y, x, *middle, *axis(pair, 256 * turns, 0), NEVER) == 0


def test_a_quarter_of_a_turn_is_found():
    source = waves(*np.indices((64, 64)).astype(float))

    *_, field = passes(np.rot90(source, -1), source, math.pi, 1)

    assert (np.abs(field.angles - 256) <= 2).mean() > 0.95
    assert (field.costs <= 4 * SIDE**2 * 3).mean() > 0.95  # of 255, off by 2


def test_a_patch_as_it_lies_costs_what_patches_differ_by():
    target, source = (waves(*np.indices((24, 24)) + shift) for shift in (0.0, 300.0))

    *_, field = passes(target, source, 0, 1, times=3, side=4)

    windows = np.lib.stride_tricks.sliding_window_view
    ours = windows(target, (4, 4), (0, 1)).astype(int)
    rows, columns = (field.rows - 3 * 128) / 256, (field.columns - 3 * 128) / 256
    whole = (rows % 1 == 0) & (columns % 1 == 0)
    theirs = windows(source, (4, 4), (0, 1)).astype(int)
    found = theirs[rows[whole].astype(int), columns[whole].astype(int)]
    assert whole.any()
    assert (((ours[whole] - found) ** 2).sum(axis=(1, 2, 3)) == field.costs[whole]).all()


def test_between_pixels_lies_what_scipy_interpolates():
    target, source = (waves(*np.indices((40, 40)) + shift) for shift in (0.0, 300.0))

    *_, field = passes(target, source, math.pi, 2, times=2)

    steps = np.arange(SIDE) - HALF
    for y, x in ((0, 0), (11, 30), (33, 5), (20, 20)):
        part = type(field)(*(values[y, x] for values in field))
        places = np.moveaxis(part.places(steps[:, np.newaxis], steps), -1, 0)
        seen = [
            ndimage.map_coordinates(source[..., channel].astype(float), places, order=1)
            for channel in range(3)
        ]
        ours = target[y : y + SIDE, x : x + SIDE].astype(float)
        # Places are rounded to 1/256 pixel and values to whole numbers: 2 of 255 at most
        differences = np.abs(np.moveaxis(seen, 0, -1) - ours)
        assert field.costs[y, x] == pytest.approx(
            (differences**2).sum(), abs=(2 * differences * 2 + 4).sum()
        )


def test_nothing_that_must_not_be_copied_is_in_a_patch():
    source = waves(*np.indices((64, 64)).astype(float))
    usable = ndimage.distance_transform_edt(np.indices((64, 64)).sum(axis=0) != 64) > 5
    rows, columns = where(40, 64, 0.6, 1)

    *_, field = passes(waves(rows, columns), source, math.pi, 2, usable=usable)

    steps = np.arange(SIDE) - HALF
    whole = type(field)(*(part[..., np.newaxis, np.newaxis] for part in field))
    places = whole.places(steps[:, np.newaxis], steps)
    taken = np.rint(np.clip(places, 0, 63)).astype(int)
    assert usable[taken[..., 0], taken[..., 1]].all()
    assert (places >= -0.01).all()
    assert (places <= 63.01).all()


@pytest.mark.parametrize("shapes", [((1, 1), (1, 1)), ((3, 9), (5, 4)), ((9, 3), (40, 2))])
def test_small_pictures_have_a_field(shapes):
    target, source = (noise(*shape, seed=i) for i, shape in enumerate(shapes))

    made = grow(
        "nearest_neighbour_field", source, shapes[0][::-1], target=target, rotations=1, scales=4
    )

    assert np.isfinite(made.layers["offset"].pixels).all()
    assert made.image.pixels.shape == target.shape


def test_the_layers_tell_where_each_pixel_is_from():
    source = waves(*np.indices((96, 96)).astype(float)).astype(np.float32) / 255
    rows, columns = where(48, 96, 0.5, 1.2)
    target = waves(rows, columns).astype(np.float32) / 255

    made = grow(
        "nearest_neighbour_field", source, (48, 48), target=target, rotations=math.pi, scales=1.5
    )

    right, down = np.moveaxis(made.layers["offset"].pixels, -1, 0)
    apart = np.hypot(down + np.arange(48)[:, np.newaxis] - rows, right + np.arange(48) - columns)
    assert (apart < 0.5).mean() > 0.95  # pixels at the border, too
    assert np.median(made.layers["angle"].pixels) == pytest.approx(0.5, abs=0.02)
    assert np.median(made.layers["scale"].pixels) == pytest.approx(1.2, abs=0.03)
    taken = np.rint([rows, columns]).astype(int)
    same = (made.image.pixels == source[tuple(taken)]).all(axis=-1)
    assert same[apart < 0.02].mean() > 0.9
    assert (np.diff(made.report["energies"]) <= 0).all()
    assert made.layers["distance"].pixels.max() < 0.2


def test_without_the_options_the_layers_are_those_there_were():
    fields = {"target": noise(20, 20, seed=2)}

    plain = grow("nearest_neighbour_field", noise(20, 20), (20, 20), **fields)
    same = grow("nearest_neighbour_field", noise(20, 20), (20, 20), rotations=0, scales=1, **fields)

    assert set(plain.layers) == {"source", "offset", "distance"}
    assert plain.image.pixels.tobytes() == same.image.pixels.tobytes()


def request(layers=(), **fields):
    texture = {"technique": "nearest_neighbour_field", "target": upload(1), "exemplar": upload(0)}
    output = {"layers": list(layers), "format": "exr"}
    return TextureRequest.model_validate({"texture": {**texture, **fields}, "output": output})


def test_what_cannot_be_had_together_is_refused():
    found = [
        (each.code, each.pointer)
        for fields in ({"method": "exact"}, {"nearest": 2}, {"nearest": 1})
        for each in obstacles(request(scales=1.5, **fields))
    ]

    assert found == [
        ("options_exclude_each_other", "/texture/method"),
        ("options_exclude_each_other", "/texture/nearest"),
    ]
    unknown = [each.pointer for each in obstacles(request(["angle", "scale"]))]
    assert unknown == ["/output/layers/0", "/output/layers/1"]
    assert obstacles(request(["angle", "scale"], rotations=0.1)) == []


@pytest.mark.parametrize(
    "fields", [{"rotations": -1}, {"rotations": 3.2}, {"scales": 0.5}, {"scales": 4.1}]
)
def test_ways_that_are_none_are_refused_by_the_schema(fields):
    with pytest.raises(ValueError, match=next(iter(fields))):
        request(**fields)


def test_they_cost_more():
    assert estimate(request(rotations=1), {}).seconds > 4 * estimate(request(), {}).seconds


def test_bits_do_not_depend_on_threads(with_threads):
    source = waves(*np.indices((40, 40)).astype(float))
    target = waves(*np.indices((150, 40)).astype(float) + 200)

    one, two = (with_threads(n, lambda: passes(target, source, 3, 2, times=2)) for n in (1, 2))

    for part, other in zip(one[-1], two[-1], strict=True):
        assert part.tobytes() == other.tobytes()


@pytest.mark.corpus
@pytest.mark.parametrize("name", ["embark/1.jpg", "embark/2.jpg", "skimage/grass.png"])
def test_photographs_that_were_turned_are_found_again(corpus, name):
    image = image_io.read(corpus / "3_textures" / name, "srgb", "colour", alpha=False)
    whole = FeatureSpace.of(image).encode(image)[:256, :256].astype(float)
    source = np.rint(whole.reshape(128, 2, 128, 2, -1).mean(axis=(1, 3))).astype(np.uint8)
    rows, columns = where(64, 128, 0.5, 1.25)
    turned = [
        ndimage.map_coordinates(source[..., channel].astype(float), [rows, columns], order=1)
        for channel in range(source.shape[2])
    ]
    target = np.rint(np.moveaxis(turned, 0, -1)).astype(np.uint8)

    *_, field = passes(target, source, math.pi, 1.5)

    apart, angles, scales = away(field, rows, columns, 0.5, 1.25)
    assert ((apart < 0.5) & (angles < 0.118) & (scales < 0.16)).mean() > 0.9
