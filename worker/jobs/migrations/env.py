"""Run by Alembic: the migrations use the connection that `upgrade` opened."""

from alembic import context

from worker.jobs.schema import metadata

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=metadata,
    render_as_batch=True,
)
with context.begin_transaction():
    context.run_migrations()
