"""Sweeps: which requests one request becomes, and what cannot be swept."""

import pytest

from api_schemas.batches import AXES_MAX
from service import batching
from tests.service.batch_calls import made, manifest, post, refusal, swept, texture


def test_a_grid_is_every_value_with_every_other_the_last_changing_fastest(client):
    axes = [("/texture/seed", [1, 2, 3]), ("/output/size", [[8, 8], [9, 9]])]
    told = manifest(client, made(client, swept("grid", *axes)))["items"]

    assert [item["values"] for item in told] == [
        {"/texture/seed": seed, "/output/size": size} for seed in axes[0][1] for size in axes[1][1]
    ]
    assert len({item["digest"] for item in told}) == 6
    alone = client.post("/v1/validate", json=texture(2, 9, 9)).json()["digest"]
    assert told[3]["digest"] == alone


def test_a_zip_takes_the_first_of_each_then_the_second(client):
    body = swept("zip", ("/texture/seed", [1, 2, 3]), ("/texture/octaves", [4, 5, 6]))
    told = manifest(client, made(client, body))["items"]

    assert [item["values"] for item in told] == [
        {"/texture/seed": n, "/texture/octaves": n + 3} for n in (1, 2, 3)
    ]


def test_a_sweep_goes_into_defaults_and_into_lists(client):
    """Neither the octaves nor the output are written in the request; the size has two numbers."""
    request = {"texture": {"technique": "perlin"}}
    axes = [("/texture/octaves", [2]), ("/output/size/1", [64]), ("/output/size/0", [32])]
    [item] = manifest(client, made(client, swept("zip", *axes, request=request)))["items"]
    alone = {"texture": {"technique": "perlin", "octaves": 2}, "output": {"size": [32, 64]}}

    assert item["digest"] == client.post("/v1/validate", json=alone).json()["digest"]


def test_a_sweep_over_whole_textures_leaves_their_defaults_open(client):
    values = [{"technique": "checkerboard"}, {"technique": "perlin", "seed": 5}]
    told = manifest(client, made(client, swept("grid", ("/texture", values))))["items"]
    expected = [
        client.post("/v1/validate", json={**texture(), "texture": value}).json()["digest"]
        for value in values
    ]

    assert [item["digest"] for item in told] == expected


@pytest.mark.parametrize(
    "pointer",
    [
        *("/texture/sede", "/scene", "/texture/seed/0", "/texture/~0", "/"),
        *(f"/output/size/{index}" for index in ("2", "01", "-", "-1", "9" * 400)),
    ],
)
def test_a_pointer_to_nothing_is_named(client, pointer):
    body = swept("grid", ("/texture/seed", [1]), (pointer, [1]))

    assert refusal(client, body) == ("sweep_pointer_unknown", "/sweep/axes/1/pointer")


@pytest.mark.parametrize("pointer", ["", "texture/seed", "/texture/~2", "/texture/~"])
def test_what_is_no_pointer_does_not_fit_the_schema(client, pointer):
    found = refusal(client, swept("grid", (pointer, [1])), 422)

    assert found == ("request_invalid", "/sweep/axes/0/pointer")


@pytest.mark.parametrize("other", ["/texture/seed", "/texture"])
def test_axes_into_each_other_are_refused(client, other):
    body = swept("grid", ("/texture/seed", [1]), (other, [1]))

    assert refusal(client, body) == ("sweep_pointers_overlap", "/sweep/axes/1/pointer")


def test_a_zip_of_unequal_lists_is_refused(client):
    body = swept("zip", ("/texture/seed", [1, 2]), ("/texture/octaves", [1, 2, 3]))

    assert refusal(client, body) == ("sweep_lengths_differ", "/sweep/axes/1/values")


def test_a_value_that_does_not_fit_is_named(client):
    axes = [("/texture/octaves", [1, 2]), ("/texture/seed", [1, "x", 2])]

    assert refusal(client, swept("grid", *axes)) == (
        "sweep_value_invalid",
        "/sweep/axes/1/values/1",
    )


def test_a_mistake_within_a_value_is_named(client):
    values = [{"technique": "perlin"}, {"technique": "perlin", "seed": -1}]

    assert refusal(client, swept("grid", ("/texture", values))) == (
        "sweep_value_invalid",
        "/sweep/axes/0/values/1/seed",
    )


def test_what_a_value_breaks_elsewhere_is_named_there(client):
    """A checkerboard has no seed: written in the request, it is what is too much."""
    body = swept("grid", ("/texture/technique", ["perlin", "checkerboard"]))

    assert refusal(client, body) == ("sweep_value_invalid", "/request/texture/seed")


def test_a_grid_beyond_the_limit_is_refused_before_it_is_made(client):
    """8 axes of 1000 values would be 10^24 requests."""
    names = ["seed", "octaves", "frequency", "lacunarity", "gain"]
    there = set(client.post("/v1/validate", json=texture()).json()["normalised"]["texture"])
    axes = [(f"/texture/{name}", list(range(1000))) for name in names if name in there]
    axes += [("/output/size/0", list(range(1000))), ("/output/size/1", list(range(1000)))]
    code, pointer = refusal(client, swept("grid", *axes[:AXES_MAX]))

    assert (code, pointer) == ("batch_too_large", "/sweep/axes")
    axes = [("/texture/seed", list(range(7))), ("/output/size/0", list(range(1, 144)))]
    assert refusal(client, swept("grid", *axes))[0] == "batch_too_large", "7 * 143 = 1001"


def test_a_sweep_that_would_unfold_into_too_much_is_refused(client, monkeypatch):
    """A thousand copies of a scene of a megabyte would be a gigabyte of records."""
    monkeypatch.setattr(batching, "BYTES_MAX", 10_000)
    code, pointer = refusal(client, swept("grid", ("/texture/seed", list(range(1000)))))

    assert (code, pointer) == ("batch_too_large", "")


def test_a_batch_that_costs_too_much_altogether_is_refused(client):
    big = {"texture": {"technique": "perlin", "octaves": 16}, "output": {"size": [4096, 4096]}}
    one = client.post("/v1/validate", json=big).json()
    assert one["possible"]
    count = int(60 * one["limit"]["seconds"] / one["estimate"]["seconds"]) + 1
    assert count <= 1000
    body = swept("grid", ("/texture/seed", list(range(count))), request=big)
    problem = post(client, body).json()

    assert problem["code"] == "over_budget"
    assert problem["estimate"]["seconds"] > problem["limit"]["seconds"]
    assert problem["limit"]["seconds"] == 60 * one["limit"]["seconds"]
