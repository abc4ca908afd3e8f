"""Reads STL."""
