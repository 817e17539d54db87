"""Converts arguments to what the library takes, without copying arrays that already fit. Arguments
that do not fit raise a ValueError that begins with their name."""

from __future__ import annotations

import operator
import os
from collections import UserDict
from typing import Any, Callable, Mapping, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["NONE"]

Floats = NDArray[np.float64]
Ids = NDArray[np.uint32]
_Array = TypeVar("_Array", bound=NDArray[Any])
_Value = TypeVar("_Value")

_FLOAT64, _UINT32 = np.dtype(np.float64), np.dtype(np.uint32)
_IDENTITY = np.eye(4)

#: Stands for no element in arrays of numbers of elements.
NONE = 0xFFFFFFFF


class ColumnDict(UserDict[str, Any]):
    """The columns of `Attributes` by name. Assigning a column sets it there, too."""

    def __init__(self, columns: dict[str, Any],
                 put: Callable[[str, Any], None] = lambda name, values: None) -> None:
        self.data, self._put = columns, put

    def __setitem__(self, name: str, values: ArrayLike) -> None:
        self._put(name, values)
        self.data[name] = np.array(values)
        self.data[name].setflags(write=False)

    def __delitem__(self, name: str) -> None:
        raise TypeError("columns cannot be removed; `write` leaves out those in `drop`")


# ---- numbers, strings, lists ----

def expect(fits: bool, value: _Value, name: str, what: str) -> _Value:
    """`value`, if it fits."""
    if not fits:
        raise ValueError(f"{name}: expected {what}, not {value!r}")
    return value


def number(value: Any, name: str) -> float:
    """`value` as a float."""
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)
    except (TypeError, ValueError, OverflowError):
        pass
    raise ValueError(f"{name}: expected a number, not {value!r}")


def whole(value: Any, name: str) -> int:
    """`value` as an integer that is not negative and fits 64 bits."""
    try:
        if 0 <= (index := operator.index(value)) < 2**64:
            return index
    except TypeError:
        pass
    raise ValueError(f"{name}: expected a non-negative integer, not {value!r}")


def flag(value: Any, name: str) -> bool:
    """`value` as a bool."""
    return bool(expect(isinstance(value, (int, np.bool_)), value, name, "True or False"))


def word(value: Any, name: str) -> str:
    """`value`, a string."""
    return str(expect(isinstance(value, str), value, name, "a string"))


def one_of(value: Any, name: str, words: tuple[str, ...] | list[str]) -> str:
    """`value`, one of these strings."""
    fits = isinstance(value, str) and value in words
    return str(expect(fits, value, name, "one of " + ", ".join(words)))


def several(values: Any, name: str) -> list[Any]:
    """`values` as a list."""
    if isinstance(values, Mapping):
        raise ValueError(f"{name}: expected a sequence, not a dict: pass a list of its values")
    try:
        return list(values)
    except TypeError:
        raise ValueError(f"{name}: expected a sequence, not {values!r}") from None


def words(values: Any, name: str) -> list[str]:
    """`values` as a list of strings."""
    return [word(one, name) for one in several(values, name)]


def conditions(same: Mapping[str, float] | None, name: str) -> list[tuple[str, float]]:
    """A dict of numbers as pairs."""
    expect(same is None or isinstance(same, Mapping), same, name, "a dict")
    return [(word(key, name), number(within, f"{name}[{key!r}]"))
            for key, within in (same or {}).items()]


def columns_of(columns: Mapping[str, str | int] | None, name: str) -> list[tuple[str, str]]:
    """A dict of names of columns as pairs (new name, name in the file); `rename` is the reverse."""
    pairs = [(a, str(b)) for a, b in (columns or {}).items()]
    return [(b, a) for a, b in pairs] if name == "rename" else pairs


def path_of(path: str | os.PathLike[str], name: str = "path") -> str:
    """`path` as a string."""
    text = os.fspath(path)
    return expect("\0" not in text, text, name, "a path without null characters")


def paths(values: Any, name: str) -> list[str]:
    """One path or several, as a list."""
    one = isinstance(values, (str, os.PathLike))
    return [path_of(path, name) for path in ([values] if one else several(values, name))]


# ---- arrays ----

def _array(values: ArrayLike, name: str) -> NDArray[Any]:
    try:
        return np.asarray(values)
    except (ValueError, OverflowError) as error:
        raise ValueError(f"{name}: not an array: {str(error).split('. ')[0]}") from None


def _fits(array: NDArray[Any], dtype: np.dtype[Any]) -> bool:
    return array.dtype == dtype and array.flags.c_contiguous and array.flags.aligned


def floats(values: ArrayLike, name: str) -> Floats:
    """`values` as a contiguous array of float64."""
    array = values if type(values) is np.ndarray else _array(values, name)
    if _fits(array, _FLOAT64):
        return array
    if array.size == 0 and array.dtype.kind == "O":
        return np.zeros(array.shape)
    if array.dtype.kind not in "fiu":
        raise ValueError(f"{name}: expected numbers, not {array.dtype}")
    return np.require(array, np.float64, ["C", "A"])


def shaped(array: _Array, fits: bool, name: str, wanted: str) -> _Array:
    """`array`, if its shape fits."""
    if not fits:
        raise ValueError(f"{name}: the shape is {array.shape}, not {wanted}")
    return array


def rows(values: ArrayLike, width: int, name: str) -> Floats:
    """`values` as float64 of shape (n, width)."""
    array = floats(values, name)
    fits = array.ndim == 2 and array.shape[1] == width
    if array.size == 0 and not fits:
        return np.empty((0, width))
    one = f": a single one is [{name}]" if array.shape == (width,) else (
        f": reshape(-1, {width})" if array.ndim == 1 and array.size % width == 0 else "")
    return shaped(array, fits, name, f"(n, {width}){one}")


def points(values: ArrayLike, name: str = "vertices") -> Floats:
    """`values` as points, (n, 3)."""
    if name != "vertices" and hasattr(values, "faces"):
        raise ValueError(f"{name}: got a mesh; if a mesh is taken too, the order is (mesh, {name})")
    return rows(values, 3, name)


def vector(values: ArrayLike, name: str) -> Floats:
    """`values` as three numbers."""
    array = floats(values, name)
    return shaped(array, array.shape == (3,), name, "(3,)")


def pair(values: Any, name: str) -> Floats:
    """`values` as two numbers."""
    array = floats(values, name)
    expect(array.shape == (2,), values, name, "a pair of numbers")
    return array


def matrix(values: ArrayLike | None, name: str) -> Floats:
    """`values` as an affine transform, (4, 4); None is the identity."""
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
    """`values` as a contiguous array of uint32."""
    array = values if type(values) is np.ndarray else _array(values, name)
    if _fits(array, _UINT32):
        return array
    if array.size == 0:
        return np.empty(array.shape, np.uint32)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name}: expected integers, not {array.dtype}")
    wrong = (array < 0) | (array >= NONE) if array.dtype.itemsize > 2 else array < 0
    if wrong.any():
        at = tuple(int(i) for i in np.argwhere(wrong)[0])
        place = at[0] if len(at) == 1 else at
        raise ValueError(f"{name}: {array[at]} at {place} is not the number of an element")
    return np.require(array, np.uint32, ["C", "A"])


def labels(values: ArrayLike | None, name: str) -> Ids:
    """`values` as numbers (n,); None is an empty array."""
    array = ids(() if values is None else values, name)
    return shaped(array, array.ndim == 1, name, "(n,)")


def faces(values: ArrayLike, name: str = "faces") -> Ids:
    """`values` as faces: (n, 3), or the flat [3, a, b, c, 4, ...] of PyVista and VTK."""
    array = ids(values, name)
    if array.size == 0:
        return np.empty((0, 3), np.uint32)
    if array.ndim == 1:
        return _flat_faces(array, name)
    return shaped(array, array.ndim == 2 and array.shape[1] == 3, name, "(n, 3)")


def triangles_of(corners: Ids, begin: NDArray[Any], sizes: NDArray[Any], name: str) -> Ids:
    """The triangles of faces that have `sizes[f]` corners from `corners[begin[f]]` on. Quads are
    cut along the diagonal from their first corner."""
    wrong = np.flatnonzero((sizes < 3) | (sizes > 4))
    if wrong.size:
        raise ValueError(f"{name}: face {wrong[0]} has {sizes[wrong[0]]} corners, but only "
                         "triangles and quads are supported: triangulate the mesh first")
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    first = np.asarray(begin)[face]
    step = np.zeros(len(face), np.int64)
    step[1:] = face[1:] == face[:-1]
    return np.stack([corners[first], corners[first + 1 + step], corners[first + 2 + step]], axis=1)


def _flat_faces(array: Ids, name: str) -> Ids:
    for size in (3, 4):  # the fast case: all faces have the same size
        if array.size % (size + 1) == 0 and (array[::size + 1] == size).all():
            begin = np.arange(0, array.size, size + 1) + 1
            return triangles_of(array, begin, np.full(len(begin), size), name)
    begins, at = [], 0
    sizes = array.tolist()
    while at < len(sizes):
        begins.append(at + 1)
        at += 1 + sizes[at]
    if at != len(sizes):
        raise ValueError(f"{name}: {array.size} numbers are not of the form [3, a, b, c, 3, ...]")
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
