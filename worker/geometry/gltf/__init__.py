"""Reads glTF 2.0: GLB, and .gltf with what lies beside it or inside it. See `reader.read`.

What the official validator calls an error is refused where it says that the data cannot be meant
or cannot be found. Five of its errors are repaired with a warning instead, because files in the
wild have them and the picture is not in doubt: normals and tangents that are not unit, weights
that do not add up to one, colours beyond 0..1, bounds that are absent or not those of the data.
"""
