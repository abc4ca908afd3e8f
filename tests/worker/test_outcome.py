"""What stands beside a picture has its size, and comes out of the technique as it was made."""

from types import SimpleNamespace

import numpy as np
import pytest

from api_schemas.textures.constant import ConstantSpec
from api_schemas.textures.levels import LevelsSpec
from worker import synthesis
from worker.images.image import Image
from worker.outcome import Outcome


def grey(width, height):
    return Image(np.full((height, width, 1), 0.5, np.float32), "data")


def test_a_layer_of_another_size_is_refused():
    with pytest.raises(ValueError, match="field"):
        Outcome(grey(4, 2), layers={"field": grey(2, 4)})


def test_the_layers_and_the_report_of_a_technique_arrive(monkeypatch):
    made = Outcome(grey(4, 2), {"field": grey(4, 2)}, {"verdict": "flat"})
    module = SimpleNamespace(synthesize=lambda spec, size, inputs, report: made)
    monkeypatch.setattr(synthesis, "_module", lambda technique: module)
    spec = ConstantSpec(technique="constant", value=[0.5])
    assert synthesis.outcome(spec, (4, 2), None) is made
    assert synthesis.synthesize(spec, (4, 2), None) is made.image


def test_only_the_texture_itself_is_shown_while_it_is_made(monkeypatch):
    inner, outer = grey(4, 2), grey(4, 2)

    def synthesize(spec, size, inputs, report):
        made = inner if spec.technique == "perlin" else outer
        report(0.5, "half", made)
        return made

    monkeypatch.setattr(synthesis, "_module", lambda name: SimpleNamespace(synthesize=synthesize))
    spec = LevelsSpec.model_validate({"technique": "levels", "input": {"technique": "perlin"}})
    shown = []
    synthesis.outcome(spec, (4, 2), None, show=shown.append)
    assert shown == [outer]
