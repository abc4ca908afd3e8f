"""What tenants uploaded: each content is stored once, and each tenant sees only its own uploads."""

import re
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from sqlalchemy import Connection, String, cast, delete, func, insert, select, update

from worker.jobs.database import Database
from worker.jobs.errors import StorageFullError
from worker.jobs.files import half_file, make_folder, publish, settle, sweep_halves
from worker.jobs.schema import assets, work

SHA256: Final = re.compile(r"\b[0-9a-f]{64}\b")


@dataclass(frozen=True, slots=True)
class Asset:
    """An upload; `facts` is what measuring it found, `created` seconds since 1970."""

    sha256: str
    facts: dict[str, Any]
    bytes: int
    created: float


class Assets:
    """The uploads of all tenants, in `folder/<first two digits>/<sha256>`."""

    def __init__(self, folder: Path, database: Database, bytes_limit: int = 20 << 30) -> None:
        self._folder = make_folder(folder)
        self._database = database
        self._bytes_limit = bytes_limit

    @property
    def folder(self) -> Path:
        """Where executors find them."""
        return self._folder

    @property
    def bytes(self) -> int:
        """What all uploads take together."""
        with self._database.reading() as connection:
            return _bytes(connection)

    def sweep(self) -> int:
        """Remove half uploads, and files that no tenant has any more or that have lost their end.

        Returns:
            How many uploads are missing now; their tenants have them no more.
        """
        sweep_halves(self._folder)
        lengths = {path.name: path.stat().st_size for path in self._folder.glob("??/*")}
        with self._database.reading() as connection:
            rows = connection.execute(select(assets.c.sha256, assets.c.bytes).distinct()).all()
        lost = [row.sha256 for row in rows if lengths.get(row.sha256) != row.bytes]
        for sha256 in lost:
            with self._database.writing() as connection:
                connection.execute(delete(assets).where(assets.c.sha256 == sha256))
            self._path(sha256).unlink(missing_ok=True)
        self.drop_unwanted(lengths)
        return len(lost)

    def new_upload(self) -> Path:
        """A path to write an upload to; swept if it is never put, and the caller's to remove."""
        return half_file(self._folder)

    def put(self, tenant: str, upload: Path, sha256: str, facts: dict[str, Any]) -> Asset:
        """Take a file over, whose sha256 the caller has computed, as an asset of the tenant.

        Returns:
            The asset; with its earlier facts, where the tenant had it already.

        Raises:
            StorageFullError: the disk is full, or the uploads together would be too long; the
                tenant does not have the asset.
        """
        settle(upload)
        asset = Asset(sha256, facts, upload.stat().st_size, time.time())
        path = self._path(sha256)
        with self._database.writing() as connection:
            owned = self._owned(connection, tenant, sha256)
            if path.is_file():
                upload.unlink()
            else:
                if _bytes(connection) + asset.bytes > self._bytes_limit:
                    raise StorageFullError(f"all uploads may take {self._bytes_limit} bytes")
                make_folder(path.parent)
                publish(upload, path)
            if owned is not None:
                return owned
            connection.execute(
                insert(assets).values(
                    tenant=tenant,
                    sha256=sha256,
                    facts=facts,
                    bytes=asset.bytes,
                    created=asset.created,
                )
            )
        return asset

    def tell(self, tenant: str, sha256: str, facts: dict[str, Any]) -> None:
        """Replace what is known of an asset of the tenant."""
        is_this = (assets.c.tenant == tenant, assets.c.sha256 == sha256)
        with self._database.writing() as connection:
            connection.execute(update(assets).where(*is_this).values(facts=facts))

    def get(self, tenant: str, sha256: str) -> Asset | None:
        """One asset of the tenant."""
        with self._database.reading() as connection:
            asset = self._owned(connection, tenant, sha256)
        return asset if asset is not None and self._path(sha256).is_file() else None

    def path(self, tenant: str, sha256: str) -> Path | None:
        """The file of one asset of the tenant."""
        return None if self.get(tenant, sha256) is None else self._path(sha256)

    def delete(self, tenant: str, sha256: str) -> bool:
        """Take an asset from the tenant; False if it was not there."""
        is_this = (assets.c.tenant == tenant, assets.c.sha256 == sha256)
        with self._database.writing() as connection:
            deleted = connection.execute(delete(assets).where(*is_this)).rowcount
        self.drop_unwanted([sha256])
        return deleted == 1

    def drop_unwanted(self, candidates: Iterable[str]) -> None:
        """Remove those files that no tenant has and no work under way may read."""
        for sha256 in candidates:
            path = self._path(sha256)
            with self._database.reading() as connection:
                seems_wanted = not path.is_file() or _is_wanted(connection, sha256)
            if not seems_wanted:
                with self._database.writing() as connection:  # nobody can put it meanwhile
                    if not _is_wanted(connection, sha256):
                        path.unlink(missing_ok=True)

    def _path(self, sha256: str) -> Path:
        return self._folder / sha256[:2] / sha256

    def _owned(self, connection: Connection, tenant: str, sha256: str) -> Asset | None:
        query = select(assets).where(assets.c.tenant == tenant, assets.c.sha256 == sha256)
        row = connection.execute(query).first()
        return None if row is None else Asset(row.sha256, row.facts, row.bytes, row.created)


def mentioned_in(body: dict[str, Any]) -> set[str]:
    """Everything in a request that may name an asset."""
    return set(SHA256.findall(str(body)))


def _bytes(connection: Connection) -> int:
    files = select(assets.c.sha256, assets.c.bytes).distinct().subquery()
    return int(connection.execute(select(func.sum(files.c.bytes))).scalar() or 0)


def _is_wanted(connection: Connection, sha256: str) -> bool:
    owner = select(assets.c.tenant).where(assets.c.sha256 == sha256)
    reader = select(work.c.id).where(
        work.c.state.in_(("queued", "running")), cast(work.c.body, String).contains(sha256)
    )
    return any(connection.execute(query.limit(1)).first() is not None for query in (owner, reader))
