"""Things in OpenGL memory that outlive a scene, by content, within a bound of bytes."""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, TypeVar

T = TypeVar("T")


class ByteCache(Generic[T]):
    """The least recently used go first. What the current scene uses is never freed under it."""

    def __init__(self, bytes_max: int, delete: Callable[[T], None]) -> None:
        """Begin empty.

        Args:
            bytes_max: How much may stay after a scene is drawn.
            delete: Frees one thing.
        """
        self._bytes_max = bytes_max
        self._delete = delete
        self._things: OrderedDict[Hashable, tuple[T, int]] = OrderedDict()
        self._bytes = 0

    def get(self, key: Hashable, make: Callable[[], tuple[T, int]]) -> T:
        """Return the thing of this key, making it and learning its bytes where it is not kept."""
        if key not in self._things:
            thing, size = make()
            self._things[key] = (thing, size)
            self._bytes += size
        self._things.move_to_end(key)
        return self._things[key][0]

    def trim(self) -> None:
        """Free the least recently used until the rest fits; call it between scenes."""
        while self._bytes > self._bytes_max:
            thing, size = self._things.popitem(last=False)[1]
            self._bytes -= size
            self._delete(thing)

    def __len__(self) -> int:
        """How many things are kept."""
        return len(self._things)
