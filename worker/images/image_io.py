"""Picture files in and out; it and `scanlines` are the only importers of OpenImageIO.

Reading accepts PNG, OpenEXR, JPEG, TIFF and Radiance HDR, told by content. Of several parts, pages
or mip levels the first is read. Names choose the channels: R, G, B and A, else R and G, else Y and
A, else an only channel. PNG palettes and transparent colours are expanded. EXR texels are put into
the display window and, as colour, taken from the file's chromaticities to Rec.709; embedded
profiles, gAMA and cHRM of other files are ignored: what the caller says decides. Exif and TIFF
orientation is applied. A decoder's warning counts as damage.

Writing makes equal bytes of equal pictures: no clock, no host. A picture may come in bands of rows,
so that no more than a band of it is ever in memory.
"""

import re
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypedDict

import numpy as np
import OpenImageIO
from numpy.typing import NDArray

from api_schemas.families import Meaning
from api_schemas.output import SIDE_MAX, ExrType, PngBits, ToneCurve
from worker.errors import UnusableAssetError
from worker.images.codes import Transfer
from worker.images.colour import REC709_CHROMATICITIES
from worker.images.display import display_codes
from worker.images.exr_layers import Channels, join_layers
from worker.images.file_header import TEXELS_MAX, Header, inspect, too_large
from worker.images.file_kinds import FileKind, sniff
from worker.images.image import Image
from worker.images.linearise import linearise
from worker.images.png_filters import choose_png_filter
from worker.images.pyramids import mip_chain
from worker.images.scanlines import Scanlines, write_levels, write_parts
from worker.images.windows import place, turn

OpenImageIO.attribute("limits:resolution", SIDE_MAX)
OpenImageIO.attribute("limits:imagesize_MB", TEXELS_MAX * 16 // 2**20)
# A file whose first bytes say PNG is never offered to another decoder.
OpenImageIO.attribute("try_all_readers", 0)

_PNG_FILTERS = {"none": 8, "sub": 16, "up": 32}  # libpng's PNG_FILTER_NONE, _SUB, _UP
_COLOUR_SPACES: dict[Transfer, str] = {"srgb": "srgb_rec709_scene", "linear": "lin_rec709_scene"}


class ImageFacts(TypedDict):
    """What is known of a picture file that decodes without fault.

    `bits` and `float` are of the stored numbers, `channels` those that are read, `width` and
    `height` as displayed.
    """

    kind: str
    width: int
    height: int
    channels: int
    bits: int
    float: bool
    format: str
    media_type: str
    has_alpha: bool


def version() -> str:
    """Name the library that encodes, for the platform fingerprint."""
    return f"OpenImageIO {OpenImageIO.VERSION_STRING}"


def measure(path: Path) -> ImageFacts:
    """Look at the header first, then decode once, and say what the file is.

    Raises:
        UnusableAssetError: `asset_unsupported`, `asset_too_large` or, for damage, `asset_unusable`.
    """
    kind = sniff(path)
    with _opened(path, kind) as file:
        header = inspect(file.spec(), kind)
        decoded = _decode(file, header)
    return {
        "kind": "image",
        "width": header.size[0],
        "height": header.size[1],
        "channels": decoded.shape[2],
        "bits": header.bits,
        "float": header.is_float,
        "format": kind.format,
        "media_type": kind.media_type,
        "has_alpha": header.alpha != "none",
    }


def read(path: Path, transfer: Transfer, meaning: Meaning, *, alpha: bool = True) -> Image:
    """Read a picture as linear float32; colour with its alpha premultiplied.

    Args:
        path: A file of any name.
        transfer: The curve of the stored numbers; alpha never has one.
        meaning: Of the slot that takes the picture.
        alpha: Whether to read the picture's alpha; without it colours stay as they are stored.

    Raises:
        UnusableAssetError: As `measure`.
    """
    kind = sniff(path)
    with _opened(path, kind) as file:
        header = inspect(file.spec(), kind)
        decoded = _decode(file, header)
    coverage = header.alpha
    if coverage != "none" and not alpha:
        decoded, coverage = np.ascontiguousarray(decoded[..., :-1]), "none"
    pixels = linearise(decoded, transfer, coverage, meaning, header.rec709)
    return Image(turn(place(pixels, header.data, header.display), header.orientation), meaning)


def write_png(
    bands: Iterable[Image],
    height: int,
    path: Path,
    *,
    bits: PngBits,
    transfer: Transfer,
    exposure: float,
    tone_curve: ToneCurve,
) -> None:
    """Write a PNG: straight alpha, 1 or 2 channels as grey, sRGB or gAMA chunks for light.

    Args:
        bands: The picture's rows from the top, some at a time; the first chooses the row filter.
        height: Of the picture.
        path: Where the file goes.
        bits: As `display_codes` takes it, and so are the rest.
        transfer: The curve of the codes.
        exposure: In stops.
        tone_curve: Of colour.

    Raises:
        OSError: The file cannot be written.
    """
    rest = iter(bands)
    image = next(rest)
    codes = display_codes(image, bits, transfer, exposure, tone_curve)
    spec = OpenImageIO.ImageSpec(image.width, height, image.channels, f"uint{bits}")
    spec.attribute("oiio:UnassociatedAlpha", 1)
    # Level 1 is 3 to 9 times faster than 6 and 9, for files a tenth larger.
    spec.attribute("png:compressionLevel", 1)
    spec.attribute("png:filter", _PNG_FILTERS[choose_png_filter(codes)])
    # Data in its own numbers says nothing about colour; without a word it would be called sRGB.
    is_light = transfer == "srgb" or image.meaning == "colour"
    spec.attribute("oiio:ColorSpace", _COLOUR_SPACES[transfer] if is_light else "data")
    with Scanlines("png", path, spec) as file:
        file.write(codes)
        for image in rest:
            file.write(display_codes(image, bits, transfer, exposure, tone_curve))


def write_exr(
    bands: Iterable[Mapping[str, Image]],
    height: int,
    path: Path,
    *,
    pixel_type: ExrType,
    digest: str,
    version: str,
    mipmaps: bool = False,
    parts: bool = False,
    attributes: Mapping[str, str] = MappingProxyType({}),
) -> None:
    """Write an OpenEXR file: linear, premultiplied, zip; layers as `join_layers` names them.

    Attributes `texloom:digest` and `texloom:version` say what made it. With mipmaps it is the
    tiled kind that texture caches read, and is held whole while it is written.

    Args:
        bands: The same layers of the picture's rows from the top, some at a time.
        height: Of the picture.
        path: Where the file goes.
        pixel_type: As `join_layers` takes it.
        digest: Of the request.
        version: Of this program.
        mipmaps: Whether the box means of `mip_chain` are written as well, in tiles.
        parts: Whether each layer is a part of its own, with the channels of a picture; then all
            rows come at once, and there are no mipmaps.
        attributes: What else the file says of itself.

    Raises:
        ValueError: The layers of a band are none, or of different sizes.
        OSError: The file cannot be written.
    """
    rest = iter(bands)
    layers = next(rest)
    said = {"texloom:digest": digest, "texloom:version": version, **attributes}
    if parts:
        pictures = {name: {"": image} for name, image in layers.items()}
        joined = {name: join_layers(picture, pixel_type) for name, picture in pictures.items()}
        specs = [_exr_spec(pictures[name], joined[name], height, said) for name in pictures]
        for name, spec in zip(pictures, specs, strict=True):
            spec.attribute("oiio:subimagename", name)
        write_parts(path, specs, [channels.pixels for channels in joined.values()])
        return
    channels = join_layers(layers, pixel_type)
    spec = _exr_spec(layers, channels, height, said)
    if mipmaps:
        bands_of = [channels.pixels, *(join_layers(more, pixel_type).pixels for more in rest)]
        write_levels(path, spec, mip_chain(np.concatenate(bands_of)))
        return
    with Scanlines("openexr", path, spec) as file:
        file.write(channels.pixels)
        for layers in rest:
            file.write(join_layers(layers, pixel_type).pixels)


def _exr_spec(
    layers: Mapping[str, Image], channels: Channels, height: int, said: Mapping[str, str]
) -> OpenImageIO.ImageSpec:
    _, width, count = channels.pixels.shape
    # Formats per channel are ignored when all are equal: the common one must be given here.
    spec = OpenImageIO.ImageSpec(width, height, count, channels.types[0])
    if len(set(channels.types)) > 1:
        spec.channelformats = tuple(OpenImageIO.TypeDesc(name) for name in channels.types)
    spec.channelnames = channels.names
    spec.attribute("compression", "zip")
    # OpenImageIO writes the clock where this is missing.
    spec.attribute("DateTime", "1970:01:01 00:00:00")
    for name, text in said.items():
        spec.attribute(name, text)
    if any(image.meaning == "colour" for image in layers.values()):
        spec.attribute("oiio:ColorSpace", _COLOUR_SPACES["linear"])
        spec.attribute("chromaticities", OpenImageIO.TypeDesc("float[8]"), REC709_CHROMATICITIES)
    return spec


@contextmanager
def _opened(path: Path, kind: FileKind) -> Iterator[OpenImageIO.ImageInput]:
    """Open a file with the decoder of its kind, alpha as stored.

    The decoder is chosen by the end of a name, and assets have none: a link gives it one.
    """
    hints = OpenImageIO.ImageSpec()
    hints.attribute("oiio:UnassociatedAlpha", 1)
    with tempfile.TemporaryDirectory() as folder:
        link = Path(folder) / f"picture{kind.suffix}"
        link.symlink_to(path.absolute())
        try:
            file = OpenImageIO.ImageInput.open(str(link), hints)
            if file is None:
                raise _refusal_of_opening(kind)
            yield file
            file.close()
        except UnicodeDecodeError as error:
            # Names or complaints that quote the file's own bytes.
            raise _damaged(kind) from error


def _refusal_of_opening(kind: FileKind) -> UnusableAssetError:
    complaint = OpenImageIO.geterror()
    if 'exceeds "limits:' not in complaint:
        return _damaged(kind)
    size = re.search(r"dimension (\d+)x(\d+)", complaint)
    return too_large(f"{size[1]} x {size[2]} texels" if size else "too many texels and channels")


def _damaged(kind: FileKind) -> UnusableAssetError:
    return UnusableAssetError(f"the {kind.format} file is damaged or cut short")


def _decode(file: OpenImageIO.ImageInput, header: Header) -> NDArray[Any]:
    """Decode the chosen channels as stored (half as float32): shape (H, W, C)."""
    wanted = "float" if header.is_float else f"uint{header.bits}"
    decoded = file.read_image(0, 0, 0, header.channels, wanted)
    if decoded is None or file.has_error:
        file.geterror()
        raise UnusableAssetError("the texels are damaged or cut short")
    return np.asarray(decoded)
