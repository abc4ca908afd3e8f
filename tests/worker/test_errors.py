import ast
import json
from pathlib import Path

import pytest

import worker.errors
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


def test_the_tree_names_every_code_that_the_worker_raises() -> None:
    """Found by reading: a code is a keyword of an error, or the default of its class."""
    root = Path(worker.errors.__file__).parent
    calls = [
        node
        for path in root.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Call)
    ]
    raised = {
        keyword.value.value
        for call in calls
        for keyword in call.keywords
        if keyword.arg == "code" and isinstance(keyword.value, ast.Constant)
    }
    tree = (worker.errors.__doc__ or "").replace("|", " ").split()

    assert "asset_file_missing" in raised
    assert raised <= set(tree)


def test_one_class_may_carry_a_narrower_code() -> None:
    error = UnusableAssetError("20000 texels wide; the most is 16384", code="asset_too_large")

    assert error.code == "asset_too_large"
    assert error.pointer is None
    assert str(error) == "20000 texels wide; the most is 16384"
