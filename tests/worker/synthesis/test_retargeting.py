"""Pictures brought to other sizes without squeezing what is in them: T60."""

import itertools

import numpy as np
import pytest
from scipy import ndimage

from tests.growing import TEXTURE, noise, sources, upload
from tests.growing import grow as grow_by
from worker.errors import RenderError
from worker.images.image import Image
from worker.synthesis.by_example.exemplar import Exemplar
from worker.synthesis.by_example.quality import quality


def grow(exemplar, size, **fields):
    return grow_by("retargeting", exemplar, size, **fields)


def two_things():
    """A dark square of noise, 24 pixels wide, and a light one, on a ground of softer noise."""
    ground = ndimage.gaussian_filter(noise(64, 160), (2, 2, 0)) * 0.2 + 0.4
    dark, light = noise(24, 24, seed=1) * [0.1, 0.1, 1], 1 - noise(24, 24, seed=2) * [0.1, 0.1, 1]
    picture = ground.astype(np.float32)
    picture[20:44, 24:48], picture[20:44, 112:136] = dark, light
    return picture


def test_t60_at_its_own_size_a_picture_is_unchanged():
    exemplar = noise(40, 30)

    made = grow(exemplar, (30, 40))

    assert made.image.pixels.tobytes() == exemplar.tobytes()
    assert (np.array(sources(made, exemplar)) == np.indices((40, 30))).all()


def test_t60_it_is_nearer_to_the_exemplar_both_ways_than_squeezing_and_cutting_off():
    pixels = two_things()
    exemplar = Exemplar.of({"exemplar": Image(pixels, "colour")})
    rows, columns = np.indices((64, 112), np.int32)

    made = grow(pixels, (112, 64)).report["quality"]

    def distance(figures):
        """Simakov et al. (2008), at half the size."""
        return figures["to_exemplar_2"] + figures["from_exemplar_2"]

    squeezed = np.stack([rows, (columns * 160 + 80) // 112], axis=-1).astype(np.int32)
    cut_off = np.stack([rows, columns], axis=-1)
    assert distance(made) < 0.8 * distance(quality(squeezed, exemplar))
    assert distance(made) < distance(quality(cut_off, exemplar))


@pytest.mark.parametrize("width", [112, 220])
def test_t60_things_stay_whole_and_in_their_order(width):
    pixels = grow(two_things(), (width, 64)).image.pixels

    dark, light = pixels[..., 0] < 0.15, pixels[..., 0] > 0.85
    places = []
    for thing in (dark, light):
        labels, count = ndimage.label(thing)
        assert count == 1
        rows, columns = ndimage.find_objects(labels)[0]
        assert rows.stop - rows.start == pytest.approx(24, abs=2)
        places.append((columns.start + columns.stop) / 2 / width)
    assert 0.1 < places[0] < 0.4
    assert 0.6 < places[1] < 0.9


def test_t60_a_periodic_texture_goes_on_exactly():
    exemplar = np.tile(noise(8, 8), (8, 8, 1))

    pixels = grow(exemplar, (96, 64)).image.pixels

    assert (pixels[8:] == pixels[:-8]).all()
    # Where a period more goes in, some pixels may be left of the way there
    assert (pixels[:, 8:] == pixels[:, :-8]).mean() > 0.9


def test_every_pixel_is_one_of_the_exemplars_at_the_place_it_says():
    exemplar = noise(33, 47)

    for size in ((60, 20), (1, 1), (5, 70)):
        made = grow(exemplar, size)

        assert made.image.pixels.tobytes() == exemplar[sources(made, exemplar)].tobytes()


def test_sizes_lie_between_that_of_the_exemplar_and_the_wanted_one():
    spec = TEXTURE.validate_python(
        {"technique": "retargeting", "exemplar": upload(0), "size": [50, 300]}
    )

    sizes = [(100, 100), *spec.sizes((100, 100))]

    assert sizes[-1] == (300, 50)
    for before, after in itertools.pairwise(sizes):
        assert before[0] < after[0]
        assert before[1] > after[1]
        # At most 12 % at a time, and the rounding
        assert after[0] / before[0] < 1.14
    assert spec.sizes((300, 50)) == [(300, 50)]
    assert len(spec.sizes((1, 1))) == 12


def test_an_exemplar_of_which_nothing_may_be_copied_is_refused():
    with pytest.raises(RenderError, match="no pixel") as caught:
        grow(noise(20, 20), (30, 30), exemplar_mask=np.zeros((20, 20, 1), np.float32))

    assert caught.value.code == "exemplar_unusable"


def test_bits_do_not_depend_on_threads(with_threads):
    exemplar = two_things()

    one, two = (with_threads(n, lambda: grow(exemplar, (90, 64)).image.pixels) for n in (1, 2))

    assert one.tobytes() == two.tobytes()
