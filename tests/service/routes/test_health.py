PERLIN = {"texture": {"technique": "perlin"}}


def test_it_is_alive_and_ready(client):
    assert client.get("/livez").json() == {"status": "alive"}
    ready = client.get("/readyz")

    assert ready.status_code == 200
    assert ready.json()["warm_slots"] >= 1
    assert ready.json()["fingerprint"] == "toy"


def test_it_is_not_ready_before_a_worker_is_warm_nor_while_it_stops(make_client):
    client = make_client(executor="slow_to_warm_executor", slots=1)
    cold = client.get("/readyz")
    accepted = client.post("/v1/textures", json=PERLIN)
    client.app.state.engine.drain(0)
    stopping = client.get("/readyz")
    refused = client.post("/v1/textures", json=PERLIN)

    assert (cold.status_code, cold.json()["code"]) == (503, "not_ready")
    assert accepted.status_code == 202
    assert (stopping.status_code, stopping.json()["code"]) == (503, "draining")
    assert (refused.status_code, refused.json()["code"]) == (503, "draining")
    assert all(int(answer.headers["retry-after"]) >= 1 for answer in (cold, stopping, refused))
    assert client.get("/livez").status_code == 200
