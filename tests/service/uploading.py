"""Uploads that the toy measurer takes, and requests that use them."""

import json
import os


def picture():
    """A new upload that the measurer takes."""
    return b"\x89PNG" + os.urandom(8)


def toy(facts):
    """A new upload of which the measurer tells these facts."""
    return b"toy " + json.dumps({**facts, "sha256": os.urandom(9).hex()}).encode()


def image_request(sha256):
    return {"texture": {"technique": "image", "asset": sha256}, "output": {"size": [16, 16]}}
