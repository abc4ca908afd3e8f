import pytest

from service.negotiation import quality

PERLIN = {"texture": {"technique": "perlin", "seed": 7}, "output": {"size": [16, 16]}}
JSON = "application/json"
BROWSER = "text/html,application/xhtml+xml,image/avif,image/webp,image/png,*/*;q=0.8"


def asked(client, accept, body=PERLIN, **headers):
    headers = {"Accept": accept} | {name.title(): value for name, value in headers.items()}
    return client.post("/v1/textures", json=body, headers=headers)


@pytest.mark.parametrize(
    ("accept", "media_type"),
    [
        ("*/*", JSON),
        ("", JSON),
        (JSON, JSON),
        ("application/*", JSON),
        ("image/*, */*", JSON),
        ("image/png, application/json", JSON),
        ("image/png;q=0.5, application/json", JSON),
        ("image/png", "image/png"),
        ("IMAGE/PNG", "image/png"),
        ("image/*", "image/png"),
        ("image/x-exr", "image/x-exr"),
        ("image/png;q=0.1, image/x-exr;q=0.2", "image/x-exr"),
        ("image/*;q=0.5, image/png;q=0", "image/x-exr"),
        ("image/png, application/json;q=0.9", "image/png"),
        (BROWSER, "image/png"),
    ],
)
def test_accept_decides_between_the_job_and_the_picture(client, accept, media_type):
    response = asked(client, accept)

    assert response.status_code in (200, 202)
    assert response.headers["content-type"] == media_type


@pytest.mark.parametrize(
    "accept", ["text/html", "image/webp", "image/png;q=0", "*/*;q=0", "text/*, video/*"]
)
def test_accept_that_matches_nothing_is_refused_with_406(client, accept):
    response = asked(client, accept)

    assert (response.status_code, response.json()["code"]) == (406, "not_acceptable")


def test_the_format_in_the_body_wins_over_accept(client):
    body = PERLIN | {"output": {"size": [16, 16], "format": "exr"}}

    assert asked(client, "image/*", body).headers["content-type"] == "image/x-exr"
    assert asked(client, "image/png", body).status_code == 406
    assert asked(client, "image/png, application/json;q=0.1", body).status_code in (200, 202)


def test_the_format_is_in_the_digest(client):
    png = asked(client, "image/png").headers["texloom-digest"]
    exr = asked(client, "image/x-exr").headers["texloom-digest"]
    body = PERLIN | {"output": {"size": [16, 16], "format": "exr"}}

    assert png != exr
    assert asked(client, JSON, body).json()["digest"] == exr


def test_the_picture_says_where_it_stays_and_what_it_is(client):
    response = asked(client, "image/png")
    again = client.get(response.headers["content-location"])

    assert response.content.startswith(b"\x89PNG")
    assert again.content == response.content
    assert again.headers["etag"] == response.headers["etag"]
    assert again.headers["texloom-digest"] == response.headers["texloom-digest"]


def test_a_picture_that_takes_too_long_becomes_a_job(client):
    body = {"texture": {"technique": "perlin", "seed": 1002}}
    response = asked(client, "image/png", body, prefer="wait=0")

    assert response.status_code == 202
    assert response.json()["state"] in ("queued", "running")
    assert response.headers["preference-applied"] == "wait=0"
    client.delete(response.headers["location"])


def test_respond_async_does_not_wait(client):
    body = {"texture": {"technique": "perlin", "seed": 1002}}
    response = asked(client, "image/png", body, prefer="respond-async")

    assert response.status_code == 202
    assert response.headers["preference-applied"] == "respond-async"
    client.delete(response.headers["location"])


def test_a_job_is_waited_for_where_that_is_preferred(client):
    body = {"texture": {"technique": "perlin", "seed": 1004}}
    response = asked(client, JSON, body, prefer="handling=lenient, Wait=30")

    assert response.status_code == 200
    assert response.json()["state"] == "succeeded"
    assert response.headers["preference-applied"] == "wait=30"


def test_nobody_waits_longer_than_a_minute(client):
    assert asked(client, JSON, prefer="wait=99999").headers["preference-applied"] == "wait=60"


@pytest.mark.parametrize("prefer", ["wait", "wait=", "wait=-1", "wait=x", "wait=1e3", ";;,,=", ""])
def test_nonsense_in_prefer_is_ignored(client, prefer):
    response = asked(client, JSON, prefer=prefer)

    assert response.status_code in (200, 202)
    assert "preference-applied" not in response.headers


def test_a_picture_that_fails_is_a_problem_that_says_why(client):
    body = {"texture": {"technique": "perlin", "seed": 1001}}
    response = asked(client, "image/png", body)

    assert response.status_code == 409
    assert response.json()["code"] == "job_failed"
    assert response.json()["failure"] == {
        "code": "render_failed",
        "message": "the toy broke",
        "pointer": "/texture/seed",
    }
    assert client.get(response.json()["instance"]).json()["state"] == "failed"


def test_the_most_exact_range_decides():
    accept = "*/*;q=0.1, image/*;q=0.5, image/png;level=1;q=0.7"

    assert quality(accept, "image/png") == 0.7
    assert quality(accept, "image/x-exr") == 0.5
    assert quality(accept, JSON) == 0.1
    assert quality("image/png;q=nonsense", "image/png") == 1
