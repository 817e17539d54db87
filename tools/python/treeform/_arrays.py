"""Arrays as they come, made into those that the library takes. What fits is not copied."""

from __future__ import annotations

import os
from typing import Any, Mapping, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["NONE"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint32]
_Array = TypeVar("_Array", bound=NDArray[Any])

_FLOAT64 = np.dtype(np.float64)
_UINT32 = np.dtype(np.uint32)

#: In place of a number: there is none.
NONE = 0xFFFFFFFF


def _array(values: ArrayLike, name: str) -> NDArray[Any]:
    try:
        return np.asarray(values)
    except (ValueError, OverflowError) as error:
        raise ValueError(f"{name}: no array: {str(error).split('. ')[0]}") from None


def floats(values: ArrayLike, name: str) -> Floats:
    """`values` as float64, in one piece."""
    array = values if type(values) is np.ndarray else _array(values, name)
    if array.dtype == _FLOAT64 and array.flags.c_contiguous and array.flags.aligned:
        return array
    if array.dtype.kind not in "fiu":
        if array.size == 0 and array.dtype.kind == "O":
            return np.zeros(array.shape)
        raise ValueError(f"{name}: numbers are needed, not {array.dtype}")
    return np.require(array, np.float64, ["C", "A"])


def shaped(array: _Array, fits: bool, name: str, wanted: str) -> _Array:
    """`array`, whose shape has to fit."""
    if not fits:
        raise ValueError(f"{name}: the shape is {array.shape}, not {wanted}")
    return array


def rows(values: ArrayLike, width: int, name: str) -> Floats:
    """`values` as float64 of shape (n, width)."""
    array = floats(values, name)
    fits = array.ndim == 2 and array.shape[1] == width
    if array.size == 0 and not fits:
        return np.empty((0, width))
    return shaped(array, fits, name, f"(n, {width})")


def points(values: ArrayLike, name: str = "vertices") -> Floats:
    """`values` as points, (n, 3)."""
    return rows(values, 3, name)


def vector(values: ArrayLike, name: str) -> Floats:
    """`values` as three numbers."""
    array = floats(values, name)
    return shaped(array, array.shape == (3,), name, "(3,)")


def pair(values: Any, name: str) -> Floats:
    """`values` as two numbers."""
    array = floats(values, name)
    if array.shape != (2,):
        raise ValueError(f"{name}: a pair of numbers is needed, not {values!r}")
    return array


_IDENTITY = np.eye(4)


def matrix(values: ArrayLike | None, name: str) -> Floats:
    """`values` as an affine map, (4, 4); None is the identity."""
    if values is None:
        return _IDENTITY
    array = floats(values, name)
    if array.shape == (3, 4):
        array = np.vstack([array, [0.0, 0.0, 0.0, 1.0]])
    shaped(array, array.shape == (4, 4), name, "(4, 4)")
    if not np.array_equal(array[3], (0.0, 0.0, 0.0, 1.0)):
        raise ValueError(f"{name}: the last row is {array[3].tolist()}, not [0, 0, 0, 1]")
    return array


def ids(values: ArrayLike, name: str) -> Ids:
    """`values` as uint32, in one piece."""
    array = values if type(values) is np.ndarray else _array(values, name)
    if array.dtype == _UINT32 and array.flags.c_contiguous and array.flags.aligned:
        return array
    if array.size == 0:
        return np.empty(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: whole numbers are needed, not {array.dtype}")
    wrong = (array < 0) | (array >= NONE) if array.dtype.itemsize > 2 else array < 0
    if wrong.any():
        at = tuple(int(i) for i in np.argwhere(wrong)[0])
        place = at[0] if len(at) == 1 else at
        raise ValueError(f"{name}: {array[at]} at {place} is no number of an element")
    return np.require(array, np.uint32, ["C", "A"])


def labels(values: ArrayLike | None, name: str) -> Ids:
    """`values` as (n,) numbers; None is an empty array."""
    array = ids(() if values is None else values, name)
    return shaped(array, array.ndim == 1, name, "(n,)")


def faces(values: ArrayLike, name: str = "faces") -> Ids:
    """`values` as faces: (n, 3), or the flat [3, a, b, c, 4, ...] of PyVista and VTK."""
    array = ids(values, name)
    if array.ndim == 2 and array.shape[1] == 3:
        return array
    if array.size == 0:
        return np.empty((0, 3), np.uint32)
    if array.ndim == 1:
        return _flat_faces(array, name)
    return shaped(array, False, name, "(n, 3)")


def triangles_of(corners: Ids, begin: NDArray[Any], sizes: NDArray[Any], name: str) -> Ids:
    """Triangles of faces that have `sizes[f]` corners from `corners[begin[f]]` on: a quad is cut in
    two, along the diagonal from its first corner."""
    wrong = np.flatnonzero((sizes < 3) | (sizes > 4))
    if wrong.size:
        raise ValueError(f"{name}: face {wrong[0]} has {sizes[wrong[0]]} corners; only triangles "
                         f"and "
                         "quads are taken: triangulate first")
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    first = np.asarray(begin)[face]
    step = np.zeros(len(face), np.int64)
    step[1:] = face[1:] == face[:-1]
    return np.stack([corners[first], corners[first + 1 + step], corners[first + 2 + step]], axis=1)


def _flat_faces(array: Ids, name: str) -> Ids:
    for size in (3, 4):  # all alike
        if array.size % (size + 1) == 0 and (array[::size + 1] == size).all():
            begin = np.arange(0, array.size, size + 1) + 1
            return triangles_of(array, begin, np.full(len(begin), size), name)
    begins, at = [], 0
    sizes = array.tolist()
    while at < len(sizes):
        begins.append(at + 1)
        at += 1 + sizes[at]
    if at != len(sizes):
        raise ValueError(f"{name}: {array.size} numbers in a row are no [3, a, b, c, 3, ...]")
    begin = np.array(begins)
    return triangles_of(array, begin, array[begin - 1].astype(np.int64), name)


def _dimensions(values: Any) -> int:
    try:
        return 2 if np.size(values) == 0 else int(np.ndim(values))
    except ValueError:  # lists of different lengths
        return 0


def is_pair(values: Any) -> bool:
    """Whether `values` is (vertices, faces): two tables, or a table and flat faces."""
    if not isinstance(values, (list, tuple)) or len(values) != 2 or _dimensions(values[0]) != 2:
        return False
    return _dimensions(values[1]) in ((1, 2) if isinstance(values[1], np.ndarray) else (2,))


def number(value: Any, name: str, least: float | None = None) -> Any:
    """`value`, which has to be a number; with `least`, whole and not less."""
    if least is not None and isinstance(value, (int, np.integer)):
        if value < least:
            raise ValueError(f"{name}: {value} is less than {least}")
    elif least is not None or not isinstance(value, (int, float, np.integer, np.floating)):
        kind = "a number" if least is None else "a whole number"
        raise ValueError(f"{name}: {kind} is needed, not {value!r}")
    return value


def several(values: Any, name: str) -> list[Any]:
    """`values`, which has to be something to go through."""
    try:
        return list(values)
    except TypeError:
        raise ValueError(f"{name}: several are needed, not {values!r}") from None


def words(values: Any, name: str) -> list[str]:
    """`values`, which have to be words."""
    return [word(one, name) for one in several(values, name)]


def conditions(same: Mapping[str, float] | None, name: str) -> list[tuple[str, float]]:
    """Names, and numbers for them."""
    if same is not None and not isinstance(same, Mapping):
        raise ValueError(f"{name}: Mapping is needed, not {same!r}")
    return [(word(key, name), number(within, f"{name}[{key!r}]"))
            for key, within in (same or {}).items()]


def columns_of(columns: Mapping[str, str | int] | None, name: str) -> list[tuple[str, str]]:
    """New names of columns, and those that they had; `rename` has them the other way round."""
    pairs = [(a, str(b)) for a, b in (columns or {}).items()]
    return [(b, a) for a, b in pairs] if name == "rename" else pairs


def path_of(path: str | os.PathLike[str], name: str = "path") -> str:
    """`path` as the library takes it."""
    text = os.fspath(path)
    if "\0" in text:
        raise ValueError(f"{name}: {text!r} has a zero in it")
    return text


def paths(values: Any, name: str) -> list[str]:
    """One path, or several, but not none."""
    one = isinstance(values, (str, os.PathLike))
    all = [path_of(path, name) for path in ([values] if one else several(values, name))]
    if not all:
        raise ValueError(f"{name}: there are none")
    return all


def word(value: Any, name: str) -> str:
    """`value`, which has to be a word."""
    if not isinstance(value, str):
        raise ValueError(f"{name}: a word is needed, not {type(value).__name__}")
    return value
