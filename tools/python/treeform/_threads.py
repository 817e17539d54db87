"""The number of threads that operations use."""

from __future__ import annotations

from types import TracebackType

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
        self._scope = _core.Threads(_arrays.whole(most, "most"))

    def __enter__(self) -> threads:
        self._scope.enter()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._scope.exit()


def thread_count() -> int:
    """The number of threads that operations use at present.

    >>> import treeform
    >>> treeform.thread_count() >= 1
    True
    """
    return _core.thread_count()
