"""One line for each request, and one name in it and in the answer."""

import json
import logging

import pytest

from worker.jobs.log_lines import JsonLines


def lines(caplog):
    own = [record for record in caplog.records if record.name == "service.request_log"]
    return [record.fields for record in own]


def test_a_request_is_told_in_one_line(client, caplog):
    with caplog.at_level(logging.INFO):
        answer = client.get("/v1/jobs?limit=1&cursor=secret")

    [line] = lines(caplog)
    assert (line["method"], line["path"], line["status"]) == ("GET", "/v1/jobs", 422)
    assert answer.status_code == 422
    assert line["ms"] > 0


@pytest.mark.parametrize("wished", ["a-b_c.1", "x" * 64])
def test_a_caller_may_name_its_request(client, wished):
    assert client.get("/livez", headers={"X-Request-Id": wished}).headers["x-request-id"] == wished


@pytest.mark.parametrize("wished", ["", "x" * 65, "two words", '"}{"', "é"])
def test_names_that_are_long_or_strange_are_replaced(client, wished):
    answers = [
        client.get("/livez", headers={"X-Request-Id": wished.encode("latin-1")}) for _ in range(2)
    ]
    ids = {answer.headers["x-request-id"] for answer in answers}

    assert len(ids) == 2
    assert wished not in ids


def test_refusals_carry_the_name_too(client):
    assert (
        client.get("/nothing", headers={"X-Request-Id": "mine"}).headers["x-request-id"] == "mine"
    )


def test_no_path_can_forge_a_line(client, caplog):
    with caplog.at_level(logging.INFO):
        client.get("/%0A%7B%22level%22%3A%22error%22%7D%1B%5B2J%E2%80%A8")

    [record] = [record for record in caplog.records if record.name == "service.request_log"]
    written = JsonLines().format(record)
    assert all(0x20 <= ord(character) < 0x7F for character in written)
    assert json.loads(written)["path"] == '/\n{"level":"error"}\x1b[2J\u2028'
