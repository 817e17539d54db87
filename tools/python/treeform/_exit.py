"""Ends running jobs at the end of the process."""

import atexit
import time

from . import _core

#: What `_core.end` returns.
_NOTHING, _WORKS, _WRITES = 0, 1, 2
#: How long to wait for jobs, in seconds.
_PATIENCE = {_WORKS: 0.1, _WRITES: 5.0}


@atexit.register
def _end() -> None:
    """Stops jobs that still run, such as canceled ones and those of daemon threads. They no longer
    get the interpreter's lock, and their memory is not freed. Jobs that write files get more time,
    so that they can remove incomplete files."""
    begun = time.monotonic()
    while (still := _core.end()) != _NOTHING:
        if time.monotonic() - begun > _PATIENCE[still]:
            return
        time.sleep(0.01)
