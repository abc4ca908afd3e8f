"""Pictures side by side."""

import PIL.Image
import PIL.ImageDraw

CELL = 160
COLUMNS, LABEL = 5, 12


def sheet(cells: list[tuple[str, PIL.Image.Image]]) -> PIL.Image.Image:
    """Lay pictures out in rows, each below its name."""
    rows = -(-len(cells) // COLUMNS)
    grey = all(picture.mode == "L" for _, picture in cells)
    whole = PIL.Image.new("L" if grey else "RGB", (COLUMNS * CELL, rows * (CELL + LABEL)), "grey")
    pen = PIL.ImageDraw.Draw(whole)
    for place, (name, picture) in enumerate(cells):
        left, top = place % COLUMNS * CELL, place // COLUMNS * (CELL + LABEL)
        pen.text((left + 2, top), name, fill="white")
        shown = picture.crop((0, 0, min(CELL, picture.width), min(CELL, picture.height)))
        whole.paste(shown, (left, top + LABEL))
    return whole
