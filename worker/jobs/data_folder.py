"""Everything that outlives the process: records, results, uploads, and the caches of children."""

import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import IO

from worker.jobs import idempotency
from worker.jobs.assets import Assets
from worker.jobs.database import Database
from worker.jobs.files import keep_only, lock_folder, make_folder
from worker.jobs.housekeeping import Housekeeping
from worker.jobs.meters import Meters
from worker.jobs.migrations import upgrade
from worker.jobs.results import Limits, Results
from worker.jobs.status import StoreStatus


class DataFolder:
    """The data of one engine, and of no other at the same time.

    Args:
        path: created if missing.
        keep: how many results are kept, and for how long.
        assets_bytes_limit: what all uploads may take together.
        meters: hear what was evicted.
    """

    def __init__(
        self, path: Path, *, keep: Limits | None, assets_bytes_limit: int, meters: Meters
    ) -> None:
        self.path = make_folder(path.resolve())
        self.database = Database(self.path / "jobs.sqlite")
        self.results = Results(self.path / "results", keep)
        self.assets = Assets(self.path / "assets", self.database, assets_bytes_limit)
        self._housekeeping = Housekeeping(self.database, self.results, self.assets, meters)
        self._lock: IO[bytes] | None = None

    def take(self, environment: Mapping[str, str]) -> None:
        """Make the folder this process's own, and bring it in step with this version and itself.

        Args:
            environment: that of the children, which says where their caches are.

        Raises:
            DataFolderInUseError: another engine has it.
            RecordsError: its records are damaged, or of a newer version.
            StorageFullError: the disk is full.
        """
        self._lock = lock_folder(self.path)
        try:
            self.database.check()
            upgrade(self.database)
            idempotency.sweep(self.database)
            self._housekeeping.check()
            keep_only(Path(environment["NUMBA_CACHE_DIR"]))
            make_folder(Path(environment["MESA_SHADER_CACHE_DIR"]))
        except BaseException:
            self.let_go()
            raise
        self._housekeeping.start()

    def let_go(self) -> None:
        """Leave the folder to others."""
        self._housekeeping.stop()
        self.database.close()
        if self._lock is not None:
            self._lock.close()

    def status(self) -> StoreStatus:
        """What is in it, and how much more could be."""
        return StoreStatus(
            result_bytes=self.results.bytes,
            results=self.results.count,
            asset_bytes=self.assets.bytes,
            free_bytes=shutil.disk_usage(self.path).free,
        )
