"""Reads request bodies of any length without holding more than is allowed."""

from collections.abc import AsyncIterator

from starlette.requests import Request

from service.problems import ProblemError


async def chunks(request: Request, limit: int) -> AsyncIterator[bytes]:
    """Yield the body piece by piece, announced in advance or not.

    Raises:
        ProblemError: It is longer than the limit.
    """
    announced = request.headers.get("content-length", "")
    if announced.isdecimal() and int(announced[:20]) > limit:
        raise _too_large(limit)
    length = 0
    async for chunk in request.stream():
        length += len(chunk)
        if length > limit:
            raise _too_large(limit)
        yield chunk


def _too_large(limit: int) -> ProblemError:
    return ProblemError("body_too_large", f"at most {limit} bytes are taken here")
