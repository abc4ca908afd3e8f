"""What an operator may set, from environment variables that begin with TEXLOOM_."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

MEBIBYTE = 1 << 20
GIBIBYTE = 1 << 30


class Settings(BaseSettings):
    """The defaults suit one person on one machine; each says why it is what it is."""

    model_config = SettingsConfigDict(env_prefix="TEXLOOM_", frozen=True, extra="ignore")

    host: str = Field(
        default="127.0.0.1",
        description="Address to listen on. This machine only, since there are no keys yet.",
    )
    port: Annotated[int, Field(ge=0, le=65535)] = Field(
        default=8000, description="Port to listen on; 0 takes a free one. What people expect."
    )
    data: Path = Field(
        default=Path("data"),
        description="Folder of records, uploads, results and caches. Beside where one started it, "
        "so that it is found again.",
    )
    gl: Literal["osmesa", "egl"] = Field(
        default="osmesa",
        description="OpenGL platform of the workers. OSMesa needs no display and no device.",
    )
    native_cpu: bool = Field(
        default=False,
        description="Compile for this very processor. Off: the same bytes on every machine.",
    )
    slots: Annotated[int, Field(ge=1, le=64)] = Field(
        default=2,
        description="Jobs done at a time. Two, so that a long job does not stop a short one.",
    )
    queue_limit: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        default=256,
        description="Jobs that may wait before more are refused with 429. A few minutes of work: "
        "an honest refusal is better than a wait without end.",
    )
    tenant_queue_limit: Annotated[int, Field(ge=0, le=1_000_000)] = Field(
        default=256,
        description="Of these, jobs of one tenant. As many, since until there are keys there is "
        "but one.",
    )
    recycle_after_jobs: Annotated[int, Field(ge=1)] = Field(
        default=1000,
        description="Jobs after which a worker is replaced by a fresh one, which warms up beside "
        "it. What native libraries may leak stays small.",
    )
    time_limit_seconds: Annotated[float, Field(gt=0, le=86400)] = Field(
        default=600.0,
        description="After which a running job is killed. Ten times what the cost limit lets in, "
        "so that only what is stuck meets it.",
    )
    cost_limit_seconds: Annotated[float, Field(gt=0)] = Field(
        default=60.0,
        description="Estimated time on one core beyond which a request is refused. A minute is "
        "what somebody waits for a picture.",
    )
    cost_limit_bytes: Annotated[float, Field(gt=0)] = Field(
        default=2.0 * GIBIBYTE,
        description="Estimated memory beyond which a request is refused. Two slots of it fit a "
        "laptop.",
    )
    memory_limit_bytes: Annotated[int, Field(ge=128 * MEBIBYTE)] = Field(
        default=4 * GIBIBYTE,
        description="Memory at which a worker is killed. Twice the cost limit: estimates are "
        "rough.",
    )
    body_limit_bytes: Annotated[int, Field(ge=1024)] = Field(
        default=4 * MEBIBYTE,
        description="Longest JSON body. Room for 1024 nodes with matrices and surfaces of their "
        "own.",
    )
    upload_limit_bytes: Annotated[int, Field(ge=1024)] = Field(
        default=256 * MEBIBYTE,
        description="Longest upload. An 8192 x 4096 half float panorama, uncompressed.",
    )
    result_limit_bytes: Annotated[int, Field(ge=0)] = Field(
        default=10 * GIBIBYTE,
        description="What finished files may take together; the least recently used are removed "
        "first. Thousands of large pictures.",
    )
    result_days: Annotated[float, Field(gt=0)] = Field(
        default=30.0,
        description="Days after which an unused finished file is removed. It can be made again.",
    )
    disk_reserve_bytes: Annotated[int, Field(ge=0)] = Field(
        default=512 * MEBIBYTE,
        description="Room on the disk below which finished files are removed. For records, "
        "uploads, and others on the machine.",
    )
    asset_limit_bytes: Annotated[int, Field(ge=0)] = Field(
        default=20 * GIBIBYTE,
        description="What uploads may take together before more are refused with 507. They are "
        "never removed but by DELETE, since nobody else could bring them back.",
    )
    measure_limit_seconds: Annotated[float, Field(gt=0)] = Field(
        default=60.0,
        description="Time to look into an upload. Several times what the largest model takes.",
    )
    wait_seconds: Annotated[int, Field(ge=0, le=60)] = Field(
        default=30,
        description="How long a request for a picture waits for it, unless it prefers otherwise. "
        "Below the patience of most proxies.",
    )
    patience_seconds: Annotated[float, Field(gt=0)] = Field(
        default=30.0,
        description="How long a request may take to arrive; every KiB of a body adds a second. "
        "Half-sent requests would keep their connections for ever.",
    )
    drain_seconds: Annotated[float, Field(ge=0)] = Field(
        default=20.0,
        description="How long running jobs may go on after SIGTERM before they are put back into "
        "the queue. Below the 30 s after which service managers kill.",
    )
    cors_origins: Annotated[tuple[str, ...], NoDecode] = Field(
        default=(),
        description="Web origins whose pages may use the service, separated by commas. None, since "
        "a page anywhere could otherwise make this machine work.",
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        default="info", description="How much is told on stderr. Requests and what went wrong."
    )

    @field_validator("cors_origins", mode="before")
    @classmethod
    def _split(cls, value: object) -> object:
        if isinstance(value, str):
            return tuple(part.strip() for part in value.split(",") if part.strip())
        return value
