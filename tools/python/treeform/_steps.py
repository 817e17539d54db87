"""Work that many processes do in a folder that they share: step by step, or with a communicator."""

from __future__ import annotations

import threading
from functools import partial
from typing import TYPE_CHECKING, Any, Callable, Generic, Protocol, TypeVar

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
        """What each of them tells, in the order of the ranks."""
        ...


_Made = TypeVar("_Made")


class _Members:
    """A communicator whose ranks learn at the next collective call that one has failed."""

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
        """This one is at work, and may send."""
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
    """`work(members)`: what it returns, once all have come so far; where one fails, all do."""
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


class InSteps(Generic[_Work]):
    """Has a hold on the folder until it is closed; pickled as its arguments."""

    def __init__(self, work: _Work, arguments: dict[str, Any]) -> None:
        """arguments: those that it was made with, and other local names."""
        self._work = work
        self._made_of = {name: value for name, value in arguments.items()
                         if name not in ("self", "__class__", "how", "work", "progress")}

    def scatter(self, *, progress: Progress = None) -> int:
        """Fills the tiles, unless that is done. Returns how many there are."""
        return self._work.scatter(progress=progress)

    def _do_tile(self, tile: int, progress: Progress) -> None:
        self._work.do_tile(_arrays.number(tile, "tile", 0), progress=progress)

    @property
    def tiles(self) -> int:
        """The number of tiles, once they are there."""
        return self._work.tiles()

    def remove_folder(self) -> None:
        """Removes the folder of the tiles."""
        self._work.remove_folder()

    def close(self) -> None:
        """Lets go of the folder."""
        self._work.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), **self._made_of), ()
