"""What reading a damaged model comes to."""

from collections.abc import Mapping

import numpy as np

from worker.errors import WorkerError
from worker.models.formats import read_model


def outcome(data: bytes, files: Mapping[str, bytes]) -> str:
    """Return the code of the refusal, "read" for a model, "broken" if its positions are none."""
    try:
        model = read_model(data, files)
    except WorkerError as refusal:
        return refusal.code
    sound = all(np.isfinite(part.mesh.positions).all() for part in model.parts)
    return "read" if sound and model.parts else "broken"
