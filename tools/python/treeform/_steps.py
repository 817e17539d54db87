"""Work that many processes do, step by step, in a folder that they share."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeVar

if TYPE_CHECKING:
    from typing_extensions import Self


class _Closable(Protocol):
    def close(self) -> None: ...


_Work = TypeVar("_Work", bound=_Closable)


class InSteps(Generic[_Work]):
    """Has a hold on the folder until it is closed; pickled as its arguments."""

    def __init__(self, work: _Work, *arguments: Any, **named: Any) -> None:
        self._work = work
        self._made_of = (arguments, named)

    def close(self) -> None:
        """Lets go of the folder."""
        self._work.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __reduce__(self) -> tuple[Any, ...]:
        arguments, named = self._made_of
        return partial(type(self), **named), arguments
