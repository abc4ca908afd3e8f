"""Draws every example into tests/gallery, for the README and for the eye.

`make gallery`; each picture is the example's own request, run by the executor of the service.
"""

import os
import sys
import tempfile
from pathlib import Path

import PIL.Image
import PIL.ImageOps

from tests.examples import examples
from worker.jobs.environment import child_environment

ROOT = Path(__file__).resolve().parents[2]
GALLERY = Path(__file__).parent
COLUMNS = 4


def main() -> None:
    """Draw all examples, or those named on the command line."""
    os.environ |= child_environment(
        ROOT / ".cache", gl=os.environ.get("TEXLOOM_GL", "osmesa"), native_cpu=False
    )
    # Only now: numba, OpenBLAS and Mesa read their environment when they are loaded.
    from tests.run_example import run_example  # noqa: PLC0415

    with tempfile.TemporaryDirectory() as folder:
        for name in sys.argv[1:] or examples():
            path = GALLERY / f"{name}.png"
            layers = examples()[name][1].get("output", {}).get("layers", [])
            shown = [{"layers": []}, *({"layers": [layer]} for layer in layers)] if layers else [{}]
            sheet = []
            for output in shown:
                run_example(name, path, Path(folder), format="png", **output)
                with PIL.Image.open(path) as picture:
                    # Ids are their own codes and depths are far: stretched for the eye.
                    grey = picture.mode == "L"
                    seen = PIL.ImageOps.autocontrast(picture) if grey else picture
                    sheet.append(seen.convert("RGBA"))
            size = paste(sheet, path) if layers else sheet[0].size
            sys.stdout.write(f"{path.relative_to(ROOT)}  {size[0]} x {size[1]}\n")


def paste(pictures: list[PIL.Image.Image], path: Path) -> tuple[int, int]:
    """Write a sheet of the colour and its layers, four in a row, and return its size."""
    width, height = pictures[0].size
    rows = -(-len(pictures) // COLUMNS)
    sheet = PIL.Image.new("RGBA", (width * COLUMNS, height * rows))
    for place, picture in enumerate(pictures):
        sheet.paste(picture, (place % COLUMNS * width, place // COLUMNS * height))
    sheet.resize((sheet.width // 2, sheet.height // 2)).save(path)
    return sheet.width // 2, sheet.height // 2


if __name__ == "__main__":
    main()
