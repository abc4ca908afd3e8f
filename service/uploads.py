"""Takes an upload in: to a file as it comes, hashed on the way, then looked at in a child."""

import hashlib
from collections.abc import AsyncGenerator, AsyncIterator, Iterator
from contextlib import contextmanager
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
PIECE: Final = 1 << 18


async def upload(request: Request, limit: int) -> AsyncIterator[bytes]:
    """Yield the bytes of the file that a request carries, bare or as the one field of a form.

    Raises:
        ProblemError: It carries none, or one that is too large.
    """
    media_type = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if request.headers.get("content-encoding", "identity").lower() != "identity":
        raise ProblemError("media_type_unsupported", "compressed bodies are not taken")
    if media_type.startswith("image/") or media_type in ("", "application/octet-stream"):
        async for chunk in chunks(request, limit):
            yield chunk
    elif media_type == FORM:
        async for chunk in _form_file(request, limit):
            yield chunk
    else:
        raise ProblemError(
            "media_type_unsupported", f"image/*, application/octet-stream and {FORM} are taken"
        )


async def stored(content: AsyncIterator[bytes], path: Path) -> str:
    """Write an upload to a file and return its SHA-256."""
    sha256 = hashlib.sha256()
    with path.open("wb") as file:
        async for chunk in content:
            sha256.update(chunk)
            await run_in_threadpool(file.write, chunk)
    return sha256.hexdigest()


def measured(engine: JobQueue, path: Path, sha256: str, limit_seconds: float) -> AssetFacts:
    """Return the facts of an uploaded file.

    Raises:
        ProblemError: It cannot be used.
    """
    try:
        facts = engine.measure(path, limit_seconds)
    except MeasuringError as error:
        code = error.failure["code"]
        known = code if TABLE.get(code, (0, ""))[0] == 409 else "asset_unusable"
        raise ProblemError(known, error.failure["message"]) from None
    return ASSET_FACTS.validate_python(facts | {"sha256": sha256, "bytes": path.stat().st_size})


@contextmanager
def passing(path: Path) -> Iterator[Path]:
    """Remove a file in the end, unless it was taken over."""
    try:
        yield path
    finally:
        path.unlink(missing_ok=True)


async def _form_file(request: Request, limit: int) -> AsyncIterator[bytes]:
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
        while piece := await file.read(PIECE):
            yield piece
    finally:
        await form.close()


def _misfit(code: str, message: str) -> ProblemError:
    problem = Obstruction(code=code, pointer="", message=message)
    return ProblemError("request_invalid", message, problems=[problem])
