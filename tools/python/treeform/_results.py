"""Base classes of results, and certificates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._arrays import Floats, Ids

__all__ = ["Certificate"]


def brief(value: Any) -> str:
    """A short text for `value`; for arrays, their type and shape."""
    if isinstance(value, np.ndarray):
        if value.size <= 4 and value.ndim == 1:
            return repr(value.tolist())
        return f"{value.dtype}[{', '.join(map(str, value.shape))}]"
    if isinstance(value, dict):
        there = {key: item for key, item in value.items()
                 if item is not None and (not np.isscalar(item) or item)}
        return "{" + ", ".join(f"{key!r}: {brief(item)}" for key, item in there.items()) + "}"
    if isinstance(value, (list, tuple)) and len(value) > 4 and not hasattr(value, "_fields"):
        return f"[{len(value)} of {type(value[0]).__name__}]"
    if isinstance(value, float):
        return f"{value:.9g}"
    return repr(value)


class Result:
    """A result with fields that cannot be changed, and a short `repr`."""

    def __repr__(self) -> str:
        fields = self.__dict__.items()
        return f"{type(self).__name__}({', '.join(f'{name}={brief(v)}' for name, v in fields)})"


# made of headers:
#   Certificate
@dataclass(frozen=True, repr=False)
class Certificate(Result):
    """The outcome of checking the coordinates of a result with exact predicates. True if all
    guarantees of the operation hold.

    status: 'ok', or why the result is not certified.
    meeting_count: Number of pairs of faces that meet where they should not.
    meeting: (n, 2) the first 100 pairs of faces that meet.
    open_count: Number of edges whose signed face count is not zero.
    open_edges: (n, 2, 3) the ends of the first 100 of these edges.
    open_faces: (n, 2) the operand and its face at each of these edges; 2**32 - 1 for the only
        operand.
    boundary_edges: Number of open edges with an odd number of faces.
    misoriented_edges: Number of open edges whose faces are inconsistently oriented.
    max_displacement: The largest change of a coordinate by rounding, from the exact position of the
        vertex; for vertices added or removed to repair what rounding did, from the nearest point of
        the exact surface. Measured on the result: intermediate moves do not add up.
    precision: Of the coordinates: 'float32' or 'float64'.
    vanished_faces: For status `vanished`: number of faces of the exact result, all too thin for the
        coordinates; 0 if it had no faces.
    size_before: For status `excessive_loss`: the volume before the operation, or the area if there
        is no solid.
    size_after: The same after the operation.
    size_is_volume: Whether these are volumes, not areas.
    message: The outcome as a clause for people, without a full stop.
    """

    status: str
    meeting_count: int
    meeting: Ids
    open_count: int
    open_edges: Floats
    open_faces: Ids
    boundary_edges: int
    misoriented_edges: int
    max_displacement: float
    precision: str
    vanished_faces: int
    size_before: float
    size_after: float
    size_is_volume: bool
    message: str
# end

    def __bool__(self) -> bool:
        return self.status == "ok"

    def __repr__(self) -> str:
        return f"Certificate({self.status}{'' if self else f': {self.message}'})"

    def __str__(self) -> str:
        return self.message


def tuple_repr(self: Any) -> str:
    """`repr` of results that are named tuples."""
    fields = zip(self._fields, self)
    return f"{type(self).__name__}({', '.join(f'{name}={brief(v)}' for name, v in fields)})"
