"""The log as JSON, one object on each line, whatever a message holds.

JSON escapes line ends and control characters, and everything beyond ASCII, so nobody who chooses
a text that gets logged can forge a line or move a terminal's cursor.
"""

import json
import logging
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, Final

LONGEST: Final = 16384

_about: ContextVar[dict[str, Any]] = ContextVar("about", default={})  # noqa: B039 - never changed


@contextmanager
def telling(**fields: Any) -> Iterator[None]:
    """Add fields to every line that is logged within, in this thread or task."""
    token = _about.set({**_about.get(), **fields})
    try:
        yield
    finally:
        _about.reset(token)


class JsonLines(logging.Formatter):
    """Formats a record as one line of JSON; `extra={"fields": {...}}` adds to it."""

    def format(self, record: logging.LogRecord) -> str:
        """Return the line."""
        line: dict[str, Any] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage()[:LONGEST],
            **_about.get(),
            **getattr(record, "fields", {}),
        }
        if record.exc_info and record.exc_info[1] is not None:
            line["exception"] = "".join(traceback.format_exception(record.exc_info[1]))[-LONGEST:]
        return json.dumps(line, default=str)


def install(level: str) -> None:
    """Have everything that is logged in this process go to stderr as JSON."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonLines())
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
