"""Takes an upload in: to a file as it comes, hashed on the way, then looked at in a child."""

import hashlib
from collections.abc import AsyncGenerator, AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from starlette.concurrency import run_in_threadpool
from starlette.datastructures import UploadFile
from starlette.formparsers import MultiPartException, MultiPartParser
from starlette.requests import Request

from api_schemas.assets import ASSET_FACTS, AssetFacts
from api_schemas.problems import Obstruction
from service.limited_body import chunks
from service.problems import TABLE, ProblemError
from worker.jobs.errors import MeasuringError
from worker.jobs.queue import JobQueue

FORM: Final = "multipart/form-data"
FIELD: Final = "file"
FAMILIES: Final = ("image/", "model/")
BUFFER: Final = "application/gltf-buffer"
UNTOLD: Final = ("", "application/octet-stream", "application/x-www-form-urlencoded")
"""What says nothing of a file; the last is curl's word for `--data-binary`."""
PIECE: Final = 1 << 18


@dataclass(frozen=True, slots=True)
class Upload:
    """A file on its way in; `media_type` is what the caller calls it, empty without a word."""

    media_type: str
    content: AsyncIterator[bytes]


@asynccontextmanager
async def upload(request: Request, limit: int) -> AsyncIterator[Upload]:
    """Open the file that a request carries, bare or as the one field of a form.

    Raises:
        ProblemError: It carries none, or one that is too large.
    """
    media_type = _bare(request.headers.get("content-type"))
    if request.headers.get("content-encoding", "identity").lower() != "identity":
        raise ProblemError("media_type_unsupported", "compressed bodies are not taken")
    if media_type == FORM:
        async with _form_file(request, limit) as file:
            yield Upload(_bare(file.content_type), _pieces(file))
    elif media_type.startswith(FAMILIES) or media_type in (BUFFER, *UNTOLD):
        yield Upload(media_type, chunks(request, limit))
    else:
        raise ProblemError(
            "media_type_unsupported",
            f"image/*, model/*, {BUFFER}, application/octet-stream and {FORM} are taken",
        )


async def stored(content: AsyncIterator[bytes], path: Path) -> str:
    """Write an upload to a file and return its SHA-256."""
    sha256 = hashlib.sha256()
    with path.open("wb") as file:
        async for chunk in content:
            sha256.update(chunk)
            await run_in_threadpool(file.write, chunk)
    return sha256.hexdigest()


def may_be_more(known: AssetFacts, media_type: str) -> bool:
    """Whether an upload that is there already is now called something better.

    Any bytes may be a buffer, and be called one; what their content tells can be more.
    """
    return known.kind == "buffer" and media_type != BUFFER


def measured_and_kept(
    engine: JobQueue,
    tenant: str,
    path: Path,
    sha256: str,
    media_type: str,
    limit_seconds: float,
) -> AssetFacts:
    """Look into an upload, which its caller calls `media_type`, and take it over.

    Returns:
        What is known of it from now on.

    Raises:
        ProblemError: It cannot be used.
    """
    try:
        facts = engine.measure(path, limit_seconds, media_type)
    except MeasuringError as error:
        code = error.failure["code"]
        known = code if TABLE.get(code, (0, ""))[0] == 409 else "asset_unusable"
        raise ProblemError(known, error.failure["message"]) from None
    found = ASSET_FACTS.validate_python(facts | {"sha256": sha256, "bytes": path.stat().st_size})
    told = found.model_dump(mode="json")
    there = ASSET_FACTS.validate_python(engine.assets.put(tenant, path, sha256, told).facts)
    if not may_be_more(there, found.media_type):
        return there
    engine.assets.tell(tenant, sha256, told)
    return found


@contextmanager
def passing(path: Path) -> Iterator[Path]:
    """Remove a file in the end, unless it was taken over."""
    try:
        yield path
    finally:
        path.unlink(missing_ok=True)


@asynccontextmanager
async def _form_file(request: Request, limit: int) -> AsyncIterator[UploadFile]:
    async def body() -> AsyncGenerator[bytes, None]:
        async for chunk in chunks(request, limit):
            yield chunk

    try:
        form = await MultiPartParser(request.headers, body(), max_files=1, max_fields=8).parse()
    except MultiPartException as error:
        raise ProblemError("multipart_malformed", error.message) from None
    try:
        file = form.get(FIELD)
        if not isinstance(file, UploadFile):
            raise _misfit("missing", f"the form must hold a file called {FIELD}")
        if len(form.multi_items()) != 1:
            raise _misfit("unknown_key", f"the form must hold nothing but one {FIELD}")
        yield file
    finally:
        await form.close()


async def _pieces(file: UploadFile) -> AsyncIterator[bytes]:
    while piece := await file.read(PIECE):
        yield piece


def _bare(content_type: str | None) -> str:
    """Return a media type without its parameters."""
    return (content_type or "").partition(";")[0].strip().lower()


def _misfit(code: str, message: str) -> ProblemError:
    problem = Obstruction(code=code, pointer="", message=message)
    return ProblemError("request_invalid", message, problems=[problem])
