"""What tests of batches send, and how they look at the answers."""

import time

from service.examples import examples

SCENE = examples("render")["shapes"]


def texture(seed=0, width=16, height=16, **more):
    return {
        "texture": {"technique": "perlin", "seed": seed},
        "output": {"size": [width, height]},
        **more,
    }


def post(client, body, **headers):
    return client.post("/v1/batches", json=body, headers=headers)


def made(client, body):
    response = post(client, body)
    assert response.status_code == 202, response.text
    return response.json()


def finished(client, batch):
    """Wait for the end of a batch."""
    deadline = time.monotonic() + 60
    while (now := client.get(batch["links"]["self"]).json())["finished"] is None:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    return now


def manifest(client, batch):
    return client.get(batch["links"]["manifest"]).json()


def swept(mode, *axes, request=None):
    return {
        "request": request or texture(),
        "sweep": {
            "mode": mode,
            "axes": [{"pointer": pointer, "values": values} for pointer, values in axes],
        },
    }


def newest(client):
    """The ids of the newest job and of the newest batch."""
    return [
        [item["id"] for item in client.get(f"/v1/{name}?limit=1").json()[name]]
        for name in ("jobs", "batches")
    ]


def refusal(client, body, status=409):
    """The code and the pointer of a refusal, after which nothing was recorded."""
    before = newest(client)
    response = post(client, body)
    assert response.status_code == status, response.text
    assert newest(client) == before
    problem = response.json()
    return problem["code"], problem.get("pointer", problem.get("problems", [{}])[0].get("pointer"))
