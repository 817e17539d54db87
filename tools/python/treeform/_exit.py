"""What is done at the end of the process."""

import atexit
import time

from . import _core


@atexit.register
def _wait_for_jobs() -> None:
    """Jobs that were told to stop may still run, and use memory that the end of the process frees."""
    while _core.is_busy():
        time.sleep(0.01)
