import json

import pytest

from worker.errors import (
    AssetMissingError,
    RenderError,
    UnusableAssetError,
    WorkerError,
)


@pytest.mark.parametrize(
    ("error", "code"),
    [
        (UnusableAssetError, "asset_unusable"),
        (AssetMissingError, "asset_missing"),
        (RenderError, "render_failed"),
    ],
)
def test_every_error_has_its_own_code_and_crosses_processes_as_data(
    error: type[WorkerError], code: str
) -> None:
    failure = error("9 is above 8", "/output/size/0").as_failure()

    assert failure == {"code": code, "message": "9 is above 8", "pointer": "/output/size/0"}
    assert json.loads(json.dumps(failure)) == failure


def test_one_class_may_carry_a_narrower_code() -> None:
    error = UnusableAssetError("20000 texels wide; the most is 16384", code="asset_too_large")

    assert error.code == "asset_too_large"
    assert error.pointer is None
    assert str(error) == "20000 texels wide; the most is 16384"
