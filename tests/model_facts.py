"""What might have been measured of a model."""

from typing import Any


def model_facts(**known: Any) -> dict[str, Any]:
    """Return all but the name and the length of a file: one triangle, and what is known."""
    return {
        "kind": "model",
        "format": "glb",
        "media_type": "model/gltf-binary",
        "triangles": 1,
        "lines": 0,
        "points": 0,
        "vertices": 3,
        "draws": 1,
        "bounds_min": [0.0, 0.0, 0.0],
        "bounds_max": [1.0, 1.0, 0.0],
        "uv_sets": 0,
        "has_normals": False,
        "has_tangents": False,
        "has_vertex_colors": False,
        "materials": [],
        "nodes": [],
        "cameras": [],
        "scenes": 0,
        "lights": 0,
        "texels": 0,
        "files": [],
        "warnings": [],
        **known,
    }
