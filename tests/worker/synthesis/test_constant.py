import numpy as np
import pytest

from api_schemas.base import FLOAT32_MAX


@pytest.mark.parametrize(
    ("value", "texel"),
    [
        (0.25, [0.25]),
        ([0.25], [0.25]),
        ([4.0, 0.5], [2.0, 0.5]),
        ([0.1, 0.2, 3e38], np.float32([0.1, 0.2, 3e38])),
        ([1.0, 0.5, -2.0, 0.25], [0.25, 0.125, -0.5, 0.25]),
        ([3e38, -3e38, 0.0, 2.0], np.float32([FLOAT32_MAX, -FLOAT32_MAX, 0.0, 2.0])),
    ],
)
def test_every_pixel_is_the_value_with_alpha_multiplied_in(make, value, texel):
    pixels = make({"technique": "constant", "value": value}, (3, 2))

    assert pixels.shape == (2, 3, len(texel))
    assert (pixels == texel).all()
