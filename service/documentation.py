"""Pieces of the OpenAPI document that several operations share."""

from collections.abc import Mapping
from typing import Annotated, Any, Final, TypeAlias

from fastapi import Path

from api_schemas.jobs import JOB_ID_PATTERN, Job
from api_schemas.output import MEDIA_TYPES
from service.problems import MEDIA_TYPE, TABLE

Document = dict[str, Any]
Responses = dict[int | str, Document]

TEXT: Final = {"type": "string"}
BINARY: Final = {"type": "string", "format": "binary"}


def header(
    description: str, schema: Mapping[str, Any] = TEXT, *, required: bool = True
) -> Document:
    """Describe a header of a response."""
    return {"description": description, "schema": dict(schema), "required": required}


LOCATION: Final = {"Location": header("Where it is.")}
ETAG: Final = {"ETag": header("The SHA-256 of the bytes, in quotes.")}
RETRY_AFTER: Final = {
    "Retry-After": header("Seconds after which to ask again.", {"type": "integer", "minimum": 0})
}
LATER: Final = {"Retry-After": RETRY_AFTER["Retry-After"] | {"required": False}}
PREFERENCE: Final = {
    "Preference-Applied": header("The preference that was heeded.", required=False)
}
DIGEST: Final = {"Texloom-Digest": header("The digest of the request.", required=False)}
PICTURES: Final = {media_type: {"schema": BINARY} for media_type in MEDIA_TYPES.values()}

JOB_ID: TypeAlias = Annotated[
    str, Path(description="The job's name.", json_schema_extra={"pattern": JOB_ID_PATTERN})
]

PREFER: Final = {
    "name": "Prefer",
    "in": "header",
    "required": False,
    "description": "`wait=N` waits up to N seconds (60 at most) for the job to finish; "
    "`respond-async` does not wait.",
    "schema": TEXT,
}
IF_HEADERS: Final = "Heeds If-None-Match, If-Range and a Range of one part."


def problems(*codes: str) -> Responses:
    """Describe refusals: one response for each status, naming its codes."""
    responses: Responses = {}
    for status in sorted({TABLE[code][0] for code in codes}):
        names = [code for code in codes if TABLE[code][0] == status]
        responses[status] = {
            "description": "; ".join(f"`{name}`: {TABLE[name][1].lower()}" for name in names),
            "content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}},
        }
        if status in (429, 503, 507):
            responses[status]["headers"] = RETRY_AFTER
        if "job_not_finished" in names:
            responses[status]["headers"] = LATER
    return responses


def job_links() -> Document:
    """Describe where one may go from a job, for readers and for tests that follow links."""
    return {
        name: {
            "operationId": operation,
            "parameters": {"job_id": "$response.body#/id"},
            "description": text,
        }
        for name, operation, text in (
            ("self", "get_job", "How the job is."),
            ("cancel", "cancel_job", "Stop the job."),
            ("events", "get_events", "What happens to the job, as it happens."),
            ("preview", "get_preview", "A small picture of how far it is."),
            ("result", "get_result", "The finished file."),
        )
    }


def json_request(name: str, examples: Mapping[str, Document]) -> Document:
    """Describe a request body of the named schema."""
    content: Document = {"schema": {"$ref": f"#/components/schemas/{name}"}}
    if examples:
        content["examples"] = {key: {"value": value} for key, value in examples.items()}
    return {"requestBody": {"required": True, "content": {"application/json": content}}}


JSON_BODY_CODES: Final = (
    "origin_refused",
    "json_malformed",
    "json_encoding",
    "json_duplicate_key",
    "json_number",
    "json_surrogate",
    "json_too_deep",
    "body_too_large",
    "media_type_unsupported",
    "request_invalid",
)

OBSTACLE_CODES: Final = (
    "asset_missing",
    "asset_kind_mismatch",
    "asset_file_missing",
    "model_part_unknown",
    "camera_degenerate",
    "light_degenerate",
    "transform_singular",
    "nesting_too_deep",
    "too_many_nodes",
    "too_many_maps",
    "layout_without_direction",
    "volume_without_box",
    "layout_mismatch",
    "layout_impossible",
    "formula_missing",
    "time_step_unstable",
    "no_steady_state",
    "reaction_diverged",
    "environment_texels",
    "exemplar_unusable",
    "coordinates_unsuited",
    "coordinates_missing",
    "mipmaps_need_exr",
    "mipmaps_need_one_part",
    "layers_need_exr",
    "layer_unknown",
    "texture_not_solid",
    "atlas_too_large",
    "over_budget",
)

SUBMITTED: Final[Responses] = {
    200: {
        "description": "The job, already finished; or, where Accept prefers it, the picture.",
        "model": Job,
        "content": dict(PICTURES),
        "headers": PREFERENCE
        | DIGEST
        | {
            "Location": header("The job.", required=False),
            "ETag": header("Of a picture: the SHA-256 of its bytes.", required=False),
            "Content-Location": header("Of a picture: where it stays.", required=False),
        },
        "links": job_links(),
    },
    202: {
        "description": "The job, not yet finished.",
        "model": Job,
        "headers": LOCATION | RETRY_AFTER | PREFERENCE,
        "links": job_links(),
    },
    **problems(
        *JSON_BODY_CODES,
        *OBSTACLE_CODES,
        "not_acceptable",
        "idempotency_key_reused",
        "job_failed",
        "job_cancelled",
        "queue_full",
        "tenant_queue_full",
        "draining",
        "storage_full",
        "result_evicted",
    ),
}
"""What a request for a picture may be answered."""
