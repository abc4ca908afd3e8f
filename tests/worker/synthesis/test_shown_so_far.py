"""What is told and shown of textures from examples while they are made."""

import numpy as np
import pytest

from tests.growing import TEXTURE, colours, grow, noise, upload
from worker.images.image import Image
from worker.synthesis import outcome


@pytest.mark.parametrize("technique", ["texture_optimization", "retargeting"])
def test_shares_never_fall_and_pictures_are_made_of_the_exemplar(technique):
    exemplar, shares, seen = noise(128, 128), [], []
    body = {"technique": technique, "exemplar": upload(0), "size": [160, 96]}

    outcome(
        TEXTURE.validate_python(body),
        (160, 96),
        lambda spec, meaning: Image(exemplar, meaning),
        report=lambda share, stage: shares.append(share),
        show=seen.append,
    )

    assert shares == sorted(shares)
    assert len(set(shares)) > 5
    assert len(seen) >= 2, "one for each level, or each step outwards"
    for image in seen:
        assert colours(image.pixels) <= colours(exemplar)
        # A part of all there is, and not one corner of it again and again
        assert len(colours(image.pixels)) > 0.1 * image.width * image.height
        assert np.isfinite(image.pixels).all()


@pytest.mark.parametrize("technique", ["hole_filling", "image_shuffling"])
def test_what_is_not_made_anew_is_seen_from_the_beginning(technique):
    picture, seen = noise(64, 80), []
    part = np.zeros((64, 80, 1), np.float32)
    part[16:40, 20:52] = 1
    fields = {"hole": part} if technique == "hole_filling" else {"region": part, "shift": [9, 5]}

    made = grow(technique, picture, (80, 64), show=seen.append, **fields).image.pixels

    assert len(seen) == 2, "64 and 32 pixels high"
    stays = (made == picture).all(axis=-1)
    stays[8:56, 12:70] = False
    for image in seen:
        assert image.pixels[stays].tobytes() == picture[stays].tobytes()
        assert colours(image.pixels) <= colours(picture)
    hole = part[..., 0] > 0
    if technique == "hole_filling":
        assert not colours(seen[0].pixels[hole]) & colours(picture[hole])
    # In the end, what has been seen is what was made, but for the last round
    assert (seen[-1].pixels == made).all(axis=-1).mean() > 0.95


def test_what_is_kept_is_seen_from_the_beginning():
    exemplar, keep, seen = noise(32, 32) * 0.5, np.full((64, 80, 3), 0.75, np.float32), []
    mask = np.zeros((64, 80, 1), np.float32)
    mask[16:48, 16:40] = 1

    grow("texture_optimization", exemplar, (80, 64), keep=keep, keep_mask=mask, show=seen.append)

    for image in seen:
        kept = (image.pixels == 0.75).all(axis=-1)
        assert kept.mean() == pytest.approx(mask.mean(), rel=0.2)
        assert colours(image.pixels[~kept]) <= colours(exemplar)
