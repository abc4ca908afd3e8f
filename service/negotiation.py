"""What a caller wants to get back, and whether it wants to wait: Accept and Prefer."""

import re
from dataclasses import dataclass
from typing import Final

from starlette.requests import Request

from api_schemas.output import MEDIA_TYPES, Format
from service.problems import ProblemError

JSON: Final = "application/json"
LONGEST_WAIT_SECONDS: Final = 60
WEIGHT: Final = re.compile(r"q=(0(?:\.\d{0,3})?|1(?:\.0{0,3})?)")
WAIT: Final = re.compile(r"wait=\"?(\d{1,9})\"?")


@dataclass(frozen=True, slots=True)
class Wish:
    """What to answer a request for a picture with.

    `wait_seconds` is how long to wait for the job; `picture` whether to answer with the file itself
    when it is there in time, and with the job otherwise; `applied` which preference was heeded.
    """

    file_format: Format
    picture: bool
    wait_seconds: int
    applied: str | None


def wish(request: Request, asked: Format | None, default_wait_seconds: int) -> Wish:
    """Settle format, kind of answer and patience; `asked` is the format in the body.

    Raises:
        ProblemError: Nothing that can be made is acceptable.
    """
    accept = request.headers.get("accept")
    weights = {name: quality(accept, media_type) for name, media_type in MEDIA_TYPES.items()}
    formats = [asked] if asked else list(MEDIA_TYPES)
    best = max(formats, key=lambda name: weights[name])
    json_weight = quality(accept, JSON)
    if not weights[best] and not json_weight:
        made = ", ".join([*(MEDIA_TYPES[name] for name in formats), JSON])
        raise ProblemError("not_acceptable", f"this can be answered with {made}")
    picture = weights[best] > json_weight
    seconds, applied = patience(request, default_wait_seconds if picture else 0)
    return Wish(best, picture, seconds, applied)


def patience(request: Request, default_seconds: int) -> tuple[int, str | None]:
    """Return how long to wait, and the preference that says so (RFC 7240); nonsense is ignored."""
    for preference in ",".join(request.headers.getlist("prefer")).split(","):
        name = preference.strip().lower()
        if found := WAIT.fullmatch(name):
            seconds = min(int(found[1]), LONGEST_WAIT_SECONDS)
            return seconds, f"wait={seconds}"
        if name == "respond-async":
            return 0, name
    return default_seconds, None


def require_accepted(request: Request, media_type: str) -> None:
    """Refuse callers that do not take the one media type there is.

    Raises:
        ProblemError: They do not.
    """
    if not quality(request.headers.get("accept"), media_type):
        raise ProblemError("not_acceptable", f"this can be answered with {media_type}")


def quality(accept: str | None, media_type: str) -> float:
    """Return the weight of a media type by the most exact range that covers it (RFC 9110)."""
    if accept is None or not accept.strip():
        return 1.0
    family = media_type.partition("/")[0]
    best = (-1, 0.0)
    for entry in accept.split(","):
        name, *parameters = (part.strip().lower() for part in entry.split(";"))
        if name in (media_type, f"{family}/*", "*/*"):
            exactness = 2 if name == media_type else int(name != "*/*")
            weight = 1.0
            for parameter in parameters:
                if found := WEIGHT.fullmatch(parameter.replace(" ", "")):
                    weight = float(found[1])
            best = max(best, (exactness, weight))
    return best[1]
