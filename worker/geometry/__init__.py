"""Shapes and places: meshes with texture coordinates, and the matrices that put them in a scene."""
