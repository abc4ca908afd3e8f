"""The tables. The migrations build them; a test holds the two together.

A job is one caller's request; the work behind it is shared by all jobs of one tenant and digest, so
that nobody's cancellation takes away what somebody else waits for.
"""

from sqlalchemy import (
    JSON,
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    false,
    text,
)

metadata = MetaData()

work = Table(
    "work",
    metadata,
    Column("sequence", Integer, primary_key=True),  # first come, first served
    Column("id", String(32), nullable=False),
    Column("tenant", String(64), nullable=False),
    Column("digest", String(64), nullable=False),
    Column("kind", String(32), nullable=False),
    Column("body", JSON, nullable=False),
    Column("priority", Integer, nullable=False),  # that of its most urgent job: 0 goes first
    Column("time_limit_seconds", Float, nullable=False),
    Column("state", String(16), nullable=False),
    Column("attempt", Integer, nullable=False),  # counts claims; a result of another one is refused
    Column("crashes", Integer, nullable=False),
    Column("progress", Float, nullable=False),
    Column("stage", String(64)),
    Column("facts", JSON(none_as_null=True)),
    Column("failure", JSON(none_as_null=True)),
    Column("fingerprint", String(128)),
    Column("created", Float, nullable=False),
    Column("started", Float),
    Column("finished", Float),
    Column("evicted", Float),  # when its result was removed, or found missing
    Column("estimate_seconds", Float),  # what the cost model expected, on one core
    Column("in_batch", Boolean, nullable=False, server_default=false()),
    Index("work_by_id", "id", unique=True),
    Index("work_in_turn", "state", "priority", "tenant", "sequence"),
    Index("work_by_digest", "tenant", "digest"),
    Index(
        "work_in_single_flight",
        "tenant",
        "digest",
        unique=True,
        sqlite_where=text("state IN ('queued', 'running')"),
        postgresql_where=text("state IN ('queued', 'running')"),
    ),
)

jobs = Table(
    "jobs",
    metadata,
    Column("sequence", Integer, primary_key=True),
    Column("id", String(32), nullable=False),
    Column("tenant", String(64), nullable=False),
    Column("work_id", String(32), ForeignKey("work.id"), nullable=False),
    Column("priority", Integer, nullable=False),
    Column("created", Float, nullable=False),
    Column("cancelled", Float),
    Index("jobs_by_id", "id", unique=True),
    Index("jobs_of_tenant", "tenant", "sequence"),
    Index("jobs_of_work", "work_id"),
)

assets = Table(
    "assets",
    metadata,
    Column("tenant", String(64), primary_key=True),
    Column("sha256", String(64), primary_key=True),
    Column("facts", JSON, nullable=False),
    Column("bytes", Integer, nullable=False),
    Column("created", Float, nullable=False),
    Index("assets_by_sha256", "sha256"),
)

batches = Table(
    "batches",
    metadata,
    Column("sequence", Integer, primary_key=True),
    Column("id", String(32), nullable=False),
    Column("tenant", String(64), nullable=False),
    Column("size", Integer, nullable=False),
    Column("created", Float, nullable=False),
    Index("batches_by_id", "id", unique=True),
    Index("batches_of_tenant", "tenant", "sequence"),
)

batch_items = Table(
    "batch_items",
    metadata,
    Column("batch_id", String(32), ForeignKey("batches.id"), primary_key=True),
    Column("place", Integer, primary_key=True),  # from 0, in the order of the request
    Column("job_id", String(32), ForeignKey("jobs.id"), nullable=False),
    Column("values", JSON(none_as_null=True)),  # of a sweep, by pointer
    Index("batch_items_by_job", "job_id", unique=True),
)

idempotency_keys = Table(
    "idempotency_keys",
    metadata,
    Column("tenant", String(64), primary_key=True),
    Column("route", String(64), primary_key=True),
    Column("key", String(255), primary_key=True),
    Column("fingerprint", String(64), nullable=False),  # of the body it came with
    Column("answer", String(32), nullable=False),  # the id of the job or batch that was made
    Column("created", Float, nullable=False),
    Index("idempotency_keys_by_age", "created"),
)
