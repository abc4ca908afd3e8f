"""What a job shows while it runs is there as long as it runs."""


def test_a_preview_is_there_until_the_job_is_finished(engine, submit, finish, wait_until, tmp_path):
    seen = tmp_path / "seen"
    job = submit(engine, do="show", seen=str(seen))
    wait_until(lambda: engine.preview_path(job) is not None)
    assert engine.preview_path(job).read_bytes() == b"half a picture"
    seen.touch()
    assert finish(engine, job).state == "succeeded"
    assert engine.preview_path(job) is None


def test_a_job_that_shows_nothing_has_none(engine, submit, finish):
    job = submit(engine, do="nothing")
    assert finish(engine, job).state == "succeeded"
    assert engine.preview_path(job) is None


def test_what_a_dead_service_left_is_swept(make_engine, tmp_path):
    left = tmp_path / "data" / "results" / "0123.preview.part"
    left.parent.mkdir(parents=True)
    left.write_bytes(b"half a picture")
    make_engine()
    assert not left.exists()
