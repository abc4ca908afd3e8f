"""The worker's errors: everything that may end a job, each with a stable code.

    Exception
    └── WorkerError             code, message, pointer
        ├── UnusableAssetError  asset_unusable | asset_unsupported | asset_too_large
        ├── AssetMissingError   asset_missing | asset_file_missing
        └── RenderError         render_failed | camera_degenerate | light_degenerate
                                | transform_singular | model_part_unknown
                                | coordinates_missing | coordinates_unsuited
                                | over_budget | environment_texels | exemplar_unusable
                                | layout_mismatch | layout_without_direction | formula_missing
                                | no_steady_state | reaction_diverged

A message says what is wrong, which value and which bound; it never repeats the input.
`as_failure` is how an error crosses processes: as data, never as a pickled exception.
"""

from typing import ClassVar, TypedDict


class Failure(TypedDict):
    """An error as JSON-able data."""

    code: str
    message: str
    pointer: str | None


class WorkerError(Exception):
    """A job cannot be done, for a reason that the caller may read.

    Args:
        message: What, which value, which bound.
        pointer: JSON pointer (RFC 6901) into the request body to what is at fault, if known.
        code: The stable snake_case name of the reason; each class has its own when left out.
    """

    default_code: ClassVar[str] = "worker_failed"

    def __init__(self, message: str, pointer: str | None = None, *, code: str | None = None):
        super().__init__(message)
        self.message = message
        self.pointer = pointer
        self.code = code or self.default_code

    def as_failure(self) -> Failure:
        """Give the error as data that crosses processes."""
        return {"code": self.code, "message": self.message, "pointer": self.pointer}


class UnusableAssetError(WorkerError):
    """A file is damaged or lies about itself, is of no accepted kind, or is too large."""

    default_code = "asset_unusable"


class AssetMissingError(WorkerError):
    """A request names an asset that is not stored, or a model a file that is not in its set."""

    default_code = "asset_missing"


class RenderError(WorkerError):
    """A request that looked possible cannot be drawn or synthesised."""

    default_code = "render_failed"
