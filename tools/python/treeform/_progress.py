"""Progress callbacks, and progress bars of tqdm."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union


#: Called repeatedly with the completed share of the work, from 0 to 1, in the calling thread. If it
#: returns False, the operation stops and raises Cancelled. A progress bar of tqdm also works.
Progress = Optional[Union[Callable[[float], Any], Any]]


def part(progress: Progress, index: int, count: int) -> Progress:
    """`progress` for job `index` of `count` jobs, which are equal parts of the work."""
    if progress is None:
        return None
    call = of_bar(progress) if hasattr(progress, "update") else progress
    return lambda share: call((index + share) / count)


def of_bar(bar: Any) -> Callable[[float], None]:
    """A progress bar as a callback; jobs call this for objects with `update`."""
    total = bar.total or 1

    def update(share: float) -> None:
        bar.update(share * total - bar.n)

    return update
