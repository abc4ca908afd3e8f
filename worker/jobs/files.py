"""Files that are either whole and durable, or not there at all."""

import fcntl
import os
import shutil
import uuid
from pathlib import Path
from typing import IO, Final

from worker.jobs.child import FULL_DISK
from worker.jobs.errors import DataFolderInUseError, StorageFullError

HALF: Final = ".part"


def make_folder(path: Path) -> Path:
    """Create a folder that its owner alone may enter; an existing one is left as it is."""
    path.mkdir(mode=0o700, parents=True, exist_ok=True)
    return path


def half_file(folder: Path) -> Path:
    """A name for a file in the making: on the same disk, and swept if it is never finished."""
    return folder / f"{uuid.uuid4().hex}{HALF}"


def settle(path: Path) -> None:
    """Have the contents of a file, or the names in a folder, reach the disk.

    Raises:
        StorageFullError: they did not fit.
    """
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno in FULL_DISK:
            raise StorageFullError("the disk is full") from error
        raise
    finally:
        os.close(descriptor)


def publish(half: Path, whole: Path) -> None:
    """Give a settled file its name, in one step that survives a power cut."""
    half.replace(whole)
    settle(whole.parent)


def sweep_halves(folder: Path) -> None:
    """Remove what was in the making when the service ended."""
    for half in folder.glob(f"*{HALF}"):
        half.unlink(missing_ok=True)


def keep_only(folder: Path) -> None:
    """Create a folder and remove its outdated siblings: those of the same name up to the dash."""
    for other in folder.parent.glob(f"{folder.name.partition('-')[0]}-*"):
        if other != folder:
            shutil.rmtree(other, ignore_errors=True)
    make_folder(folder)


def lock_folder(data: Path) -> IO[bytes]:
    """Make the data folder this process's own until the answer is closed.

    Raises:
        DataFolderInUseError: another engine has it.
    """
    lock = (data / "lock").open("ab")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        lock.close()
        raise DataFolderInUseError(f"another service uses {data}") from error
    return lock
