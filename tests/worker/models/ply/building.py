"""Small PLY files, made where they are tested."""

import struct

from worker.geometry.mesh import Mesh
from worker.models.formats import read_model

XYZ = [("float", "x"), ("float", "y"), ("float", "z")]


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


FACES = [("list uchar int", "vertex_indices")]


FORMATS = ("ascii", "binary_little_endian", "binary_big_endian")


CODES = {
    "char": "b",
    "uchar": "B",
    "short": "h",
    "ushort": "H",
    "int": "i",
    "uint": "I",
    "float": "f",
    "double": "d",
    "uint8": "B",
    "float32": "f",
}


def ply(
    form: str, *elements: tuple[str, list[tuple[str, str]], list[tuple]], comment: str = ""
) -> bytes:
    """Write elements: name, properties and rows; a list is a tuple within its row."""
    header = [f"ply\nformat {form} 1.0\n{comment}"]
    body = b""
    order = ">" if form == "binary_big_endian" else "<"
    for name, properties, rows in elements:
        header.append(f"element {name} {len(rows)}\n")
        header += [f"property {kind} {label}\n" for kind, label in properties]
        for row in rows:
            for (kind, _), value in zip(properties, row, strict=True):
                *_, count, item = ["", "", *kind.split()]
                numbers = value if isinstance(value, tuple) else (value,)
                if form == "ascii":
                    written = [len(value)] if isinstance(value, tuple) else []
                    body += " ".join(map(str, [*written, *numbers])).encode() + b" "
                else:
                    if isinstance(value, tuple):
                        body += struct.pack(order + CODES[count], len(value))
                    body += struct.pack(f"{order}{len(numbers)}{CODES[item]}", *numbers)
            body += b"\n" if form == "ascii" else b""
    return "".join([*header, "end_header\n"]).encode() + body


def square(form: str = "ascii", faces: list[tuple] | None = None) -> bytes:
    rows = [((0, 1, 2, 3),)] if faces is None else faces
    return ply(form, ("vertex", XYZ, SQUARE), ("face", FACES, rows))


def mesh(data: bytes) -> Mesh:
    (part,) = read_model(data, {}).parts
    return part.mesh
