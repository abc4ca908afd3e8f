"""What the forkserver loads last: it makes sure that what came before can be shared.

A fork beside a thread may wait for ever for a lock that the thread held, so a library that starts
one while it is loaded is noticed here, before the first child. And the garbage collector is kept
away: it writes a mark beside every object it looks at, which in a child would copy nearly every
page it shares with the others.
"""

import gc
from pathlib import Path

threads = len(list(Path("/proc/self/task").iterdir()))
if threads != 1:
    raise RuntimeError(f"{threads} threads run in the forkserver; a library started them")
gc.collect()
gc.freeze()
