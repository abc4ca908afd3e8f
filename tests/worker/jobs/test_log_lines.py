"""Nobody who chooses a text that is logged can forge a line."""

import io
import json
import logging

import pytest

from worker.jobs.log_lines import JsonLines, telling


@pytest.fixture
def log():
    stream = io.StringIO()
    handler = logging.StreamHandler(stream)
    handler.setFormatter(JsonLines())
    logger = logging.Logger("test")
    logger.addHandler(handler)
    logger.written = stream.getvalue
    return logger


@pytest.mark.parametrize(
    "text",
    [
        '\n{"level": "error", "message": "forged"}',
        "\r\x1b[2J\x1b]0;owned\x07",
        "\u2028\u2029\u0085\u202e",
        "\ud800",
        '"}, {"',
    ],
)
def test_a_message_is_one_line_of_plain_characters_whatever_it_holds(log, text):
    with telling(request=text):
        log.info("got %s", text, extra={"fields": {"path": text}})
    written = log.written()
    assert written.endswith("\n")
    assert all(0x20 <= ord(character) < 0x7F for character in written[:-1])
    line = json.loads(written)
    assert (line["message"], line["request"], line["path"]) == (f"got {text}", text, text)
    assert (line["level"], line["logger"]) == ("info", "test")


def test_an_exception_is_in_its_line(log):
    try:
        raise ValueError("two\nlines")
    except ValueError:
        log.exception("failed")
    line = json.loads(log.written())
    assert line["exception"].endswith("ValueError: two\nlines\n")
    assert "Traceback" in line["exception"]


def test_fields_are_told_within_and_not_after(log):
    with telling(job="a"), telling(slot="b"):
        log.info("within")
    log.info("after")
    within, after = map(json.loads, log.written().splitlines())
    assert (within["job"], within["slot"]) == ("a", "b")
    assert "job" not in after


def test_a_long_message_is_cut(log):
    log.info("x" * 10**6)
    assert len(log.written()) < 20_000
