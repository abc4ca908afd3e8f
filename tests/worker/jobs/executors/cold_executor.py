"""An executor that cannot be warmed up."""


def warm(report):
    raise RuntimeError("no OpenGL here")


def run(request, out, report):
    raise AssertionError
