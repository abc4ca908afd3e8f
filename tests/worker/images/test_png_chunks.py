from pathlib import Path

import numpy as np
import PIL.Image

from worker.images.png_chunks import is_whole_png


def test_only_a_png_with_all_its_bytes_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "picture.png"
    pixels = np.random.default_rng(1).integers(0, 255, (90, 80, 3), np.uint8)
    PIL.Image.fromarray(pixels).save(path)
    content = path.read_bytes()
    assert is_whole_png(path)

    missing_in_the_middle = content[:8000] + content[12096:]
    for damaged in (b"", content[:5], content[:-1], content[:-12], missing_in_the_middle):
        path.write_bytes(damaged)
        assert not is_whole_png(path)
