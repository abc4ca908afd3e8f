import pytest

from service.json_body import DEPTH_MAX, parsed
from service.problems import ProblemError

GOOD = b'{"texture":{"technique":"perlin"},"output":{"size":[16,16]}}'

REFUSED = {
    "nothing": (b"", "json_malformed"),
    "only spaces": (b"  \n", "json_malformed"),
    "cut short": (GOOD[:-1], "json_malformed"),
    "trailing data": (GOOD + b"{}", "json_malformed"),
    "two values": (b"1 2", "json_malformed"),
    "a trailing comma": (b'{"texture":1,}', "json_malformed"),
    "single quotes": (b"{'texture':1}", "json_malformed"),
    "a comment": (b"// x\n{}", "json_malformed"),
    "a control character in a text": (b'{"a":"\x01"}', "json_malformed"),
    "a leading zero": (b'{"a":01}', "json_malformed"),
    "a leading plus": (b'{"a":+1}', "json_malformed"),
    "a hexadecimal number": (b'{"a":0x10}', "json_malformed"),
    "a bad escape": (b'{"a":"\\x41"}', "json_malformed"),
    "an unfinished text": (b'{"a":"', "json_malformed"),
    "an unfinished text that ends in a backslash": (b'{"a":"\\', "json_malformed"),
    "NUL": (b"\x00", "json_malformed"),
    "NaN": (b'{"a":NaN}', "json_number"),
    "Infinity": (b'{"a":Infinity}', "json_number"),
    "-Infinity": (b'{"a":[-Infinity]}', "json_number"),
    "1e999": (b'{"a":1e999}', "json_number"),
    "-1e999": (b'{"a":-1e999}', "json_number"),
    "an integer beyond float64": (b'{"a":1' + b"0" * 309 + b"}", "json_number"),
    "an integer of 5000 digits": (b'{"a":' + b"9" * 5000 + b"}", "json_number"),
    "the same key twice": (b'{"a":1,"a":1}', "json_duplicate_key"),
    "the same key twice, once escaped": (b'{"a":1,"\\u0061":2}', "json_duplicate_key"),
    "the same key twice, deep down": (b'[{"b":[{"a":1,"a":2}]}]', "json_duplicate_key"),
    "100 000 arrays": (b"[" * 100_000, "json_too_deep"),
    "100 000 arrays, closed": (b"[" * 100_000 + b"]" * 100_000, "json_too_deep"),
    "100 000 objects": (b'{"a":' * 100_000, "json_too_deep"),
    "one level too many": (b"[" * 101 + b"]" * 101, "json_too_deep"),
    "Latin-1": ('{"a":"é"}'.encode("latin-1"), "json_encoding"),
    "UTF-16": (GOOD.decode().encode("utf-16"), "json_encoding"),
    "a byte order mark": (b"\xef\xbb\xbf" + GOOD, "json_encoding"),
    "an overlong encoding": (b'{"a":"\xc0\xaf"}', "json_encoding"),
    "an encoded surrogate": (b'{"a":"\xed\xa0\x80"}', "json_encoding"),
    "half a surrogate pair": (b'{"a":["\\ud800"]}', "json_surrogate"),
    "half a surrogate pair as a key": (b'{"\\uDC00":1}', "json_surrogate"),
    "a pair the wrong way round": (b'{"a":"\\udc00\\ud800"}', "json_surrogate"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_one_json_value_is_refused_with_400(client, name):
    body, code = REFUSED[name]

    response = client.post(
        "/v1/textures", content=body, headers={"Content-Type": "application/json"}
    )

    assert response.status_code == 400, response.text
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["code"] == code


@pytest.mark.parametrize(
    ("text", "value"),
    [
        (b"512.0", 512),
        (b"5.12e2", 512),
        (b"-0.0", 0),
        (b"0.5", 0.5),
        (b"1e-999", 0),
        (b"1e300", 1e300),
        (b'"\\ud83d\\ude00"', "\N{GRINNING FACE}"),
        (b'"[[[[\\"{{{{"', '[[[["{{{{'),
        (b"[" * DEPTH_MAX + b"]" * DEPTH_MAX, None),
        (b'{"a":{"b":1},"b":{"a":1}}', {"a": {"b": 1}, "b": {"a": 1}}),
        (b" \t\r\n[] ", []),
    ],
)
def test_what_is_one_json_value_is_that_value(text, value):
    found = parsed(text)

    if value is not None:
        assert found == value
        assert type(found) is type(value)


def test_brackets_in_texts_do_not_count_as_depth():
    assert parsed(b'["' + b"[" * 10_000 + b'"]') == ["[" * 10_000]


def test_a_text_of_a_million_escapes_is_read_in_linear_time():
    assert parsed(b'"' + b"\\\\" * 500_000 + b'"') == "\\" * 500_000


@pytest.mark.parametrize(
    "media_type",
    [
        "",
        "text/plain",
        "application/x-www-form-urlencoded",
        "application/json; charset=latin-1",
        "application/json; version=2",
        "application/jsonx",
        "application/problem+json",
        "multipart/form-data",
    ],
)
def test_what_does_not_say_it_is_json_is_refused_with_415(client, media_type):
    response = client.post("/v1/textures", content=GOOD, headers={"Content-Type": media_type})

    assert (response.status_code, response.json()["code"]) == (415, "media_type_unsupported")


def test_a_body_without_a_media_type_is_refused_with_415(client):
    assert client.post("/v1/textures", content=GOOD).status_code == 415


@pytest.mark.parametrize(
    "media_type",
    ["application/json", "Application/JSON", 'application/json; charset="UTF-8"'],
)
def test_what_says_it_is_json_is_taken(client, media_type):
    response = client.post("/v1/textures", content=GOOD, headers={"Content-Type": media_type})

    assert response.status_code in (200, 202)


def test_a_compressed_body_is_refused_with_415(client):
    headers = {"Content-Type": "application/json", "Content-Encoding": "gzip"}

    assert client.post("/v1/textures", content=GOOD, headers=headers).status_code == 415


@pytest.mark.parametrize("chunked", [False, True])
def test_a_body_over_the_limit_is_refused_with_413(client, settings, chunked):
    body = b" " * (settings.body_limit_bytes + 1)
    content = (body[start : start + 65536] for start in range(0, len(body), 65536))

    response = client.post(
        "/v1/textures",
        content=content if chunked else body,
        headers={"Content-Type": "application/json"},
    )

    assert (response.status_code, response.json()["code"]) == (413, "body_too_large")


def test_a_body_of_exactly_the_limit_is_taken(client, settings):
    body = GOOD + b" " * (settings.body_limit_bytes - len(GOOD))

    response = client.post(
        "/v1/textures", content=body, headers={"Content-Type": "application/json"}
    )

    assert response.status_code in (200, 202)


def test_a_refusal_does_not_repeat_the_input():
    with pytest.raises(ProblemError) as refused:
        parsed(b'{"secret": hunter2}')

    assert b"hunter2" not in refused.value.response().body
    assert b"secret" not in refused.value.response().body
