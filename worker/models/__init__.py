"""Uploaded models: read, measured and held."""
