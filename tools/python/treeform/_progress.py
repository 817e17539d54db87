"""Progress: a function of the share that is done, or a bar of tqdm."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union


#: Called now and then with the share of the work that is done, 0 to 1, in the thread that called.
#: Where it returns False, the operation stops and raises Cancelled. A bar of tqdm will do as well.
Progress = Optional[Union[Callable[[float], Any], Any]]


def part(progress: Progress, index: int, count: int) -> Progress:
    """`progress` for one of `count` jobs that are a piece of the work each."""
    if progress is None:
        return None
    call = of_bar(progress) if hasattr(progress, "update") else progress
    return lambda share: call((index + share) / count)


def of_bar(bar: Any) -> Callable[[float], None]:
    """A bar of tqdm as a function; jobs take it for what has `update`."""
    total = bar.total or 1

    def update(share: float) -> None:
        bar.update(share * total - bar.n)

    return update
