"""Texture techniques; adding a module adds the technique."""
