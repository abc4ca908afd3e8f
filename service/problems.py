"""Everything the service refuses: one table of codes, one shape, RFC 9457.

Nothing of the request is repeated but the names of keys, and no stack trace leaves the log.
"""

from collections.abc import Mapping, Sequence
from typing import Final

from starlette.responses import Response

from api_schemas.problems import CostFigures, JobFailure, Obstruction, Problem

MEDIA_TYPE: Final = "application/problem+json"

TABLE: Final[Mapping[str, tuple[int, str]]] = {
    "json_malformed": (400, "The body is not one JSON value"),
    "json_encoding": (400, "The body is not UTF-8"),
    "json_duplicate_key": (400, "An object holds a key twice"),
    "json_number": (400, "A number is not finite or too long"),
    "json_surrogate": (400, "A text holds half a character"),
    "json_too_deep": (400, "The body is nested too deeply"),
    "multipart_malformed": (400, "The form is not well-formed"),
    "origin_refused": (403, "Pages of this origin may not change anything"),
    "not_found": (404, "There is nothing here"),
    "job_unknown": (404, "There is no such job"),
    "batch_unknown": (404, "There is no such batch"),
    "asset_unknown": (404, "There is no such asset"),
    "technique_unknown": (404, "There is no such technique"),
    "method_not_allowed": (405, "This cannot be done here"),
    "not_acceptable": (406, "Nothing that is made here is accepted"),
    "request_timeout": (408, "The request came too slowly"),
    "asset_missing": (409, "An asset has not been uploaded"),
    "asset_kind_mismatch": (409, "An asset is of another kind than what is wanted there"),
    "asset_file_missing": (409, "A model needs files that were not given"),
    "model_part_unknown": (409, "A model has no such part"),
    "asset_unusable": (409, "The upload is damaged or holds nothing that can be used"),
    "asset_unsupported": (409, "The upload is of a kind, or needs a feature, that is not taken"),
    "asset_too_large": (409, "What the upload holds is too large"),
    "camera_degenerate": (409, "The camera cannot see"),
    "light_degenerate": (409, "A light has no direction or no shape"),
    "transform_singular": (409, "A transform cannot be undone"),
    "nesting_too_deep": (409, "Too many levels within each other"),
    "too_many_nodes": (409, "Too many textures or scene nodes"),
    "too_many_maps": (409, "Too many maps at once"),
    "time_step_unstable": (409, "The steps of a reaction are too long to be stable"),
    "no_steady_state": (409, "The chemicals of a reaction are nowhere at rest"),
    "reaction_diverged": (409, "The chemicals of a reaction grew without end"),
    "environment_texels": (409, "Numbers of an environment are infinite or none"),
    "exemplar_unusable": (409, "There is nothing to copy"),
    "exemplar_maps_differ": (409, "Exemplars do not have the same maps"),
    "options_exclude_each_other": (409, "Options cannot be had together"),
    "layout_without_direction": (409, "A layout needs coordinates that are a direction"),
    "layout_mismatch": (409, "A picture does not have the shape of its layout"),
    "layout_impossible": (409, "A layout cannot be so"),
    "formula_missing": (409, "A texture has no formula where one is asked for"),
    "coordinates_unsuited": (409, "These coordinates cannot be used there"),
    "coordinates_missing": (409, "A mesh lacks the texture coordinates that are needed"),
    "mipmaps_need_exr": (409, "A PNG holds one size only"),
    "mipmaps_need_one_part": (409, "A file of several parts holds one size of each"),
    "layers_need_exr": (409, "A PNG shows one layer only"),
    "layer_unknown": (409, "The technique has no such layer"),
    "volume_without_box": (409, "What fills a box has none"),
    "texture_not_solid": (409, "The texture does not fill space"),
    "atlas_too_large": (409, "The slices do not fit beside each other"),
    "over_budget": (409, "The request would take too much time or memory"),
    "sweep_pointer_unknown": (409, "A sweep leads to something that is not there"),
    "sweep_pointers_overlap": (409, "Two axes of a sweep change the same thing"),
    "sweep_lengths_differ": (409, "The axes of a sweep do not fit together"),
    "sweep_value_invalid": (409, "A value of a sweep does not fit where it is put"),
    "batch_too_large": (409, "The batch has too many requests"),
    "idempotency_key_reused": (409, "The key stands for another request already"),
    "job_not_finished": (409, "The job is not finished"),
    "job_cancelled": (409, "The job was cancelled"),
    "job_failed": (409, "The job failed"),
    "preview_missing": (404, "There is no preview of the job now"),
    "result_evicted": (410, "The result has been removed"),
    "body_too_large": (413, "The body is too large"),
    "media_type_unsupported": (415, "This media type is not taken here"),
    "range_not_satisfiable": (416, "The file does not have these bytes"),
    "request_invalid": (422, "The request does not fit its schema"),
    "queue_full": (429, "Too much is waiting already"),
    "tenant_queue_full": (429, "Too much of yours is waiting already"),
    "too_many_streams": (429, "Too many streams of events are open"),
    "internal_error": (500, "The service made a mistake"),
    "draining": (503, "The service is stopping"),
    "not_ready": (503, "The service is not ready yet"),
    "storage_full": (507, "There is no room left on the disk"),
}
"""Status and title of every code."""


class ProblemError(Exception):
    """A request that is refused, with all that its answer says."""

    def __init__(
        self,
        code: str,
        detail: str | None = None,
        *,
        pointer: str | None = None,
        problems: Sequence[Obstruction] | None = None,
        estimate: CostFigures | None = None,
        limit: CostFigures | None = None,
        failure: JobFailure | None = None,
        instance: str | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__(code)
        status, title = TABLE[code]
        self.problem = Problem(
            type=f"urn:texloom:problem:{code}",
            title=title,
            status=status,
            code=code,
            detail=detail,
            pointer=pointer,
            problems=None if problems is None else list(problems),
            estimate=estimate,
            limit=limit,
            failure=failure,
            instance=instance,
        )
        self.headers = dict(headers or {})

    def response(self) -> Response:
        """Return the answer."""
        return Response(
            self.problem.model_dump_json(exclude_none=True),
            status_code=self.problem.status,
            headers={"Cache-Control": "no-store", **self.headers},
            media_type=MEDIA_TYPE,
        )
