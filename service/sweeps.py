"""One request swept over values: which requests that makes, and where each value came from."""

import itertools
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

from pydantic import ValidationError

from api_schemas.batches import ITEMS_MAX, Axis, SweptBatch
from api_schemas.problems import Obstruction
from api_schemas.requests import Request
from service.pointers import obstructions
from service.problems import ProblemError

INDEX: Final = re.compile(r"0|[1-9]\d{0,9}")

Choice = tuple[int, ...]
"""Which value of each axis."""


@dataclass(frozen=True, slots=True)
class Variation:
    """One request of a sweep, and the values it was made with."""

    request: Request
    axes: Sequence[Axis]
    choice: Choice

    @property
    def values(self) -> dict[str, Any]:
        """The values by the pointers they were put at."""
        return {
            axis.pointer: axis.values[index]
            for axis, index in zip(self.axes, self.choice, strict=True)
        }

    def origin(self, pointer: str) -> str:
        """Return where in the body lies what a pointer into the request leads to."""
        return _origin(self.axes, self.choice, pointer)


def variations(body: SweptBatch) -> Iterator[Variation]:
    """Yield the requests of a sweep, each as valid as if it had come alone.

    Raises:
        ProblemError: An axis leads nowhere or into another one, lengths differ, there are too many
            requests, or one does not fit its schema.
    """
    axes = body.sweep.axes
    full = body.request.model_dump(mode="json")
    paths = [_path(axis.pointer) for axis in axes]
    _require_there(paths, full)
    written = body.request.model_dump(mode="json", exclude_unset=True)
    for number, choice in enumerate(_choices(body)):
        value = written
        for axis, path, index in zip(axes, paths, choice, strict=True):
            value = _placed(value, full, path, axis.values[index])
        try:
            request = type(body.request).model_validate(value)
        except ValidationError as error:
            raise _unfit(axes, choice, number, obstructions(error, type(body.request))) from None
        yield Variation(request, axes, choice)


def _choices(body: SweptBatch) -> Iterator[Choice]:
    """Which value of each axis, for one request after another; the last axis changes fastest."""
    lengths = [len(axis.values) for axis in body.sweep.axes]
    if body.sweep.mode == "zip":
        for index, length in enumerate(lengths):
            if length != lengths[0]:
                raise ProblemError(
                    "sweep_lengths_differ",
                    f"axis 0 has {lengths[0]} values and axis {index} has {length}",
                    pointer=f"/sweep/axes/{index}/values",
                )
        return zip(*(range(length) for length in lengths), strict=True)
    if (count := math.prod(lengths)) > ITEMS_MAX:
        raise ProblemError(
            "batch_too_large",
            f"the grid has {count} requests; at most {ITEMS_MAX}",
            pointer="/sweep/axes",
        )
    return itertools.product(*(range(length) for length in lengths))


def _path(pointer: str) -> tuple[str, ...]:
    return tuple(
        token.replace("~1", "/").replace("~0", "~")
        for token in pointer.removeprefix("/").split("/")
    )


def _require_there(paths: Sequence[tuple[str, ...]], full: Any) -> None:
    for index, path in enumerate(paths):
        if not _leads_somewhere(full, path):
            raise ProblemError(
                "sweep_pointer_unknown",
                f"axis {index} leads to nothing in the request",
                pointer=f"/sweep/axes/{index}/pointer",
            )
        for other in range(index):
            shorter = min(len(path), len(paths[other]))
            if path[:shorter] == paths[other][:shorter]:
                raise ProblemError(
                    "sweep_pointers_overlap",
                    f"axis {index} and axis {other} lead to the same place or into each other",
                    pointer=f"/sweep/axes/{index}/pointer",
                )


def _leads_somewhere(value: Any, path: Sequence[str]) -> bool:
    for token in path:
        if isinstance(value, dict) and token in value:
            value = value[token]
        elif isinstance(value, list) and INDEX.fullmatch(token) and int(token) < len(value):
            value = value[int(token)]
        else:
            return False
    return True


def _placed(written: Any, full: Any, path: Sequence[str], value: Any) -> Any:
    """Return what was written with a value in another place; defaults are filled in on the way.

    Only on the way: other defaults stay open, since they may not fit the new value.
    """
    if not path:
        return value
    token, rest = path[0], path[1:]
    if isinstance(full, list):
        index = int(token)
        inner = _placed(written[index], full[index], rest, value)
        return [*written[:index], inner, *written[index + 1 :]]
    inner = _placed(written.get(token, full[token]), full[token], rest, value)
    return {**written, token: inner}


def _unfit(
    axes: Sequence[Axis], choice: Choice, number: int, found: Sequence[Obstruction]
) -> ProblemError:
    told = [
        Obstruction(
            code=item.code,
            pointer=_origin(axes, choice, item.pointer),
            message=f"item {number}: {item.pointer} {item.message}",
        )
        for item in found
    ]
    first = told[0]
    return ProblemError("sweep_value_invalid", first.message, pointer=first.pointer, problems=told)


def _origin(axes: Sequence[Axis], choice: Choice, pointer: str) -> str:
    for number, (axis, index) in enumerate(zip(axes, choice, strict=True)):
        if pointer == axis.pointer or pointer.startswith(f"{axis.pointer}/"):
            inner = pointer.removeprefix(axis.pointer)
            return f"/sweep/axes/{number}/values/{index}{inner}"
    return f"/request{pointer}"
