import pytest

from worker.rendering import chunks

FILES = {
    "lib/a.glsl": '#include "lib/b.glsl"\nfloat a;',
    "lib/b.glsl": "float b;",
}


@pytest.fixture(autouse=True)
def _files(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chunks, "chunk", FILES.__getitem__)


def test_each_chunk_is_joined_once_and_before_its_first_use() -> None:
    text = '#version 410 core\n#include "lib/a.glsl"\n#include "lib/b.glsl"\nvoid main() {}'

    source = chunks.join(text, "main")

    code = [line for line in source.text.splitlines() if not line.startswith("#")]
    assert code == ["float b;", "float a;", "", "void main() {}"]
    assert source.chunks == ("main", "lib/a.glsl", "lib/b.glsl")


def test_compiler_lines_point_into_the_chunks() -> None:
    source = chunks.join('#version 410 core\n#include "lib/a.glsl"\nvoid main() {}', "main")

    assert source.text.splitlines() == [
        "#version 410 core",
        "#line 1 1",
        "#line 1 2",
        "float b;",
        "#line 2 1",
        "float a;",
        "#line 3 0",
        "void main() {}",
    ]


def test_a_chunk_that_does_not_exist_is_an_error() -> None:
    with pytest.raises(KeyError, match="missing"):
        chunks.join('#include "lib/missing.glsl"', "main")
