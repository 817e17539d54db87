"""What a mesh has besides vertices and faces."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._arrays import Ids

__all__ = ["Attributes"]


class Attributes:
    """All that a file has besides points and faces.

    Columns of numbers for vertices and faces (colors, normals, qualities), names of parts, texture
    coordinates and normals of corners, comments, and the format that the file had. `write` puts
    back what the format of the output can hold. What operations make of a mesh has its columns,
    corners and parts, too; lists and other kinds of rows are left out.

    >>> import numpy as np
    >>> import treeform
    >>> extra = treeform.Attributes()
    >>> extra.set_vertex("quality", np.array([0.5, 1.0, 2.0]))
    >>> extra.vertex
    {'quality': array([0.5, 1. , 2. ])}
    """

    __slots__ = ("_data",)

    def __init__(self, data: _core.FileData | None = None) -> None:
        self._data = _core.FileData() if data is None else data

    def __reduce__(self) -> Any:
        return Attributes, (self._data,)

    def __copy__(self) -> Attributes:
        return Attributes(_core.FileData(self._data))

    @property
    def format(self) -> str:
        """Of the file that was read: 'stl-binary', 'ply-ascii', 'obj', ...; else empty."""
        return self._data.format

    @property
    def precision(self) -> str:
        """Of the coordinates in the file: 'float32' or 'float64'."""
        return self._data.precision

    @property
    def warnings(self) -> list[tuple[str, str]]:
        """What a person should know of the file: (code, text)."""
        return self._data.warnings

    @property
    def comments(self) -> list[str]:
        """Lines of comment of a PLY."""
        return self._data.comments

    @property
    def elements(self) -> list[str]:
        """Kinds of rows that the file has: 'vertex', 'face', ..."""
        return self._data.elements

    @property
    def parts(self) -> list[tuple[str, str, str, int]]:
        """Names in the file: (object, group, material, first face)."""
        return self._data.parts

    @property
    def corners(self) -> dict[str, NDArray[Any]]:
        """Values of corners: `texture` (n, 3), `texture_of_corner` (F, 3) numbers in it, and the
        same for `normals`; 4294967295 where a corner has none."""
        return self._data.corners

    @property
    def stored_face(self) -> Ids | None:
        """(F,) the file's face that each triangle is a part of; None where all are triangles."""
        return self._data.stored_face

    @property
    def vertex(self) -> dict[str, Any]:
        """A copy of each column of vertices, (V,)."""
        return self._data.columns("vertex")

    @property
    def face(self) -> dict[str, Any]:
        """A copy of each column of faces as stored in the file."""
        return self._data.columns("face")

    def columns(self, element: str) -> dict[str, Any]:
        """A copy of each column of `element`; lists as (begin, values)."""
        return self._data.columns(element)

    def set_vertex(self, name: str, values: ArrayLike) -> None:
        """Sets a column of vertices, (V,), in the type of `values`."""
        self._data.set_column("vertex", name, np.asarray(values))

    def set_face(self, name: str, values: ArrayLike) -> None:
        """Sets a column of faces, (F,), in the type of `values`."""
        self._data.set_column("face", name, np.asarray(values))

    def __repr__(self) -> str:
        rows = {name: list(self.columns(name)) for name in self.elements}
        return f"Attributes(format={self.format!r}, columns={rows})"
