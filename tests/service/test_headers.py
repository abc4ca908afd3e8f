import re

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings

PERLIN = {"texture": {"technique": "perlin"}, "output": {"size": [16, 16]}}
PAGE = "https://studio.example"


@pytest.fixture(scope="module")
def open_client(engine):
    """A service that lets the pages of one origin in."""
    return TestClient(create_app(Settings(cors_origins=(PAGE,)), engine))


@pytest.mark.parametrize("path", ["/livez", "/v1/jobs", "/nothing", "/docs", "/openapi.json"])
def test_every_answer_tells_browsers_to_be_careful(client, path):
    headers = client.get(path).headers

    assert headers["x-content-type-options"] == "nosniff"
    assert headers["referrer-policy"] == "no-referrer"
    assert headers["content-security-policy"].startswith("default-src 'none'")


@pytest.mark.parametrize(
    "origin",
    [PAGE, "null", "http://testserver.evil", "http://127.0.0.1:9", "http://[bad", "http://a]b"],
)
def test_a_page_from_elsewhere_may_not_write(client, origin):
    for write in ("POST /v1/assets", "POST /v1/textures", "DELETE /v1/jobs/x"):
        method, path = write.split()
        response = client.request(method, path, headers={"Origin": origin}, json=PERLIN)
        assert (response.status_code, response.json()["code"]) == (403, "origin_refused")


def test_our_own_pages_may_write(client):
    response = client.post("/v1/textures", json=PERLIN, headers={"Origin": "http://testserver"})

    assert response.is_success
    assert "access-control-allow-origin" not in response.headers


def test_an_allowed_page_may_write_and_read_the_headers(open_client):
    response = open_client.post("/v1/textures", json=PERLIN, headers={"Origin": PAGE})

    assert response.is_success
    assert response.headers["access-control-allow-origin"] == PAGE
    exposed = response.headers["access-control-expose-headers"]
    assert {"Location", "ETag", "Retry-After"} <= set(re.split(r",\s*", exposed))


def test_an_allowed_page_may_ask_first(open_client):
    asking = {
        "Origin": PAGE,
        "Access-Control-Request-Method": "DELETE",
        "Access-Control-Request-Headers": "content-type, prefer",
    }
    response = open_client.options("/v1/jobs/x", headers=asking)

    assert response.status_code == 200
    assert "DELETE" in response.headers["access-control-allow-methods"]
    assert open_client.options("/v1/jobs/x", headers=asking | {"Origin": "https://x"}).is_error


def test_the_documentation_needs_nothing_from_elsewhere(client):
    for page in ("/docs", "/redoc"):
        html = client.get(page).text
        links = re.findall(r"""(?:src|href|url)\s*[=:]\s*["']([^"']+)""", html)

        assert links
        assert not re.search(r"https?://|//[a-z]+\.", html)
        for link in links:
            assert client.get(link).status_code == 200, link
