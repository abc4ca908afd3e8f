"""Reads PLY."""
