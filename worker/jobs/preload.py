"""What the forkserver loads before it forks; nothing else may import this.

Importing it ties the process to its parent: it dies at once when the parent's main thread does,
however the parent died. Setting this in the children alone is not enough, since their parent is the
forkserver.
"""

import signal
from multiprocessing import spawn

from worker.jobs.child import die_with_parent

die_with_parent()

# A service manager sends SIGTERM to the whole group; the children must outlive it to drain.
signal.signal(signal.SIGTERM, signal.SIG_IGN)


def _leave_main_alone(_main: str) -> None:
    """Stand in for the step that imports the parent's `__main__`, which no child of ours needs.

    That import would load the whole service into every child. These two names are private to
    multiprocessing: where a Python does not have them, children only start more slowly.
    """


for _step in ("_fixup_main_from_name", "_fixup_main_from_path"):
    setattr(spawn, _step, _leave_main_alone)
