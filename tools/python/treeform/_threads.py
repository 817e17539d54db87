"""The number of threads that operations use."""

from __future__ import annotations

from . import _arrays, _core

__all__ = ["thread_count", "threads"]


class threads:
    """A context in which operations use at most this many threads; 0: one for each core. It affects
    the whole process. Results do not depend on it.

    >>> import treeform
    >>> with treeform.threads(1):
    ...     treeform.thread_count()
    1
    """

    def __init__(self, most: int) -> None:
        self._most = _arrays.whole(most, "most")
        self._scope: _core.Threads | None = None

    def __enter__(self) -> threads:
        self._scope = _core.Threads(self._most)
        return self

    def __exit__(self, *_: object) -> None:
        self._scope = None  # its destructor restores the limit


def thread_count() -> int:
    """The number of threads that operations use at present.

    >>> import treeform
    >>> treeform.thread_count() >= 1
    True
    """
    return _core.thread_count()
