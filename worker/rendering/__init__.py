"""Scenes to pictures: pyrender's traversal with our own GLSL, float targets and sampling."""
