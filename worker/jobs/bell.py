"""Wakes coroutines from threads: how a waiting request hears of a change without asking for it."""

import asyncio
import threading
from collections import defaultdict
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager


class Bell:
    """One bell for each key; ringing wakes everybody who listens to that key."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._listeners: defaultdict[str, set[tuple[asyncio.AbstractEventLoop, asyncio.Event]]] = (
            defaultdict(set)
        )

    @contextmanager
    def listening(self, key: str) -> Iterator[asyncio.Event]:
        """An event of the running loop that is set whenever the bell rings."""
        listener = (asyncio.get_running_loop(), asyncio.Event())
        with self._lock:
            self._listeners[key].add(listener)
        try:
            yield listener[1]
        finally:
            with self._lock:
                self._listeners[key].discard(listener)
                if not self._listeners[key]:
                    del self._listeners[key]

    async def until(
        self, key: str, is_so: Callable[[], Awaitable[bool]], timeout_seconds: float
    ) -> bool:
        """Wait until something is so, asked now and whenever the bell rings; False if in vain."""
        deadline = asyncio.get_running_loop().time() + timeout_seconds
        with self.listening(key) as rung:
            while True:
                rung.clear()
                if await is_so():
                    return True
                try:
                    async with asyncio.timeout_at(deadline):
                        await rung.wait()
                except TimeoutError:
                    return False

    def ring(self, key: str) -> None:
        """Wake the listeners, from any thread."""
        with self._lock:
            listeners = tuple(self._listeners.get(key, ()))
            # A listener leaves under this lock, so that its loop cannot have been closed yet.
            for loop, rung in listeners:
                loop.call_soon_threadsafe(rung.set)
