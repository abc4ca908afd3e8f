"""What work will take, guessed before it starts: wall seconds on one core, bytes at its peak."""

from dataclasses import dataclass
from typing import Self


@dataclass(frozen=True, slots=True)
class Cost:
    """An estimate; sums are pessimistic: seconds add up and so do bytes."""

    seconds: float = 0.0
    bytes: float = 0.0

    def __add__(self, other: Self) -> "Cost":
        return Cost(self.seconds + other.seconds, self.bytes + other.bytes)

    def then(self, other: Self) -> "Cost":
        """Return the cost of one work after another, of which the first leaves no memory behind."""
        return Cost(self.seconds + other.seconds, max(self.bytes, other.bytes))

    def exceeds(self, limit: Self) -> bool:
        """Whether either the time or the memory is over the limit."""
        return self.seconds > limit.seconds or self.bytes > limit.bytes
