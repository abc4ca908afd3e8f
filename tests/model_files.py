"""Models as files on disk, drawn in this process as a child of the service would."""

import json
import shutil
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from api_schemas.digest import digest
from api_schemas.normalise import normalise
from api_schemas.requests import RenderRequest
from tests.examples import sha256

PICTURES = (".png", ".jpg", ".jpeg")
BESIDE = (".bin", ".mtl", *PICTURES)


class ModelFiles:
    """Uploads, as the service would store them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def upload(self, path: Path) -> str:
        """Store a file under its SHA-256."""
        name = sha256(path)
        stored = self.folder / name[:2] / name
        stored.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, stored)
        return name

    def mesh(self, path: Path, **more: Any) -> dict[str, Any]:
        """A model with all that lies beside it."""
        siblings = (file for file in path.parent.iterdir() if file.suffix.lower() in BESIDE)
        files = {file.name: self.upload(file) for file in siblings}
        return {"type": "model", "asset": self.upload(path), "files": files, **more}

    def draw(
        self, scene: dict[str, Any], size: tuple[int, int] = (256, 256), **output: Any
    ) -> NDArray[np.float32]:
        """Draw a scene; linear float32 (height, width, 4), alpha premultiplied."""
        # Imported here: it needs OpenGL.
        from worker import run_job  # noqa: PLC0415
        from worker.images import image_io  # noqa: PLC0415

        body = {"scene": scene, "output": {"size": list(size), "exr_type": "float", **output}}
        request = normalise(RenderRequest.model_validate_json(json.dumps(body)), "exr", {})
        out = self.folder / "picture.exr"
        order = {
            "kind": "render",
            "body": request.model_dump(mode="json"),
            "digest": digest(request),
            "assets": str(self.folder),
            "preview": str(self.folder / "preview"),
        }
        self.facts = run_job.run(order, out, lambda share, stage: None)
        return image_io.read(out, "linear", "colour").pixels
