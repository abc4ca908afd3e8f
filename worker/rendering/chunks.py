"""Join GLSL chunks into one source: each chunk once, and compiler lines that point home."""

import re
from dataclasses import dataclass
from pathlib import Path

SHADERS = Path(__file__).parent / "shaders"
_INCLUDE = re.compile(r'#include "(?P<name>[\w/]+\.\w+)"')


@dataclass(frozen=True, slots=True)
class Source:
    """A shader's text, and the chunks that the numbers in its #line directives mean."""

    text: str
    chunks: tuple[str, ...]


def join(text: str, name: str) -> Source:
    """Replace each `#include "chunk"` by the chunk where it comes first, and by nothing after that.

    The text's first line is its #version. A compiler's message "k:n" speaks of line n of chunk k.

    Args:
        text: GLSL, with includes relative to the shader folder.
        name: What to call the text itself among the chunks.

    Raises:
        FileNotFoundError: No such chunk.
    """
    chunks: list[str] = []
    lines = _expand(text, name, chunks)
    return Source("\n".join(lines) + "\n", tuple(chunks))


def chunk(name: str) -> str:
    """Read one chunk of the shader folder as it stands."""
    return (SHADERS / name).read_text(encoding="utf-8")


def _expand(text: str, name: str, chunks: list[str]) -> list[str]:
    index = len(chunks)
    chunks.append(name)
    joined = [f"#line 1 {index}"] if index else []
    for number, line in enumerate(text.splitlines(), start=1):
        include = _INCLUDE.fullmatch(line)
        if include is None:
            joined.append(line)
        elif include["name"] in chunks:
            joined.append("")
        else:
            joined += _expand(chunk(include["name"]), include["name"], chunks)
            joined.append(f"#line {number + 1} {index}")
    return joined
