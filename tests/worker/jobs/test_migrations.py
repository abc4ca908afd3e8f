import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from sqlalchemy import inspect, text

from worker.jobs import migrations
from worker.jobs.database import Database
from worker.jobs.errors import RecordsError
from worker.jobs.migrations import upgrade
from worker.jobs.schema import metadata


def test_the_migrations_build_the_schema(database):
    with database.reading() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, metadata) == []


def test_upgrading_again_keeps_everything(database):
    row = "'a', '{}', 'x', 1, 0.0"
    with database.writing() as connection:
        connection.execute(
            text(f"INSERT INTO assets (tenant, facts, sha256, bytes, created) VALUES ({row})")
        )
    upgrade(database)
    with database.reading() as connection:
        assert connection.execute(text("SELECT count(*) FROM assets")).scalar() == 1


def test_a_migration_that_fails_leaves_nothing_behind(tmp_path, monkeypatch):
    def fail(config, revision):
        connection = config.attributes["connection"]
        connection.execute(text("CREATE TABLE half (n INTEGER)"))
        raise RuntimeError("no")

    database = Database(tmp_path / "jobs.sqlite")
    monkeypatch.setattr(migrations.command, "upgrade", fail)
    with pytest.raises(RuntimeError):
        upgrade(database)
    with database.reading() as connection:
        assert inspect(connection).get_table_names() == []
    database.close()


def test_tables_of_a_newer_version_are_told_and_left_alone(database):
    with database.writing() as connection:
        connection.execute(text("UPDATE alembic_version SET version_num = 'r0999'"))
    with pytest.raises(RecordsError, match=r"newer version.*r0999"):
        upgrade(database)
    with database.reading() as connection:
        found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
    assert found == "r0999"
