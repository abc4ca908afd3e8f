"""Tenants take turns, and evicted results are known as such."""

import sqlalchemy as sa
from alembic import op

revision = "r0003"
down_revision = "r0002"


def upgrade() -> None:
    """Add what fair turns and eviction look up."""
    op.add_column("work", sa.Column("evicted", sa.Float))
    op.drop_index("work_in_line", "work")
    op.create_index("work_in_turn", "work", ["state", "priority", "tenant", "sequence"])
