"""The HTTP front end: validates, admits, answers. Never loads GL, numba or OpenImageIO."""
