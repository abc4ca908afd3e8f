"""The files that finished work leaves behind, one for each."""

from pathlib import Path

from worker.jobs.files import make_folder, publish, settle, sweep_halves


class Results:
    """A folder of result files, named by the id of the work."""

    def __init__(self, folder: Path) -> None:
        self._folder = make_folder(folder)

    def sweep(self) -> None:
        """Remove what was being written when the service ended."""
        sweep_halves(self._folder)

    def half(self, work_id: str, attempt: int) -> Path:
        """Where one attempt at the work writes."""
        return self._folder / f"{work_id}.{attempt}.part"

    def settle(self, half: Path) -> None:
        """Bring a written file to the disk.

        Raises:
            StorageFullError: it did not fit.
        """
        settle(half)

    def publish(self, half: Path, work_id: str) -> None:
        """Make a settled file the result of the work."""
        publish(half, self._folder / work_id)

    def find(self, work_id: str) -> Path | None:
        """The result of the work; None when there is none, or none any more."""
        path = self._folder / work_id
        return path if path.is_file() else None

    def remove(self, work_id: str) -> None:
        """Remove a result that could not be recorded."""
        (self._folder / work_id).unlink(missing_ok=True)
