from worker.jobs import environment
from worker.jobs.environment import child_environment, kernel_cache


def test_a_portable_child_never_asks_the_host_for_its_features(tmp_path, monkeypatch):
    monkeypatch.setattr(environment.platform, "machine", lambda: "x86_64")
    variables = child_environment(tmp_path, gl="egl", native_cpu=False)
    assert variables["NUMBA_CPU_NAME"] == "x86-64-v3"
    assert variables["NUMBA_CPU_FEATURES"] == ""
    assert variables["OPENBLAS_CORETYPE"] == "Haswell"
    assert variables["LP_NATIVE_VECTOR_WIDTH"] == "256"
    assert variables["PYOPENGL_PLATFORM"] == "egl"


def test_a_native_child_does(tmp_path):
    variables = child_environment(tmp_path, gl="osmesa", native_cpu=True)
    assert not {"NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "OPENBLAS_CORETYPE"} & set(variables)
    assert variables["OPENBLAS_NUM_THREADS"] == "1"


def test_other_processors_are_not_asked_for_instructions_they_lack(tmp_path, monkeypatch):
    monkeypatch.setattr(environment.platform, "machine", lambda: "aarch64")
    assert "NUMBA_CPU_NAME" not in child_environment(tmp_path, gl="egl", native_cpu=False)


def test_a_change_in_any_source_gives_another_kernel_cache(tmp_path, monkeypatch):
    sources = tmp_path / "sources"
    (sources / "deep").mkdir(parents=True)
    kernel = sources / "deep" / "kernel.py"
    kernel.write_text("one")
    monkeypatch.setattr(environment, "SOURCES", sources)
    before = kernel_cache(tmp_path, native_cpu=False)
    assert kernel_cache(tmp_path, native_cpu=False) == before
    assert kernel_cache(tmp_path, native_cpu=True) != before
    kernel.write_text("two")
    assert kernel_cache(tmp_path, native_cpu=False) != before
