"""The history of the tables, one module of `versions` for every change.

A change to `worker.jobs.schema` comes with a new module there, numbered after the last one and
naming it as its `down_revision`; a test compares the outcome of all of them with the schema.
"""

from importlib.resources import as_file, files

from alembic import command
from alembic.config import Config

from worker.jobs.database import Database


def upgrade(database: Database) -> None:
    """Bring the tables to the newest revision, all or nothing."""
    with as_file(files(__name__)) as folder, database.writing() as connection:
        config = Config()
        config.set_main_option("script_location", str(folder).replace("%", "%%"))
        config.attributes["connection"] = connection
        command.upgrade(config, "head")
