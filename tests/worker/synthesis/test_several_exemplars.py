"""Texture grown from several exemplars at once (X11 and its kin)."""

import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from api_schemas.by_example import MixedSpec
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from tests.growing import grow, noise, upload
from tests.worker.synthesis.test_materials_by_example import SMALL
from worker.errors import RenderError
from worker.images import image_io
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.task import Task, levels
from worker.synthesis.by_example.windows import whole_windows

GROWING = sorted(name for name, spec in FAMILIES["textures"].items() if issubclass(spec, MixedSpec))
RED, BLUE = (np.full((24, 24, 3), color, np.float32) for color in ((1, 0, 0), (0, 0, 1)))


def mixed(technique, exemplars, size, **fields):
    """Grow from exemplars that are dictionaries of maps, the first one's in the spec itself."""
    first, *further = exemplars
    others = {name: picture for name, picture in first.items() if name != "exemplar"}
    given = {**SMALL.get(technique, {}), **fields}
    return grow(technique, first["exemplar"], size, more_exemplars=further, **others, **given)


def copied(made, pictures):
    """What the layers say is copied: each pixel from its exemplar's picture."""
    u, v = np.moveaxis(made.layers["source"].pixels, -1, 0)
    which = made.layers["exemplar"].pixels[..., 0].astype(int)
    found = np.empty((*which.shape, pictures[0].shape[2]), np.float32)
    for number, picture in enumerate(pictures):
        height, width = picture.shape[:2]
        rows, columns = np.floor((1 - v) * height).astype(int), np.floor(u * width).astype(int)
        own = which == number
        found[own] = picture[rows[own], columns[own]]
    return found


@pytest.mark.parametrize("technique", GROWING)
def test_every_pixel_is_one_of_an_exemplar_and_none_is_left_out(technique):
    shapes = ((30, 26), (21, 34), (26, 26))  # all maps of a material, of different sizes
    exemplars = [
        {"exemplar": noise(*shape, 3, i), "height": noise(*shape, 1, 10 + i)}
        for i, shape in enumerate(shapes)
    ]

    made = mixed(technique, exemplars, (60, 52))

    pictures = [each["exemplar"] for each in exemplars]
    assert made.image.pixels.tobytes() == copied(made, pictures).tobytes()
    heights = [each["height"] for each in exemplars]
    assert made.layers["height"].pixels.tobytes() == copied(made, heights).tobytes()
    # As like each other as can be: of some twenty pieces and more, each comes from any of three
    which = made.layers["exemplar"].pixels
    shares = [float((which == number).mean()) for number in range(3)]
    assert min(shares) > 0.03
    assert made.report["exemplars"] == pytest.approx(shares, abs=5e-5)


def test_variety_brings_in_what_has_nothing_in_common():
    made = mixed("texture_optimization", [{"exemplar": RED}, {"exemplar": BLUE}], (64, 64))

    # Nothing is mixed, and neither takes over, though one alone had no seams at all
    pixels = made.image.pixels
    assert ((pixels == [1, 0, 0]).all(-1) | (pixels == [0, 0, 1]).all(-1)).all()
    assert min(made.report["exemplars"]) > 0.1


def test_no_line_longer_than_half_of_the_smallest_is_copied():
    exemplars = [{"exemplar": noise(48, 64, 3, 1)}, {"exemplar": noise(56, 48, 3, 2)}]

    made = mixed("texture_optimization", exemplars, (96, 96))

    assert made.report["quality"]["longest_run"] <= 24


@pytest.mark.parametrize("sides", [(24, 24, 24), (200, 40, 96), (512, 300)])
def test_no_patch_lies_in_two_exemplars_at_any_size(sides):
    names = ["exemplar", *(f"more_exemplars/{i}/exemplar" for i in range(len(sides) - 1))]
    greys = np.arange(len(sides)) * 100
    exemplar = Exemplar.of(
        {
            name: Image(np.full((side, side, 1), grey / 255, np.float32), "data")
            for name, side, grey in zip(names, sides, greys, strict=True)
        }
    )
    found = np.unique(exemplar.features[exemplar.usable])
    task = Task(exemplar.features, exemplar.usable, exemplar.shape, tileable=False, seed=0)

    for level in levels(task):
        # Each exemplar has a grey of its own, and keeps it to its edges
        assert set(np.unique(level.source[level.usable])) <= set(found)
        patches = np.lib.stride_tricks.sliding_window_view(level.source[..., 0], (3, 3))
        spread = np.ptp(patches.astype(int), axis=(2, 3))
        assert (spread[whole_windows(level.usable, (3, 3))] == 0).all()
    assert len(found) == len(sides)


def test_pictures_with_other_channels_are_brought_together():
    opaque = np.ones((24, 24, 1), np.float32)
    grey, color = noise(24, 24, 1, 1), noise(24, 24, 3, 2)
    clear = np.concatenate([noise(24, 24, 3, 3), opaque], axis=-1)
    clear[:12] = 0  # nothing of that is copied

    made = mixed("ashikhmin", [{"exemplar": each} for each in (grey, color, clear)], (60, 60))

    as_one = [np.concatenate([np.repeat(grey, 3, -1), opaque], -1)]
    as_one += [np.concatenate([color, opaque], -1), clear]
    assert made.image.pixels.tobytes() == copied(made, as_one).tobytes()
    assert (made.image.pixels[..., 3] == 1).all()


def test_each_has_its_mask_its_guide_and_its_picture():
    first, other = noise(24, 24, 3, 1), noise(24, 24, 3, 2)
    left = np.zeros((24, 24, 1), np.float32)
    left[:, :12] = 1
    guide = np.zeros((40, 40, 1), np.float32)
    guide[:, 20:] = 1
    dark, bright = np.zeros((24, 24, 1), np.float32), np.ones((24, 24, 1), np.float32)

    made = mixed(
        "texture_optimization",
        [
            {"exemplar": first, "exemplar_guide": dark, "picture": first + 2},
            {"exemplar": other, "exemplar_guide": bright, "picture": other + 4,
             "exemplar_mask": left},
        ],
        (40, 40), guide=guide, tileable=False,
    )  # fmt: skip

    which = made.layers["exemplar"].pixels[..., 0]
    assert (which == guide[..., 0]).mean() > 0.9
    assert made.image.pixels.tobytes() == copied(made, [first + 2, other + 4]).tobytes()
    assert made.layers["source"].pixels[which == 1][:, 0].max() < 0.5


def test_kept_pixels_are_of_no_exemplar():
    keep = np.zeros((40, 40, 4), np.float32)
    keep[:10] = 1

    made = mixed("ashikhmin", [{"exemplar": RED}, {"exemplar": BLUE}], (40, 40), keep=keep)

    which = made.layers["exemplar"].pixels[..., 0]
    assert (which[:10] == -1).all()
    assert (which[10:] >= 0).all()
    assert sum(made.report["exemplars"]) == pytest.approx(1)


@pytest.mark.parametrize("technique", GROWING)
def test_one_that_must_not_be_copied_is_named(technique):
    nothing = np.zeros((24, 24, 4), np.float32)

    with pytest.raises(RenderError, match="exemplar 3") as caught:
        mixed(technique, [{"exemplar": each} for each in (RED, BLUE, nothing)], (30, 30))

    assert caught.value.code == "exemplar_unusable"


def test_one_with_numbers_that_are_none_or_huge_is_copied_as_it_is():
    hostile = noise(24, 24, 3, 1)
    hostile[3:9, 4:9] = [np.nan, np.inf, 3e38]

    made = mixed("image_quilting", [{"exemplar": RED}, {"exemplar": hostile}], (50, 50))

    assert made.image.pixels.tobytes() == copied(made, [RED, hostile]).tobytes()


@pytest.mark.parametrize("count", [0, 8])
def test_none_and_too_many_are_refused_by_the_schema(count):
    body = {"technique": "graph_cut", "exemplar": upload(0)}

    with pytest.raises(ValidationError) as caught:
        TypeAdapter(Texture).validate_python(
            {**body, "more_exemplars": [{"exemplar": upload(1)}] * count}
        )

    assert [error["loc"][-1] for error in caught.value.errors()] == ["more_exemplars"]


@pytest.mark.corpus
def test_two_photographs_of_one_place_make_a_third(corpus):
    folder = corpus / "3_textures/embark/multiexample"
    both = [
        {"exemplar": image_io.read(folder / name, "srgb", "colour", alpha=False).pixels}
        for name in ("1.jpg", "2.jpg")
    ]

    made = mixed("texture_optimization", both, (512, 512), seed=2)

    assert (
        made.image.pixels.tobytes() == copied(made, [each["exemplar"] for each in both]).tobytes()
    )
    assert min(made.report["exemplars"]) > 0.1
    quality = made.report["quality"]
    assert quality["longest_run"] <= 200  # of 400
    # Of each alone it is 0.0173 and 0.0086: together they leave no more to mend than the worse
    assert quality["to_exemplar_2"] < 0.0173
