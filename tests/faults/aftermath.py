"""What a service that was harmed left in its data folder and in the process table."""

import hashlib
import json
import sqlite3
import time
from pathlib import Path

from tests.faults.service import FaultyService


def left_behind(service: FaultyService) -> list[str]:
    """Stop a service and return everything that is wrong with what is left of it."""
    service.stop()
    time.sleep(0.2)
    complaints = []
    if orphans := service.processes():
        complaints.append(f"{len(orphans)} orphans")
    if "Traceback" in (log := service.log()):
        complaints += _unforeseen(log)
    records = sqlite3.connect(service.data / "jobs.sqlite")
    if (found := records.execute("PRAGMA integrity_check").fetchone()[0]) != "ok":
        complaints.append(f"the records are damaged: {found}")
    made = records.execute(
        "SELECT id, digest, facts FROM work WHERE state = 'succeeded' AND evicted IS NULL"
    ).fetchall()
    unfinished = records.execute(
        "SELECT count(*) FROM work WHERE state IN ('queued', 'running')"
    ).fetchone()[0]
    records.close()
    if unfinished:
        complaints.append(f"{unfinished} never finished")
    if duplicates := len(made) - len({digest for _, digest, _ in made}):
        complaints.append(f"{duplicates} duplicates")
    if halves := len(list(service.data.glob("**/*.part"))):
        complaints.append(f"{halves} halves")
    folder = service.data / "results"
    wrong = sum(not _is_whole(folder / name, json.loads(facts)) for name, _, facts in made)
    if wrong:
        complaints.append(f"{wrong} results that are not what their records say")
    if extra := {path.name for path in folder.iterdir()} - {name for name, _, _ in made}:
        complaints.append(f"{len(extra)} results without a record")
    return complaints


def _is_whole(path: Path, facts: dict[str, str]) -> bool:
    return path.is_file() and (hashlib.sha256(path.read_bytes()).hexdigest() == facts["sha256"])


def _unforeseen(log: str) -> list[str]:
    """The errors in a log that are not those of a full disk, a held lock or a lost worker."""
    lines = [json.loads(line) for line in log.splitlines() if line.startswith('{"time"')]
    foreseen = ("StorageFullError", "RecordsBusyError", "SlotError")
    return [
        f"logged: {line['message']}: {line['exception'].splitlines()[-1]}"
        for line in lines
        if "exception" in line and not any(name in line["exception"] for name in foreseen)
    ]
