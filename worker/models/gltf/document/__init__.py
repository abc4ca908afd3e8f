"""glTF 2.0's JSON as pydantic models: types, ranges and shapes, but not yet what refers to what.

Unknown properties are ignored, as glTF asks; `root.read_document` gives the whole.
"""
