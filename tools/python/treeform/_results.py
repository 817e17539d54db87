"""How results look."""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["Result", "brief", "tuple_repr"]


def brief(value: Any) -> str:
    """`value` in a few words: of arrays, the type and shape."""
    if isinstance(value, np.ndarray):
        if value.size <= 4 and value.ndim == 1:
            return repr(value.tolist())
        return f"{value.dtype}[{', '.join(map(str, value.shape))}]"
    if isinstance(value, dict):
        there = {key: item for key, item in value.items() if not _is_nothing(item)}
        return "{" + ", ".join(f"{key!r}: {brief(item)}" for key, item in there.items()) + "}"
    if isinstance(value, (list, tuple)) and len(value) > 4:
        return f"[{len(value)} of {type(value[0]).__name__}]"
    if isinstance(value, float):
        return f"{value:.9g}"
    return repr(value)


def _is_nothing(value: Any) -> bool:
    return value is None or (np.isscalar(value) and not value)


class Result:
    """A result whose fields cannot be changed; `repr` says what is in it."""

    def __repr__(self) -> str:
        fields = self.__dict__.items()
        return f"{type(self).__name__}({', '.join(f'{name}={brief(v)}' for name, v in fields)})"


def tuple_repr(self: Any) -> str:
    """`repr` for results that are tuples."""
    fields = zip(self._fields, self)
    return f"{type(self).__name__}({', '.join(f'{name}={brief(v)}' for name, v in fields)})"
