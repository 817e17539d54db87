"""Work that several processes share in a folder: step by step, or with a communicator."""

from __future__ import annotations

import threading
from functools import partial
from typing import TYPE_CHECKING, Any, Callable, Generic, Iterable, Mapping, Protocol, TypeVar

from . import _arrays
from ._errors import Cancelled, Error
from ._progress import Progress

if TYPE_CHECKING:
    from typing_extensions import Self

    from . import _core


class Communicator(Protocol):
    """Processes that work together, such as `mpi4py.MPI.COMM_WORLD`."""

    @property
    def rank(self) -> int: ...
    @property
    def size(self) -> int: ...

    def allgather(self, sent: Any, /) -> list[Any]:
        """The messages of all processes, in the order of their ranks."""
        ...


_Made = TypeVar("_Made")


class _Members:
    """A communicator that reports the failure of a rank to all others at their next collective
    call."""

    def __init__(self, communicator: Communicator) -> None:
        self.rank, self.size = communicator.rank, communicator.size
        self._all = communicator.allgather
        self._failed = False
        self._ended = threading.Event()
        self._ended.set()

    def exchange(self, sent: bytes) -> list[bytes]:
        if self._failed:
            raise Error("interrupted")
        received = self._all((sent, None))
        for rank, (_, fault) in enumerate(received):
            if fault is not None:
                self._failed = True
                raise Error(f"process {rank}: {fault}")
        return [bytes_of for bytes_of, _ in received]

    def begin(self) -> None:
        """Called before work that may exchange messages."""
        self._ended.clear()

    def end(self) -> None:
        self._ended.set()

    def fail(self, fault: str) -> None:
        self._ended.wait()
        if not self._failed:
            self._failed = True
            self._all((b"", fault))


def in_communicator(communicator: Communicator | None,
                    work: Callable[[_Members | None], _Made]) -> _Made:
    """What `work(members)` returns, once all ranks have finished. If one fails, all fail."""
    if communicator is None:
        return work(None)
    if not all(hasattr(communicator, name) for name in ("rank", "size", "allgather")):
        raise ValueError(f"communicator: {communicator!r} has no rank, size and allgather")
    members = _Members(communicator)
    try:
        made = work(members)
    except (Cancelled, KeyboardInterrupt):
        members.fail("interrupted")
        raise
    except Exception as fault:
        members.fail(str(fault) or type(fault).__name__)
        raise
    members.exchange(b"")
    return made


_Work = TypeVar("_Work", bound="_core.SearchInSteps | _core.WeldInSteps")


def _list_of(value: Any) -> Any:
    """A list for an iterable, which may not be picklable."""
    is_one = isinstance(value, (str, Mapping)) or not isinstance(value, Iterable)
    return value if is_one else list(value)


class InSteps(Generic[_Work]):
    """Work in steps in a folder, which is locked until `close`. Pickled as its arguments."""

    def __init__(self, arguments: dict[str, Any]) -> None:
        """arguments: the local names of the constructor."""
        self._made_of = {name: _list_of(value) for name, value in arguments.items()
                         if name not in ("self", "__class__", "progress")}
        self._work = self._begin(self._made_of, arguments["progress"])

    def _begin(self, given: dict[str, Any], progress: Progress) -> _Work:
        raise NotImplementedError

    def scatter(self, *, progress: Progress = None) -> int:
        """Distributes the input to tiles, unless already done. Returns the number of tiles."""
        return self._work.scatter(progress=progress)

    def _do_tile(self, tile: int, progress: Progress) -> None:
        self._work.do_tile(_arrays.whole(tile, "tile"), progress=progress)

    @property
    def tiles(self) -> int:
        """The number of tiles, after `scatter`."""
        return self._work.tiles()

    @property
    def unfinished(self) -> list[int]:
        """The tiles that are not finished, after `scatter`."""
        return self._work.unfinished()

    def remove_folder(self) -> None:
        """Removes the folder with the tiles."""
        self._work.remove_folder()

    def close(self) -> None:
        """Unlocks the folder."""
        self._work.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), **self._made_of), ()
