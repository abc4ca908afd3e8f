"""Pictures of the corpus grown, guided and mended.

The distances are those of 9 x 9 patches at half the size: to the nearest of the exemplar's, and
back. A prototype of the method was measured in the very same way on the same exemplars (its own
measure smooths less when it halves, and gives larger figures); the best open program was measured
by the prototype's. The prototype copies lines of up to 0.73 of an exemplar; half is the most here.
Lines are looked at on all exemplars.
"""

import numpy as np
import pytest

from tests.growing import grow, sources
from worker.images import image_io
from worker.synthesis.by_example.copies import continued, copied_so_far

pytestmark = pytest.mark.corpus


def picture(corpus, name, side=None, alpha=False):
    image = image_io.read(corpus / "3_textures" / name, "srgb", "colour", alpha=alpha)
    return image.pixels[:side, :side]


def longest_lines(made, exemplar):
    """The longest line that is copied down and across, as a share of the exemplar's sides."""
    across, down = continued(np.stack(sources(made, exemplar), axis=-1))
    height, width = exemplar.shape[:2]
    return copied_so_far(down.T).max() / height, copied_so_far(across).max() / width


@pytest.mark.parametrize(
    ("name", "side", "prototype", "open_program"),
    [
        ("skimage/brick.png", 256, (0.0093, 0.0059), (0.017, 0.009)),
        ("embark/1.jpg", None, (0.0100, 0.0134), (0.019, 0.016)),
        ("embark/2.jpg", None, (0.0082, 0.0150), (0.013, 0.021)),
        ("embark/4.png", None, (0.0147, 0.0003), (0.037, 0.007)),
    ],
)
def test_grown_textures_are_near_to_their_exemplars(corpus, name, side, prototype, open_program):
    exemplar = picture(corpus, name, side)

    grown = [grow("texture_optimization", exemplar, (512, 512), seed=seed) for seed in range(4)]

    # Single seeds are up to a fifth better or worse
    qualities = [made.report["quality"] for made in grown]
    nearest = np.mean([quality["to_exemplar_2"] for quality in qualities])
    complete = np.mean([quality["from_exemplar_2"] for quality in qualities])
    assert nearest <= prototype[0]
    assert nearest < open_program[0]
    # .0003 is a disc of 512 x 512 pixels that has no like
    assert complete <= max(1.05 * prototype[1], prototype[1] + 0.0003)
    assert complete < open_program[1]
    for made in grown:
        assert made.report["quality"]["seam"] <= 1
        assert max(longest_lines(made, exemplar)) <= 0.5


def test_water_does_not_lie_in_rows(corpus):
    """What is laid below itself all over correlates with itself nearly fully, the exemplar .1."""
    exemplar = picture(corpus, "embark/1_bw.jpg")

    grown = [grow("texture_optimization", exemplar, (512, 512), seed=seed) for seed in range(4)]

    assert np.mean([made.report["quality"]["repetition"] for made in grown]) < 0.5


@pytest.mark.parametrize(
    "name",
    [
        "embark/1_bw.jpg", "embark/bricks.png", "embark/multiexample/1.jpg",
        "embark/multiexample/2.jpg", "skimage/brick.png", "skimage/camera.png",
        "skimage/chessboard_GRAY.png", "skimage/grass.png", "oiio/bayer.png", "oiio/checker.tx",
        "oiio/grid.tif", "oiio/tahoe-tiny.tif",
    ],
)  # fmt: skip
def test_half_of_an_exemplar_is_the_most_that_is_copied(corpus, name):
    exemplar = picture(corpus, name, alpha=True)

    made = grow("texture_optimization", exemplar, (512, 512), seed=2)

    assert max(longest_lines(made, exemplar)) <= 0.5


@pytest.mark.parametrize("technique", ["texture_optimization", "ashikhmin"])
def test_a_guide_is_followed(corpus, technique):
    exemplar, ours, theirs = (
        picture(corpus, f"embark/{name}.jpg")[::2, ::2]
        for name in ("2", "masks/2_example", "masks/2_target")
    )

    made = grow(
        technique, exemplar, theirs.shape[1::-1],
        exemplar_guide=ours, guide=theirs, guide_weight=0.7,
    )  # fmt: skip

    found = ours[sources(made, exemplar)]
    dark, wanted = found.mean(axis=-1) < 0.5, theirs.mean(axis=-1) < 0.5
    # Without the weight of the guide it would be 0.34 (0.52 by ashikhmin)
    assert (dark & wanted).sum() / (dark | wanted).sum() >= 0.8


def test_a_hole_in_bricks_is_filled_with_bricks(corpus):
    whole = picture(corpus, "skimage/brick.png", 256)
    hole = np.zeros((256, 256, 1), np.float32)
    hole[100:150, 90:160] = 1
    broken = np.where(hole > 0, np.float32(0), whole)

    made = grow("hole_filling", broken, (256, 256), hole=hole)

    inside = made.image.pixels[100:150, 90:160]
    assert made.image.pixels[hole[..., 0] == 0].tobytes() == whole[hole[..., 0] == 0].tobytes()
    # As light and as varied as bricks and mortar are around it
    assert inside.mean() == pytest.approx(whole.mean(), rel=0.1)
    assert inside.std() == pytest.approx(whole.std(), rel=0.3)
