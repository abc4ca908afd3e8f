"""Serves files that never change: strong ETag, 304, one range, HEAD."""

import re
from collections.abc import Iterator, Mapping
from itertools import chain
from pathlib import Path
from typing import Final

from starlette.requests import Request
from starlette.responses import Response, StreamingResponse

from service.problems import ProblemError

CHUNK: Final = 1 << 20
RANGE: Final = re.compile(r"bytes=(\d{0,18})-(\d{0,18})")
IMMUTABLE: Final = "private, max-age=31536000, immutable"
INERT: Final = {
    "Content-Security-Policy": "sandbox; default-src 'none'",
    "X-Content-Type-Options": "nosniff",
}
"""Whatever a file holds, no browser is to run it."""


def stored_file(
    request: Request, path: Path, *, media_type: str, sha256: str, headers: Mapping[str, str]
) -> Response:
    """Answer with a file, a part of it, or the news that the caller has it already.

    Raises:
        ProblemError: The range asked for lies beyond the end.
        FileNotFoundError: The file was removed meanwhile.
    """
    etag = f'"{sha256}"'
    reading = request.method in ("GET", "HEAD")
    head = {"ETag": etag, "Cache-Control": IMMUTABLE if reading else "no-store", **headers}
    if reading and names(request.headers.get("if-none-match"), etag):
        return Response(status_code=304, headers=head)
    size = path.stat().st_size
    first, last, status = 0, size - 1, 200
    wanted = RANGE.fullmatch(request.headers.get("range", "").replace(" ", ""))
    fresh = request.headers.get("if-range", etag) == etag
    if request.method == "GET" and wanted and wanted[0] != "bytes=-" and fresh:
        part = _part(wanted[1], wanted[2], size)
        if part is not None:
            (first, last), status = part, 206
            head["Content-Range"] = f"bytes {first}-{last}/{size}"
    head |= INERT | {"Accept-Ranges": "bytes", "Content-Length": str(last - first + 1)}
    if request.method == "HEAD":
        return Response(headers=head, media_type=media_type)
    pieces = _pieces(path, first, last)
    beginning = next(pieces, b"")  # opens the file: from here on nobody can take it away
    if len(beginning) == last - first + 1:
        return Response(beginning, status_code=status, headers=head, media_type=media_type)
    return StreamingResponse(
        chain([beginning], pieces), status_code=status, headers=head, media_type=media_type
    )


def names(if_none_match: str | None, etag: str) -> bool:
    """Whether an If-None-Match header names the ETag, by weak comparison."""
    tags = [tag.strip().removeprefix("W/") for tag in (if_none_match or "").split(",")]
    return etag in tags or tags == ["*"]


def _part(first: str, last: str, size: int) -> tuple[int, int] | None:
    """Return the first and the last byte of a range; nothing if it is nonsense, to be ignored.

    Raises:
        ProblemError: There is no such byte.
    """
    if first and last and int(last) < int(first):
        return None
    begin = int(first) if first else max(0, size - int(last))
    end = min(int(last), size - 1) if first and last else size - 1
    if begin >= size:
        raise ProblemError(
            "range_not_satisfiable",
            f"the file has {size} bytes",
            headers={"Content-Range": f"bytes */{size}"},
        )
    return begin, end


def _pieces(path: Path, first: int, last: int) -> Iterator[bytes]:
    remaining = last - first + 1
    with path.open("rb") as file:
        file.seek(first)
        while remaining > 0 and (piece := file.read(min(CHUNK, remaining))):
            remaining -= len(piece)
            yield piece
