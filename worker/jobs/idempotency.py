"""Keys that make a request harmless which is sent twice: the second answer is that of the first.

A key is looked up and kept in the transaction that records what it stands for, so that of two
callers who send it at once one makes the job and the other finds it.
"""

import time
from dataclasses import dataclass
from typing import Final

from sqlalchemy import ColumnElement, Connection, and_, delete, insert, or_, select

from worker.jobs.database import Database
from worker.jobs.errors import KeyReusedError
from worker.jobs.schema import idempotency_keys

LIFETIME_SECONDS: Final = 24 * 3600.0


@dataclass(frozen=True, slots=True)
class Key:
    """What a caller calls a request; `fingerprint` names the body, and `route` where it went."""

    route: str
    key: str
    fingerprint: str


def answered(connection: Connection, tenant: str, key: Key) -> str | None:
    """The id of what the request made when it was first sent; None if this is the first time.

    Raises:
        KeyReusedError: it came with another body then.
    """
    row = connection.execute(
        select(idempotency_keys.c.fingerprint, idempotency_keys.c.answer).where(
            _is_this(tenant, key), idempotency_keys.c.created > time.time() - LIFETIME_SECONDS
        )
    ).first()
    if row is None:
        return None
    if row.fingerprint != key.fingerprint:
        raise KeyReusedError("the key came with another body before")
    return str(row.answer)


def remember(connection: Connection, tenant: str, key: Key, answer: str) -> None:
    """Keep a key for a day, in the place of an older one, and forget what is older than that."""
    now = time.time()
    is_old = idempotency_keys.c.created <= now - LIFETIME_SECONDS
    connection.execute(delete(idempotency_keys).where(or_(is_old, _is_this(tenant, key))))
    connection.execute(
        insert(idempotency_keys).values(
            tenant=tenant,
            route=key.route,
            key=key.key,
            fingerprint=key.fingerprint,
            answer=answer,
            created=now,
        )
    )


def sweep(database: Database) -> None:
    """Forget the keys that are older than a day."""
    with database.writing() as connection:
        connection.execute(
            delete(idempotency_keys).where(
                idempotency_keys.c.created <= time.time() - LIFETIME_SECONDS
            )
        )


def _is_this(tenant: str, key: Key) -> ColumnElement[bool]:
    return and_(
        idempotency_keys.c.tenant == tenant,
        idempotency_keys.c.route == key.route,
        idempotency_keys.c.key == key.key,
    )
