"""The Idempotency-Key of a request: what makes it harmless to send it twice."""

import hashlib
from typing import Annotated, Final

from fastapi import Header

from api_schemas.base import Schema
from worker.jobs.idempotency import Key

PATTERN: Final = "^[!-~]{1,255}$"

IdempotencyKey = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        pattern=PATTERN,
        description="A name of the caller's choice for this request, kept for 24 hours: sent again "
        "with the same body, it answers what was made the first time.",
    ),
]


def key_of(route: str, name: str | None, body: Schema) -> Key | None:
    """Return the key of a request, if it has one.

    The body counts as it was meant: the order of its keys and the way numbers are written do not.
    """
    if name is None:
        return None
    meant = body.model_dump_json(exclude_unset=True)
    return Key(route, name, hashlib.sha256(meant.encode()).hexdigest())
