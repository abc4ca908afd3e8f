"""One job from request to file, as a list of steps: find, synthesise or render, encode, hash.

This is the executor that the door in `worker.jobs` knows by name and loads in its children.
"""

import hashlib
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from api_schemas.families import Meaning, TextureSpec
from api_schemas.feasibility import assets_in
from api_schemas.requests import REQUESTS, RenderRequest, Request
from api_schemas.solid import worn_depth, worn_size
from api_schemas.textures.image import ImageSpec
from worker import result_file, synthesis
from worker.errors import AssetMissingError
from worker.fingerprint import fingerprint
from worker.images.image import Image
from worker.images.volume import Volume
from worker.preview import Preview
from worker.rendering import renderer
from worker.rendering.packing import PICTURE
from worker.rendering.texture_maker import TextureMaker
from worker.slices import slices_in
from worker.stages import Report, Stages, Timed
from worker.uploaded_models import UploadedModels
from worker.uploaded_pictures import UploadedPictures


def warm(report: Report) -> dict[str, Any]:
    """Compile the kernels of textures and the usual shaders, or find them compiled.

    The readers of models are not among them: nobody should wait for them who draws none.

    Returns:
        `fingerprint`: everything outside a request that decides pixels.
    """
    synthesis.warm(lambda share, name: report(0.5 * share, name))
    warm_shaders(lambda share, name: report(0.5 + 0.5 * share, name))
    report(1.0, "ready")
    return {"fingerprint": fingerprint()}


def warm_shaders(report: Report) -> None:
    """Compile the usual shaders, or find them compiled."""
    renderer.warm(report, _maker(_no_picture))


def run(request: dict[str, Any], out: Path, report: Report) -> dict[str, Any]:
    """Make the picture a request asks for and write it to `out`.

    Args:
        request: `kind`, the normalised `body`, its `digest`, the folder of `assets`, and
            where a `preview` may be left.
        out: Where the file is written; whoever asked gives it its final name.
        report: Told the share of the job that is done, 0..1, and the name of the stage.

    Returns:
        JSON-able facts: media_type, bytes, sha256, width, height, timings in milliseconds, counts,
        report, warnings.

    Raises:
        WorkerError: The job cannot be done; its code says why.
    """
    body: Request = REQUESTS[request["kind"]].model_validate(request["body"])
    width, height = body.output.file_size
    stages = Stages(report)
    timings, counts = stages.timings, dict[str, int]()
    found: Mapping[str, Any] = {}
    warnings: tuple[str, ...] = ()
    with stages.stage("find", 0.0, 0.02):
        assets = Path(request["assets"])
        pictures = UploadedPictures(assets)
        uploads = UploadedModels(assets, pictures)
        _find(body, assets)
    if isinstance(body, RenderRequest):
        # A band is written while the next one is waiting to be drawn.
        with stages.stage("render", 0.02, 0.98) as progress:
            drawn = renderer.render(
                body.scene, body.output, _maker(pictures.read), uploads.read, progress
            )
            bands = Timed(drawn.bands)
            start = time.perf_counter()
            media_type = result_file.write(
                bands, body.output, request["digest"], out, drawn.attributes
            )
            encoding = 1000 * (time.perf_counter() - start - bands.seconds)
        timings["encode_ms"] = round(encoding, 3)
        timings["render_ms"] = round(timings["render_ms"] - encoding, 3)
        timings |= drawn.timings
        counts, found, warnings = drawn.counts, drawn.report, drawn.warnings
    elif body.output.slices:
        with stages.stage("synthesise", 0.02, 0.85) as progress:
            across, up = body.output.size
            size = (across, up, body.output.slices)
            volume = synthesis.synthesize_volume(body.texture, size, report=progress)
        with stages.stage("encode", 0.85, 0.98):
            band = slices_in(volume, body.output)
            media_type = result_file.write([band], body.output, request["digest"], out)
    else:
        with stages.stage("synthesise", 0.02, 0.85) as progress:
            made = synthesis.outcome(
                body.texture,
                (width, height),
                pictures.read,
                report=progress,
                show=Preview(Path(request["preview"])).show,
            )
        found = made.report
        with stages.stage("encode", 0.85, 0.98):
            band = {PICTURE: made.image} | {name: made.layers[name] for name in body.output.layers}
            media_type = result_file.write([band], body.output, request["digest"], out)
    with stages.stage("hash", 0.98, 1.0), out.open("rb") as file:
        sha256 = hashlib.file_digest(file, "sha256").hexdigest()
    return {
        "media_type": media_type,
        "bytes": out.stat().st_size,
        "sha256": sha256,
        "width": width,
        "height": height,
        "timings": timings,
        "counts": counts,
        "report": dict(found),
        "warnings": list(warnings),
    }


def _find(body: Request, assets: Path) -> None:
    """Look whether every asset of a request is stored.

    Raises:
        AssetMissingError: The first one that is not.
    """
    for pointer, asset in assets_in(body):
        if not (assets / asset[:2] / asset).is_file():
            raise AssetMissingError("the asset is not stored any more", pointer)


def _maker(read: Callable[[ImageSpec, Meaning], Image]) -> TextureMaker:
    """Make textures for surfaces: pictures at their own size, others at their technique's."""

    def picture(
        spec: TextureSpec,
        meaning: Meaning,
        proportion: tuple[int, int] = (1, 1),
        rendered: Mapping[str, Image] = MappingProxyType({}),
    ) -> Image:
        def found(spec: ImageSpec, meaning: Meaning) -> Image:
            return rendered.get(spec.asset) or read(spec, meaning)

        if isinstance(spec, ImageSpec):
            return found(spec, meaning)
        return synthesis.synthesize(spec, worn_size(spec, proportion), found, meaning)

    def volume(spec: TextureSpec, meaning: Meaning) -> Volume:
        side = worn_depth(spec)
        return synthesis.synthesize_volume(spec, (side, side, side), meaning)

    return TextureMaker(picture, volume, synthesis.closed_form)


def _no_picture(spec: ImageSpec, meaning: Meaning) -> Image:
    raise AssetMissingError("there are no uploads to warm up with")
