"""Batches of jobs, keys that make a repeated request harmless, and the estimate behind an ETA."""

import sqlalchemy as sa
from alembic import op

revision = "r0002"
down_revision = "0001"


def upgrade() -> None:
    """Add columns to work, and the new tables."""
    op.add_column("work", sa.Column("estimate_seconds", sa.Float))
    op.add_column(
        "work", sa.Column("in_batch", sa.Boolean, nullable=False, server_default=sa.false())
    )
    op.create_table(
        "batches",
        sa.Column("sequence", sa.Integer, primary_key=True),
        sa.Column("id", sa.String(32), nullable=False),
        sa.Column("tenant", sa.String(64), nullable=False),
        sa.Column("size", sa.Integer, nullable=False),
        sa.Column("created", sa.Float, nullable=False),
    )
    op.create_index("batches_by_id", "batches", ["id"], unique=True)
    op.create_index("batches_of_tenant", "batches", ["tenant", "sequence"])
    op.create_table(
        "batch_items",
        sa.Column("batch_id", sa.String(32), sa.ForeignKey("batches.id"), primary_key=True),
        sa.Column("place", sa.Integer, primary_key=True),
        sa.Column("job_id", sa.String(32), sa.ForeignKey("jobs.id"), nullable=False),
        sa.Column("values", sa.JSON),
    )
    op.create_index("batch_items_by_job", "batch_items", ["job_id"], unique=True)
    op.create_table(
        "idempotency_keys",
        sa.Column("tenant", sa.String(64), primary_key=True),
        sa.Column("route", sa.String(64), primary_key=True),
        sa.Column("key", sa.String(255), primary_key=True),
        sa.Column("fingerprint", sa.String(64), nullable=False),
        sa.Column("answer", sa.String(32), nullable=False),
        sa.Column("created", sa.Float, nullable=False),
    )
    op.create_index("idempotency_keys_by_age", "idempotency_keys", ["created"])
