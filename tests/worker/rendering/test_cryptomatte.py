"""Object ids as Cryptomatte has them: hashes of names, ranked by how much of a pixel they are."""

import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.worker.images.exr_bytes import parse_exr
from tests.worker.rendering.studio import Studio

SIZE = (40, 30)
UNLIT = {"technique": "unlit"}


def things() -> dict[str, Any]:
    """A ball before a wall that ends at the right, and a small disc beside it; seen along -z."""
    return {
        "camera": {"type": "orthographic", "height": 2.0, "pose": {"eye": [0.0, 0.0, 5.0]}},
        "lights": [],
        "nodes": [
            {"name": "bunny", "mesh": {"type": "sphere", "radius": 0.6}, "surface": UNLIT},
            {
                "mesh": {"type": "plane", "width": 4.0, "height": 4.0},
                "transform": {"translation": [-1.49, 0.0, -1.0]},
            },
            {
                "name": "bunny",
                "mesh": {"type": "disk", "radius": 0.2},
                "transform": {"translation": [1.0, 0.7, 0.0]},
            },
        ],
    }


def test_ranks_are_those_of_counting() -> None:
    from worker.rendering.cryptomatte import RANKS, ranks  # noqa: PLC0415  needs OpenGL

    numbers = np.random.default_rng(3).integers(0, 12, (7, 5, 16))
    found, shares = ranks(numbers)

    assert found.shape == shares.shape == (7, 5, RANKS)
    for row, column in np.ndindex(7, 5):
        counted = Counter(int(n) for n in numbers[row, column] if n)
        expected = sorted(counted.items(), key=lambda item: (-item[1], item[0]))[:RANKS]
        expected += [(0, 0)] * (RANKS - len(expected))
        assert [tuple(pair) for pair in expected] == [
            (int(n), round(16 * float(s)))
            for n, s in zip(found[row, column], shares[row, column], strict=True)
        ]


@pytest.mark.parametrize("samples", [1, 4])
def test_few_samples_leave_ranks_empty(samples: int) -> None:
    from worker.rendering.cryptomatte import ranks  # noqa: PLC0415  needs OpenGL

    found, shares = ranks(np.full((1, 1, samples), 3))

    assert found[0, 0].tolist() == [3, 0, 0, 0, 0, 0]
    assert shares[0, 0].tolist() == [1, 0, 0, 0, 0, 0]


def test_ids_are_floats_that_survive() -> None:
    """No infinity, no number below the normal ones: their bits might be lost on the way."""
    from worker.rendering.cryptomatte import id_of  # noqa: PLC0415  needs OpenGL

    assert id_of("bunny") == 0x13851A76
    ids = np.array([id_of(f"node {number}") for number in range(3000)], dtype=np.uint32)
    numbers = np.abs(ids.view(np.float32))
    assert np.isfinite(numbers).all()
    assert (numbers >= np.finfo(np.float32).tiny).all()


def matte(layers: dict[str, Any], layer: str, name: str) -> Any:
    """What an artist's program does: add the shares of all ranks that have the name's id."""
    from worker.rendering.cryptomatte import id_of  # noqa: PLC0415  needs OpenGL

    wanted = np.array([id_of(name)], dtype=np.uint32).view(np.float32)[0]
    ranked = np.concatenate([layers[f"{layer}{level:02d}"] for level in range(3)], axis=2)
    return np.where(ranked[..., 0::2] == wanted, ranked[..., 1::2], 0).sum(axis=2)


@pytest.mark.gl
def test_a_matte_is_the_share_of_a_thing(studio: Studio) -> None:
    layers = studio.layers(things(), ["crypto_object", "coverage"], SIZE, 4)
    ids = studio.layers(things(), ["object_id"], (4 * SIZE[0], 4 * SIZE[1]), 1)["object_id"]

    def share(*numbers: int) -> Any:
        shown = np.isin(ids[..., 0], numbers).reshape(SIZE[1], 4, SIZE[0], 4)
        return shown.mean(axis=(1, 3))

    bunny, wall = (matte(layers, "CryptoObject", name) for name in ("bunny", "plane 2"))
    np.testing.assert_array_equal(bunny, share(1, 3))
    np.testing.assert_array_equal(wall, share(2))
    np.testing.assert_allclose(bunny + wall, layers["coverage"][..., 0], atol=1e-6)
    assert 0 < bunny.sum() < wall.sum()
    # Analytic: discs of radius .6 and .2, of 64 corners each, in units of a pixel.
    area = 32 * np.sin(2 * np.pi / 64) * (0.6**2 + 0.2**2) * (SIZE[1] / 2) ** 2
    assert bunny.sum() == pytest.approx(area, rel=0.01)


@pytest.mark.gl
def test_materials_have_mattes_too(studio: Studio) -> None:
    layers = studio.layers(things(), ["crypto_material", "material_id"], SIZE, 1)

    for number in (1, 2):
        expected = layers["material_id"][..., 0] == number
        np.testing.assert_array_equal(
            matte(layers, "CryptoMaterial", f"material {number}"), expected
        )


@pytest.mark.gl
def test_a_file_names_its_ids(tmp_path: Path) -> None:
    """The first seven digits of the layer's own hash are the key of its attributes."""
    from worker.run_job import run  # noqa: PLC0415  needs OpenGL

    output = {"size": list(SIZE), "format": "exr", "layers": ["crypto_object", "depth"]}
    path = tmp_path / "picture.exr"
    body = {"scene": things(), "output": output}
    order = {"kind": "render", "body": body, "digest": "", "assets": str(tmp_path)}
    run(order, path, lambda share, stage: None)

    file = parse_exr(path.read_bytes())
    key = "cryptomatte/3ae39a5"
    assert file.attributes[f"{key}/name"] == ("string", b"CryptoObject")
    assert file.attributes[f"{key}/hash"] == ("string", b"MurmurHash3_32")
    assert file.attributes[f"{key}/conversion"] == ("string", b"uint32_to_float32")
    manifest = json.loads(file.attributes[f"{key}/manifest"][1])
    assert manifest["bunny"] == "13851a76"
    assert set(manifest) == {"bunny", "plane 2"}
    middle = file.channels["CryptoObject00.R"][SIZE[1] // 2, SIZE[0] // 2]
    assert np.float32(middle).view(np.uint32) == 0x13851A76
    assert file.channels["CryptoObject00.G"][SIZE[1] // 2, SIZE[0] // 2] == 1
    assert {name.split(".")[0] for name in file.channels if name.startswith("Crypto")} == {
        "CryptoObject",
        "CryptoObject00",
        "CryptoObject01",
        "CryptoObject02",
    }
