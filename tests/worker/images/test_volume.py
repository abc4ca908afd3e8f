import numpy as np
import pytest

from worker.images.volume import Volume


def test_a_volume_knows_its_size():
    volume = Volume(np.zeros((2, 3, 5, 4), np.float32), "colour")

    assert (volume.depth, volume.height, volume.width, volume.channels) == (2, 3, 5, 4)


def test_slices_lie_below_each_other_from_the_first_and_come_back():
    voxels = np.arange(24, dtype=np.float32).reshape(2, 3, 4, 1)
    volume = Volume(voxels, "data")

    stacked = volume.stacked()

    assert stacked.pixels.shape == (6, 4, 1)
    assert (stacked.pixels[:3] == volume.slice(0).pixels).all()
    assert (stacked.pixels[3:] == volume.slice(1).pixels).all()
    assert (Volume.unstacked(stacked, 2).voxels == voxels).all()


@pytest.mark.parametrize("shape", [(4, 4, 3), (0, 4, 4, 3), (4, 0, 4, 3), (4, 4, 4, 0), (4,) * 4])
def test_a_volume_of_another_shape_is_refused_unless_four_channels_are_the_most(shape):
    array = np.zeros(shape, np.float32)
    if shape == (4, 4, 4, 4):
        assert Volume(array, "data").channels == 4
    else:
        with pytest.raises(ValueError, match="shape"):
            Volume(array, "data")


@pytest.mark.parametrize("kind", [np.float64, np.uint8])
def test_any_other_number_type_is_refused(kind):
    with pytest.raises(TypeError, match="float32"):
        Volume(np.zeros((2, 2, 2, 1), kind), "data")


def test_any_other_meaning_is_refused():
    with pytest.raises(ValueError, match="meaning"):
        Volume(np.zeros((1, 1, 1, 1), np.float32), "density")
