"""Reads glTF 2.0: GLB, and .gltf with what lies beside it or inside it. See `reader.read`.

What the official validator calls an error is refused, where it leaves in doubt what is meant or
whether it is there. Files in the wild have other errors that leave no doubt about the picture:
 - normals and tangents that are not of unit length, and weights of joints that do not add up to
   one, are brought to that; colours of vertices beyond 0..1 are cut;
 - min and max that are absent or not those of the data, targets of buffer views, vertices on odd
   addresses and all of animations are not needed, and not looked at.
"""
