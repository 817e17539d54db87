"""How many cores are used."""

from __future__ import annotations

from types import TracebackType

from . import _arrays, _core

__all__ = ["thread_count", "threads"]


class threads:
    """As long as it is entered, operations of the whole process use at most so many threads; 0 is
    all. Answers do not depend on it.

    >>> import treeform
    >>> with treeform.threads(1):
    ...     treeform.thread_count()
    1
    """

    def __init__(self, most: int) -> None:
        self._scope = _core.Threads(_arrays.number(most, "most", 0))

    def __enter__(self) -> threads:
        self._scope.enter()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        self._scope.exit()


def thread_count() -> int:
    """Number of threads that an operation may use now.

    >>> import treeform
    >>> treeform.thread_count() >= 1
    True
    """
    return _core.thread_count()
