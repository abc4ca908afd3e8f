"""Models made to harm: each is taken or refused by name, and the service goes on."""

import json
import math
import struct
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests import small_models

pytestmark = [pytest.mark.end_to_end, pytest.mark.gl]

REFUSALS = {"asset_unusable", "asset_unsupported", "asset_too_large"}
GOOD = small_models.glb()
SECONDS_EACH = 25
"""The limit of measuring, and time to start another child."""


@pytest.fixture(scope="module")
def client(service):
    with service.client() as client:
        client.post("/v1/assets", content=GOOD)  # the first one waits for a child to be warm
        yield client


@pytest.fixture(autouse=True)
def the_service_goes_on(service, client):
    before = service.process.pid
    yield
    assert (service.process.poll(), service.process.pid) == (None, before)
    assert client.post("/v1/assets", content=GOOD).status_code in (200, 201)
    assert "Traceback" not in service.log()


def uploaded(client, content, media_type="application/octet-stream"):
    """Upload a file and return its facts or, if it is refused, the code why."""
    began = time.monotonic()
    answer = client.post("/v1/assets", content=content, headers={"Content-Type": media_type})
    assert time.monotonic() - began < SECONDS_EACH
    if answer.is_success:
        return answer.json()
    assert answer.status_code == 409, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert answer.json()["code"] in REFUSALS
    return answer.json()["code"]


@pytest.mark.corpus
@pytest.mark.timeout(900)
@pytest.mark.parametrize("folder", ["mesh_assimp", "mesh_trimesh", "gltf_validator"])
def test_every_file_of_the_hostile_corpus_is_taken_or_refused(corpus, client, folder):
    kinds = {".bin": "application/gltf-buffer", ".mtl": "model/mtl"}
    found = sorted(path for path in (corpus / "4_hostile" / folder).rglob("*") if path.is_file())
    assert found
    for path in found:
        known = uploaded(
            client, path.read_bytes(), kinds.get(path.suffix, "application/octet-stream")
        )
        if isinstance(known, dict) and known["kind"] == "model":
            rendered(client, known)


def rendered(client, facts):
    """Render what was taken, without anything beside it: a picture or a named refusal."""
    scene = {"nodes": [{"mesh": {"type": "model", "asset": facts["sha256"]}}]}
    answer = client.post(
        "/v1/renders",
        json={"scene": scene, "output": {"size": [16, 16]}},
        headers={"Accept": "image/png"},
    )
    assert answer.status_code in (200, 409), answer.text
    if answer.status_code == 409:
        problem = answer.json()
        code = problem.get("failure", problem)["code"]
        assert code in REFUSALS | {"asset_file_missing", "asset_missing", "camera_degenerate"}


def accessor(**changes):
    first, second = small_models.document()["accessors"]
    return {"accessors": [{**first, **changes}, second]}


def chain(depth):
    return [{"children": [number + 1]} for number in range(depth)] + [{"mesh": 0}]


HOSTILE = {
    "not json": b'glTF\x02\0\0\0\x18\0\0\0\x04\0\0\0JSON{"a"',
    "a billion vertices": small_models.glb(**accessor(count=10**9)),
    "two billion claimed bytes": b"glTF" + struct.pack("<II", 2, 2**31) + GOOD[12:],
    "negative counts": small_models.glb(**accessor(count=-3)),
    "a cycle": small_models.glb(nodes=[{"children": [1]}, {"children": [0], "mesh": 0}]),
    "a deep tree": small_models.glb(nodes=chain(100_000)),
    "deep json": b'{"asset":{"version":"2.0"},"extras":' + b"[" * 500_000,
    "a file url": small_models.gltf(uri="file:///etc/passwd"),
    "a web url": small_models.gltf(uri="http://127.0.0.1:1/x.bin"),
    "draco": small_models.glb(extensionsRequired=["KHR_draco_mesh_compression"]),
    "nan vertices": GOOD.replace(
        struct.pack("<3f", -1, -1, 0), struct.pack("<3f", math.nan, math.inf, 0)
    ),
    "an index out of range": GOOD.replace(
        struct.pack("<3H", 0, 2, 3), struct.pack("<3H", 0, 2, 60000)
    ),
    "a ply of two billion": b"ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\n"
    b"property float x\nproperty float y\nproperty float z\nend_header\n",
    "a ply list of two billion": b"ply\nformat binary_little_endian 1.0\nelement face 1\n"
    b"property list uint int vertex_indices\nend_header\n\xff\xff\xff\x7f",
    "an stl of four billion": bytes(80) + b"\xff\xff\xff\xff" + bytes(50),
    "an obj of nothing but faces": b"f 1 2 3\n" * 100_000,
    "an obj face of a million corners": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf" + b" 1 2 3" * 333_333,
    "an obj of long lines": b"v " + b"9" * 10_000_000 + b" 0 0\nf 1 1 1\n",
    "an mtllib outside": b"mtllib ../../../../etc/passwd\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "a zip": b"PK\x03\x04" + bytes(100),
    "zeros": bytes(1 << 20),
    "one byte": b"g",
}
HARMLESS = {"an obj face of a million corners", "an mtllib outside"}
"""What may be taken as well as refused."""


@pytest.mark.parametrize("name", HOSTILE)
def test_a_file_made_to_harm_is_refused_by_name(client, name):
    known = uploaded(client, HOSTILE[name])

    if name in HARMLESS and isinstance(known, dict):
        rendered(client, known)
    else:
        assert known in list(REFUSALS), known


@pytest.mark.parametrize(
    "media_type", ["image/png", "model/obj", "model/gltf-binary", "model/stl", "model/mtl"]
)
def test_what_a_file_is_called_does_not_change_what_it_is(client, media_type):
    known = uploaded(client, GOOD, media_type)

    assert (known["kind"], known["format"]) == ("model", "glb")
    for name in ("zeros", "a zip", "not json"):
        refused = uploaded(client, HOSTILE[name], media_type)
        assert refused in REFUSALS or refused["kind"] == "material_library"


def test_many_at_once_who_call_one_file_by_many_names_agree_in_the_end(service, client):
    content = small_models.glb(extras={"once": True})
    names = ["application/gltf-buffer", "model/gltf-binary", "image/png", ""] * 2

    def upload(media_type):
        with service.client() as another:
            return another.post(
                "/v1/assets", content=content, headers={"Content-Type": media_type}
            ).status_code

    with ThreadPoolExecutor(len(names)) as pool:
        statuses = list(pool.map(upload, names))

    assert set(statuses) <= {200, 201}
    assert uploaded(client, content, "application/gltf-buffer")["kind"] == "model"


def test_a_data_uri_of_200_megabytes_is_told_in_time(client):
    length = 150_000_000
    uri = "data:application/octet-stream;base64," + "A" * (length // 3 * 4)
    document = small_models.document(buffers=[{"byteLength": length, "uri": uri}])

    known = uploaded(client, json.dumps(document).encode())

    assert known == "asset_too_large" or known["kind"] == "model"


def test_an_upload_over_the_limit_is_413(client):
    answer = client.post("/v1/assets", content=bytes(1 << 20) * 257)

    assert (answer.status_code, answer.json()["code"]) == (413, "body_too_large")
