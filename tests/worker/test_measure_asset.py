import json
from pathlib import Path

import numpy as np
import PIL.Image
import pytest

from worker import measure_asset
from worker.errors import AssetMissingError, UnusableAssetError


def silent(_fraction: float, _stage: str) -> None:
    pass


def test_warming_names_the_decoder_for_the_fingerprint() -> None:
    stages: list[str] = []

    warmed = measure_asset.warm(lambda _fraction, stage: stages.append(stage))

    assert warmed["fingerprint"].startswith("OpenImageIO 3.")
    assert stages == ["readers", "ready"]


def test_facts_of_a_picture_are_json(tmp_path: Path) -> None:
    stored = tmp_path / ("0" * 64)
    PIL.Image.fromarray(np.zeros((3, 5, 4), np.uint8)).save(stored, format="png")

    facts = measure_asset.run({"path": str(stored)}, tmp_path / "unused", silent)

    assert json.loads(json.dumps(facts)) == {
        "kind": "image",
        "width": 5,
        "height": 3,
        "channels": 4,
        "bits": 8,
        "float": False,
        "format": "png",
        "media_type": "image/png",
        "has_alpha": True,
    }
    assert not (tmp_path / "unused").exists()


def test_a_missing_file_and_a_text_are_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(AssetMissingError):
        measure_asset.run({"path": str(tmp_path / "nothing")}, tmp_path, silent)
    text = tmp_path / "letter.png"
    text.write_text("Dear technical artist")
    with pytest.raises(UnusableAssetError) as refusal:
        measure_asset.run({"path": str(text)}, tmp_path, silent)
    assert refusal.value.code == "asset_unsupported"
