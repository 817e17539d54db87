"""What is done at the end of the process."""

import atexit
import time

from . import _core


@atexit.register
def _end() -> None:
    """Jobs may still run: that were told to stop, or of daemon threads. They use memory that the end
    of the process frees, and then want the interpreter's lock."""
    while not _core.end():
        time.sleep(0.01)
