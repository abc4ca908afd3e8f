"""Mistakes against the contract, each put between a caller and the real app."""

import asyncio
import json
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send


@dataclass(frozen=True)
class Call:
    """A request."""

    method: str
    path: str
    body: bytes

    @property
    def is_job_request(self) -> bool:
        return self.method == "POST" and self.path in ("/v1/textures", "/v1/renders")


@dataclass(frozen=True)
class Answer:
    """A response."""

    status: int
    headers: dict[bytes, bytes]
    body: bytes

    def with_json(self, change: Callable[[Any], Any]) -> "Answer":
        """The same with another JSON body."""
        body = json.dumps(change(json.loads(self.body))).encode()
        return replace(self, body=body)


@dataclass(frozen=True)
class Bug:
    """A mistake: where to look for it, what finds it, and what it does to answers."""

    operation: str
    phase: str
    found_as: str
    change: Callable[[Call, Answer], Answer] = lambda _call, answer: answer


class Planted:
    """The app behind paths that begin with a bug's name, with that bug."""

    def __init__(self, app: ASGIApp, bugs: dict[str, Bug]) -> None:
        self._app = app
        self._bugs = bugs

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        name, _, path = scope["path"].removeprefix("/").partition("/")
        bug = self._bugs[name]
        body = b""
        while (message := await receive())["type"] == "http.request":
            body += message.get("body", b"")
            if not message.get("more_body"):
                break
        call = Call(scope["method"], f"/{path}", body)
        answer = await self._asked(scope, call)
        answer = bug.change(call, answer)
        headers = {**answer.headers, b"content-length": str(len(answer.body)).encode()}
        start = {"type": "http.response.start", "status": answer.status}
        await send({**start, "headers": list(headers.items())})
        await send({"type": "http.response.body", "body": answer.body})

    async def _asked(self, scope: Scope, call: Call) -> Answer:
        messages: list[Message] = []
        length = [(b"content-length", str(len(call.body)).encode())]
        headers = [pair for pair in scope["headers"] if pair[0] != b"content-length"]
        raw = b"/" + scope["raw_path"].split(b"/", 2)[2]

        bodies = [call.body]

        async def receive() -> Message:
            if bodies:
                return {"type": "http.request", "body": bodies.pop(), "more_body": False}
            await asyncio.Event().wait()  # the caller never hangs up
            raise AssertionError

        async def send(message: Message) -> None:
            messages.append(message)

        inner = {**scope, "path": call.path, "raw_path": raw, "headers": headers + length}
        await self._app(inner, receive, send)
        body = b"".join(message.get("body", b"") for message in messages[1:])
        return Answer(messages[0]["status"], dict(messages[0]["headers"]), body)


def on_jobs(change: Callable[[Answer], Answer]) -> Callable[[Call, Answer], Answer]:
    """Change what is answered to a request for a picture when it is accepted."""

    def changed(call: Call, answer: Answer) -> Answer:
        return change(answer) if call.is_job_request and answer.status < 300 else answer

    return changed


def on_status(status: int, change: Callable[[Answer], Answer]) -> Callable[[Call, Answer], Answer]:
    """Change all answers of one status."""

    def changed(_call: Call, answer: Answer) -> Answer:
        return change(answer) if answer.status == status else answer

    return changed


ID = "0" * 32
JOB = {
    **dict.fromkeys(
        ("position", "stage", "eta_seconds", "started", "finished", "result", "failure")
    ),
    "id": ID,
    "kind": "texture",
    "state": "queued",
    "priority": "batch",
    "digest": 2 * ID,
    "attempt": 0,
    "progress": 0.0,
    "created": "2026-01-01T00:00:00Z",
    "links": dict.fromkeys(("self", "events", "cancel", "result"), f"/v1/jobs/{ID}"),
}
HEADERS = {b"location": b"/", b"retry-after": b"1", b"content-type": b"application/json"}
TAKEN = Answer(202, HEADERS, json.dumps(JOB).encode())


def lenient(call: Call, answer: Answer) -> Answer:
    """Take a request in spite of keys that the schema does not know."""
    if not call.is_job_request or answer.status != 422:
        return answer
    codes = {problem["code"] for problem in json.loads(answer.body)["problems"]}
    return TAKEN if codes == {"unknown_key"} else answer


def broken_on_large_seeds(call: Call, answer: Answer) -> Answer:
    try:
        seed = json.loads(call.body)["texture"]["seed"]
    except (ValueError, TypeError, KeyError):
        return answer
    large = isinstance(seed, int) and seed > 1000
    return replace(answer, status=500) if large else answer


def picky(call: Call, answer: Answer) -> Answer:
    """Refuse what the schema allows."""
    refused = call.is_job_request and answer.status < 300 and b"batch" in call.body
    return refusal(422) if refused else answer


def undead(call: Call, answer: Answer) -> Answer:
    """Serve what was deleted."""
    is_asset = call.path.startswith("/v1/assets/") and call.method in ("GET", "HEAD")
    found = Answer(200, {b"content-type": b"image/png", b"etag": b'"x"'}, b"")
    return found if is_asset and answer.status == 404 and call.path[-64:].isalnum() else answer


def lost(call: Call, answer: Answer) -> Answer:
    """Know nothing of what was just uploaded."""
    is_asset = call.method == "GET" and call.path.startswith("/v1/assets/")
    return refusal(404) if is_asset else answer


def repeated(call: Call, answer: Answer) -> Answer:
    """Tell the input back in a refusal."""
    if answer.status != 422:
        return answer
    told = call.body.decode(errors="replace")
    return answer.with_json(lambda problem: {**problem, "detail": f"cannot use {told}"})


def field_of(name: str, value: object) -> Callable[[Answer], Answer]:
    """Put another value into a field of a JSON answer; None takes the field away."""

    def change(answer: Answer) -> Answer:
        def changed(body: dict[str, Any]) -> dict[str, Any]:
            rest = {key: item for key, item in body.items() if key != name}
            return rest if value is None else {**rest, name: value}

        return answer.with_json(changed)

    return change


def without(header: bytes) -> Callable[[Answer], Answer]:
    """Leave a header out."""

    def change(answer: Answer) -> Answer:
        kept = {name: value for name, value in answer.headers.items() if name != header}
        return replace(answer, headers=kept)

    return change


def refusal(status: int) -> Answer:
    """A well-formed problem."""
    body = {"type": "x", "title": "x", "status": status, "code": "x"}
    return Answer(status, {b"content-type": b"application/problem+json"}, json.dumps(body).encode())


def as_json(answer: Answer) -> Answer:
    return replace(answer, headers={**answer.headers, b"content-type": b"application/json"})


def with_status(status: int) -> Callable[[Answer], Answer]:
    return lambda answer: replace(answer, status=status)


def accepted_nowhere(answer: Answer) -> Answer:
    """Say that work goes on, even if it is done, and not where."""
    return replace(without(b"location")(answer), status=202)


BUGS = {
    "an undocumented status": Bug("create_texture", "fuzzing", "ST103", on_jobs(with_status(201))),
    "a missing field": Bug("create_texture", "fuzzing", "ST108", on_jobs(field_of("digest", None))),
    "a field of another type": Bug(
        "list_jobs", "fuzzing", "ST108", on_status(200, field_of("next", 7))
    ),
    "a field nobody knows": Bug(
        "create_texture", "fuzzing", "ST108", on_jobs(field_of("owner", "me"))
    ),
    "a problem that says it is plain JSON": Bug(
        "create_texture", "fuzzing", "ST105", on_status(422, as_json)
    ),
    "a missing Location": Bug("create_texture", "fuzzing", "ST107", on_jobs(accepted_nowhere)),
    "a missing ETag": Bug("list_families", "fuzzing", "ST107", on_status(200, without(b"etag"))),
    "a crash on some input": Bug("create_texture", "coverage", "ST101", broken_on_large_seeds),
    "an unknown key that is accepted": Bug("create_texture", "coverage", "ST201", lenient),
    "a valid request that is refused": Bug("create_texture", "fuzzing", "ST202", picky),
    "a refusal that repeats the input": Bug(
        "create_texture", "coverage", "nothing_is_repeated", repeated
    ),
    "a refused method without those that are allowed": Bug(
        "get_job", "coverage", "ST204", on_status(405, without(b"allow"))
    ),
    "a method that is silently ignored": Bug(
        "livez", "coverage", "ST204", on_status(405, with_status(200))
    ),
    "an asset that outlives its deletion": Bug("assets", "stateful", "ST301", undead),
    "an asset that is lost": Bug("assets", "stateful", "ST302", lost),
    "a cancelled job that says it is deleted": Bug(
        "jobs", "stateful", "ST301", on_status(303, with_status(200))
    ),
}
"""By name. The last one is why cancelling a job leads back to it with 303."""
