"""What the job engine refuses, and why.

JobsError
├── QueueFullError        too much is waiting; carries the seconds after which to try again
│   └── TenantFullError   too much of this tenant is
├── DrainingError         the engine is stopping and takes nothing new
├── StorageFullError      the disk that holds the data folder is full
├── KeyReusedError        an idempotency key came with another body before
├── DataFolderInUseError  another service owns the data folder
├── RecordsError          the records cannot be read: damaged, or of a newer version
├── RecordsBusyError      another program holds the records' lock, a backup say
├── SlotError             a child could not be started or warmed
└── MeasuringError        an upload cannot be used; carries the failure as data
"""

from worker.errors import Failure


def failure(code: str, message: str) -> Failure:
    """A failure that no part of the request is to blame for."""
    return {"code": code, "message": message, "pointer": None}


class JobsError(Exception):
    """Anything the job engine refuses."""


class QueueFullError(JobsError):
    """The queue holds as much as it may."""

    def __init__(self, waiting: int, retry_after_seconds: int) -> None:
        super().__init__(f"{waiting} jobs are waiting already")
        self.retry_after_seconds = retry_after_seconds


class TenantFullError(QueueFullError):
    """One tenant has as much waiting as it may."""


class DrainingError(JobsError):
    """The engine is stopping."""


class StorageFullError(JobsError):
    """There is no room left for records or files."""


class KeyReusedError(JobsError):
    """An idempotency key stands for another request already."""


class DataFolderInUseError(JobsError):
    """One service per data folder; another one holds its lock."""


class RecordsError(JobsError):
    """The records were damaged, or written by a newer version."""


class RecordsBusyError(JobsError):
    """Somebody else writes to the records, and does not stop."""


class SlotError(JobsError):
    """A child could not be started, or its executor could not be warmed."""


class MeasuringError(JobsError):
    """An upload could not be measured; `failure` says why."""

    def __init__(self, failure: Failure) -> None:
        super().__init__(failure["message"])
        self.failure = failure
