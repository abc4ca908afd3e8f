"""Runs an example in this process, as a child of the service would."""

import shutil
from pathlib import Path
from typing import Any

from api_schemas.assets import ASSET_FACTS, AssetFacts
from api_schemas.digest import digest
from api_schemas.normalise import normalise
from api_schemas.requests import REQUESTS
from tests.examples import ASSETS, examples, sha256
from worker import measure_asset, run_job


def run_example(name: str, out: Path, assets: Path, **output: Any) -> dict[str, Any]:
    """Run an example with some fields of its output replaced; return the executor's facts.

    Args:
        name: The example's file name without its ending.
        out: Where the picture goes.
        assets: A folder for the uploads of all examples.
        **output: Fields of the request's `output`, `format` at least.
    """
    facts = {asset: _upload(path, asset, assets) for path in ASSETS for asset in [sha256(path)]}
    kind, body = examples()[name]
    body["output"] = {**body.get("output", {}), **output}
    request = normalise(REQUESTS[kind].model_validate(body), output["format"], facts)
    order = {
        "kind": kind,
        "body": request.model_dump(mode="json"),
        "digest": digest(request),
        "assets": str(assets),
        "preview": str(assets / "preview"),
    }
    return run_job.run(order, out, _unreported)


def _upload(path: Path, asset: str, folder: Path) -> AssetFacts:
    stored = folder / asset[:2] / asset
    stored.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(path, stored)
    measured = measure_asset.run({"path": str(stored)}, folder / "unused", _unreported)
    known = {"sha256": asset, "bytes": path.stat().st_size}
    return ASSET_FACTS.validate_python(measured | known)


def _unreported(_share: float, _stage: str) -> None:
    pass
