"""The history of the tables, one module of `versions` for every change.

A change to `worker.jobs.schema` comes with a new module there, numbered after the last one and
naming it as its `down_revision`; a test compares the outcome of all of them with the schema.
"""

from importlib.resources import as_file, files

from alembic import command
from alembic.config import Config
from alembic.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection

from worker.jobs.database import Database
from worker.jobs.errors import RecordsError


def upgrade(database: Database) -> None:
    """Bring the tables to the newest revision, all or nothing.

    Raises:
        RecordsError: they have a revision that only a newer version knows.
    """
    with as_file(files(__name__)) as folder, database.writing() as connection:
        config = Config()
        config.set_main_option("script_location", str(folder).replace("%", "%%"))
        config.attributes["connection"] = connection
        _require_known(connection, ScriptDirectory.from_config(config))
        command.upgrade(config, "head")


def _require_known(connection: Connection, scripts: ScriptDirectory) -> None:
    found = MigrationContext.configure(connection).get_current_revision()
    known = [script.revision for script in scripts.walk_revisions()]
    if found is not None and found not in known:
        raise RecordsError(
            f"the data folder was used by a newer version: its tables have revision {found}, and "
            f"this version knows {known[0]} at most; use that version, or another data folder"
        )
