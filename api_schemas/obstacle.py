"""Why a valid request cannot be done."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Obstacle:
    """One reason why a valid request cannot be done, and where in the body it lies."""

    code: str
    pointer: str
    message: str
