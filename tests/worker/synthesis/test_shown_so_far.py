"""What is told and shown of textures from examples while they are made."""

import numpy as np
import pytest

from tests.growing import TEXTURE, colours, noise, upload
from worker.images.image import Image
from worker.synthesis import outcome


@pytest.mark.parametrize("technique", ["texture_optimization", "retargeting"])
def test_shares_never_fall_and_pictures_are_made_of_the_exemplar(technique):
    exemplar, shares, seen = noise(64, 64), [], []
    body = {"technique": technique, "exemplar": upload(0), "size": [128, 96]}

    outcome(
        TEXTURE.validate_python(body),
        (128, 96),
        lambda spec, meaning: Image(exemplar, meaning),
        report=lambda share, stage: shares.append(share),
        show=seen.append,
    )

    assert shares == sorted(shares)
    assert len(set(shares)) > 5
    assert len(seen) > 2
    for image in seen:
        assert colours(image.pixels) <= colours(exemplar)
        # A part of all there is, and not one corner of it again and again
        assert len(colours(image.pixels)) > 0.1 * min(64 * 64, image.width * image.height)
        assert np.isfinite(image.pixels).all()
