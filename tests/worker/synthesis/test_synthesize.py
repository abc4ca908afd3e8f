"""What holds for textures within textures and for the folder of techniques."""

import importlib
import inspect
import pkgutil

import numba
import numpy as np
import pytest
from numba.core.registry import CPUDispatcher
from pydantic import TypeAdapter

import worker.synthesis
from api_schemas.language import FAMILIES
from api_schemas.members import Texture
from worker.images.image import Image
from worker.synthesis import synthesize, synthesize_volume, techniques, warm

ASSET = {"technique": "image", "asset": "0" * 64}
GREY = [{"position": 0.0, "color": [0.0] * 3}, {"position": 1.0, "color": [1.0] * 3}]


def ramp(texture):
    return {"technique": "ramp", "input": texture, "stops": GREY}


def spec(body):
    return TypeAdapter(Texture).validate_python(body)


def test_the_folder_has_the_techniques_of_the_language():
    assert sorted(FAMILIES["textures"]) == techniques()


def test_nested_textures_are_made_at_their_parents_size():
    picture = Image(np.full((5, 7, 1), 0.25, np.float32), "data")

    image = synthesize(spec(ramp(ramp(ASSET))), (16, 9), lambda spec, meaning: picture)

    assert image.pixels.shape == (9, 16, 3)
    assert image.pixels == pytest.approx(0.25)


def test_a_picture_is_told_the_meaning_of_its_slot():
    meanings = []

    def load(spec, meaning):
        meanings.append(meaning)
        return Image(np.zeros((1, 1, 3), np.float32), meaning)

    synthesize(spec(ASSET), (1, 1), load)
    synthesize(spec(ASSET), (1, 1), load, "data")
    synthesize(spec(ramp(ASSET)), (1, 1), load)

    assert meanings == ["colour", "data", "data"]


def test_an_error_of_the_loader_comes_through():
    def load(spec, meaning):
        raise LookupError(spec.asset)

    with pytest.raises(LookupError):
        synthesize(spec(ramp(ASSET)), (1, 1), load)


def kernels():
    for info in pkgutil.iter_modules(worker.synthesis.__path__):
        module = importlib.import_module(f"worker.synthesis.{info.name}")
        for name, value in vars(module).items():
            # A parallel kernel is a function that holds what was compiled in its closure
            inside = inspect.getclosurevars(value).nonlocals if inspect.isfunction(value) else {}
            compiled = inside.get("compiled", value)
            if isinstance(compiled, CPUDispatcher):
                yield f"{info.name}.{name}", compiled


def test_after_warming_no_request_compiles_anything(monkeypatch):
    monkeypatch.setattr(numba.config, "CACHE_DIR", "")  # or it leaves what is there for later
    warm(lambda done, name: None)
    before = {name: len(kernel.signatures) for name, kernel in kernels()}
    picture = Image(np.zeros((3, 4, 4), np.float32), "colour")
    picture.pixels.flags.writeable = False

    for name in ("perlin", "checkerboard"):
        synthesize(spec({"technique": name}), (40, 30), None)
    for interpolation in ("linear", "smooth", "step"):
        body = ramp(ASSET) | {"interpolation": interpolation}
        synthesize(spec(body), (40, 30), lambda spec, meaning: picture)
    synthesize(spec({"technique": "perlin", "octaves": 4, "fade": "linear"}), (2500, 70), None)
    for fields in ({"sum": "billow"}, {"depth": 0.5}, {"time": 0.5}, {"output": "slope"}):
        synthesize(spec({"technique": "perlin", **fields}), (40, 30), None)
    for cut in ("plane", "slice", "projected"):
        for tilt in ([0.0, 0.0], [0.5, 0.5]):
            body = {"technique": "wavelet", "cut": cut, "tilt": tilt}
            synthesize(spec(body), (80, 70), None)
    for name in ("gabor", "perlin_curve", "gardner_product", "marble", "wood", "worley", "granite"):
        synthesize(spec({"technique": name}), (40, 30), None)
    for name in ("perlin", "wavelet", "gardner_product", "marble", "wood", "worley", "granite"):
        synthesize_volume(spec({"technique": name}), (12, 10, 8))

    assert "ramp._fill_ramp" in before
    assert before["ramp._fill_ramp"] == 1
    assert {name: len(kernel.signatures) for name, kernel in kernels()} == before


def test_warming_reports_how_far_it_is():
    reports = []

    warm(lambda done, name: reports.append((done, name)))

    shares = [done for done, _ in reports]
    assert shares == sorted(shares)
    assert all(0 <= share <= 1 for share in shares)
    assert [name for _, name in reports] == techniques()


def test_progress_rises_over_all_textures_of_a_request():
    told = []
    body = ramp(ramp({"technique": "perlin"}))
    synthesize(spec(body), (8, 8), None, report=lambda share, step: told.append((share, step)))
    shares = [share for share, _ in told]
    assert [step for _, step in told] == ["perlin", "ramp", "ramp"]
    assert shares == sorted(shares)
    assert shares == pytest.approx([0, 1 / 3, 2 / 3])
