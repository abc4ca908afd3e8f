import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import func, select

from worker.jobs import idempotency
from worker.jobs.errors import KeyReusedError, QueueFullError
from worker.jobs.idempotency import Key
from worker.jobs.intake import Request
from worker.jobs.schema import idempotency_keys, jobs

DAY = 24 * 3600


@pytest.fixture
def requests(make_requests):
    return make_requests(queue_limit=3, slots=1)


def request(digest="d"):
    return Request("a", "texture", {}, digest, "interactive", 60.0)


def key(name="k", fingerprint="f"):
    return Key("/v1/textures", name, fingerprint)


def count(database, table):
    with database.reading() as connection:
        return connection.execute(select(func.count()).select_from(table)).scalar_one()


def test_twenty_threads_with_one_key_record_one_job(requests, database):
    with ThreadPoolExecutor(20) as pool:
        made = list(pool.map(lambda _: requests.submit(request(), key()), range(20)))

    assert len({job.id for job in made}) == 1
    assert count(database, jobs) == 1


def test_another_fingerprint_is_refused_and_records_nothing(requests, database):
    requests.submit(request(), key())
    with pytest.raises(KeyReusedError):
        requests.submit(request("e"), key(fingerprint="g"))
    with pytest.raises(KeyReusedError):
        requests.replayed("a", key(fingerprint="g"))
    assert count(database, jobs) == 1


def test_tenants_have_keys_of_their_own(requests):
    mine = requests.submit(request(), key())
    theirs = requests.submit(
        Request("b", "texture", {}, "e", "interactive", 60.0), key(fingerprint="g")
    )
    assert requests.replayed("a", key()).id == mine.id
    assert requests.replayed("b", key(fingerprint="g")).id == theirs.id


def test_a_refused_request_leaves_its_key_free(requests, database):
    for digest in "xyz":
        requests.submit(request(digest))
    with pytest.raises(QueueFullError):
        requests.submit(request("w"), key())
    assert count(database, idempotency_keys) == 0


def test_old_keys_are_swept_by_new_ones_and_at_the_start(requests, database, monkeypatch):
    now = time.time()
    requests.submit(request(), key("old"))
    monkeypatch.setattr(time, "time", lambda: now + DAY + 1)
    requests.submit(request(), key("new"))
    assert count(database, idempotency_keys) == 1
    monkeypatch.setattr(time, "time", lambda: now + 2 * DAY + 2)
    idempotency.sweep(database)
    assert count(database, idempotency_keys) == 0


def test_a_key_survives_a_restart(make_engine, submit):
    engine = make_engine()
    job = engine.submit("texture", {"do": "nothing"}, "d" * 64, tenant="local", key=key())
    engine.drain(5)
    engine = make_engine()

    assert engine.replayed("local", key()).id == job.id
    assert engine.replayed("other", key()) is None
    assert engine.replayed("local", key("other")) is None
