"""What is done at the end of the process."""

import atexit
import time

from . import _core

#: What `_core.end` says.
_NOTHING, _WORKS, _WRITES = 0, 1, 2
#: Seconds that are left to jobs.
_PATIENCE = {_WORKS: 0.1, _WRITES: 5.0}


@atexit.register
def _end() -> None:
    """Jobs may still run: that were told to stop, or of daemon threads. They get the interpreter's
    lock no more, and memory that they use stays. Those that write have longer: they notice soon,
    and remove what is not whole."""
    begun = time.monotonic()
    while (still := _core.end()) != _NOTHING:
        if time.monotonic() - begun > _PATIENCE[still]:
            return
        time.sleep(0.01)
