"""Reads OBJ with MTL."""
