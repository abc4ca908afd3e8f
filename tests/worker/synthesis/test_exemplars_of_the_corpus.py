"""Pictures of the corpus grown, guided and mended.

The distances are those of 9 x 9 patches at half the size: to the nearest of the exemplar's, and
back. A prototype of the method and the best open program were measured in this way on the same
exemplars. Another seed changes them by up to a tenth (measured on three seeds), so they may be a
tenth above the prototype's.
"""

import numpy as np
import pytest

from tests.growing import grow, sources
from worker.images import image_io

pytestmark = pytest.mark.corpus
SEEDS_DIFFER = 1.1


def picture(corpus, name, side=None):
    image = image_io.read(corpus / "3_textures" / name, "srgb", "colour", alpha=False)
    return image.pixels[:side, :side, :3]


@pytest.mark.parametrize(
    ("name", "side", "prototype", "open_program"),
    [
        ("skimage/brick.png", 256, (0.012, 0.008), (0.017, 0.009)),
        ("embark/1.jpg", None, (0.014, 0.016), (0.019, 0.016)),
        ("embark/2.jpg", None, (0.010, 0.016), (0.013, 0.021)),
        ("embark/4.png", None, (0.021, 0.004), (0.037, 0.007)),
    ],
)
def test_grown_textures_are_near_to_their_exemplars(corpus, name, side, prototype, open_program):
    made = grow("texture_optimization", picture(corpus, name, side), (512, 512), seed=2)

    quality = made.report["quality"]
    assert quality["to_exemplar_2"] <= SEEDS_DIFFER * prototype[0]
    assert quality["to_exemplar_2"] < open_program[0]
    assert quality["from_exemplar_2"] <= SEEDS_DIFFER * max(prototype[1], open_program[1])
    assert quality["seam"] <= 1


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
