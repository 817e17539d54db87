"""Meshes, and whatever can be taken for one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Protocol, Tuple, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core, _others
from ._arrays import Floats, Ids
from ._core import Attributes
from ._errors import require
from ._others import arrays_of
from ._results import Certificate, Result

if TYPE_CHECKING:
    from ._show import View

__all__ = ["Mesh", "MeshLike"]


class HasFaces(Protocol):
    """A mesh as trimesh has it; PyVista has `points` and flat `faces`, Open3D `triangles`."""

    @property
    def faces(self) -> Any: ...


class HasTriangles(Protocol):
    """A mesh as Open3D has it."""

    @property
    def triangles(self) -> Any: ...


class HasCells(Protocol):
    """A mesh as meshio has it, and grids of PyVista."""

    @property
    def cells_dict(self) -> Any: ...


class HasTensors(Protocol):
    """A mesh as `open3d.t.geometry` has it."""

    @property
    def triangle(self) -> Any: ...


class HasPolys(Protocol):
    """A mesh as VTK has it."""

    def GetPolys(self) -> Any: ...


class HasMesh(Protocol):
    """A result of treeform."""

    @property
    def mesh(self) -> "Mesh": ...


_Operator = Callable[[Any, "MeshLike"], "Mesh"]


def _operators(sign: str) -> tuple[_Operator, _Operator]:
    """`mesh sign other`, and `other sign mesh`."""
    return (lambda mesh, other: _operation(sign, mesh, other),
            lambda mesh, other: _operation(sign, other, mesh))


class Mesh:
    """A triangle mesh.

    vertices: (V, 3) numbers; float64 in one piece is not copied, else it is converted once.
    faces: (F, 3) whole numbers, the vertices of each face, counter-clockwise from outside; uint32
    in one piece is not copied. The flat [3, a, b, c, 3, ...] of PyVista and VTK will do.

    A face with a corner that is no vertex is refused by the first operation.

    A mesh does not change: its arrays cannot be written to, and the arrays that it was made of must
    stay as they are as long as it is in use. So indexes that queries build are kept, and the second
    query is fast.

    `a | b`, `a - b`, `a & b` and `a ^ b` are exact set operations on solids (see `boolean`). They
    are collected, and computed at once when the result is looked at: `(a | b) - c` is cut and
    rounded once. An operand that bounds no solid raises NotSolidError.

    >>> import numpy as np
    >>> import treeform
    >>> m = treeform.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                   [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    >>> m
    Mesh(4 vertices, 4 faces)
    >>> m.is_solid, round(m.volume, 12), m.bounds.tolist()
    (True, 0.166666666667, [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    """

    __slots__ = ("_vertices", "_faces", "_attributes", "_certificate", "_held", "_formula",
                 "_solid", "__weakref__")

    def __init__(self, vertices: ArrayLike, faces: ArrayLike = (),
                 attributes: Attributes | None = None) -> None:
        if attributes is not None and not isinstance(attributes, Attributes):
            raise ValueError(f"attributes: Attributes are needed, not {type(attributes).__name__}")
        self._formula: _Formula | None = None
        self._set(_arrays.points(vertices), _arrays.faces(faces), attributes, None)

    def _set(self, vertices: Floats, faces: Ids, attributes: Attributes | None,
             certificate: Certificate | None) -> None:
        self._vertices = vertices
        self._faces = faces
        self._attributes = attributes
        self._certificate = certificate
        self._held = _core.HeldMesh(vertices, faces, True)
        self._held.data = attributes
        self._solid: Certificate | None = None

    @classmethod
    def _of(cls, vertices: Floats, faces: Ids, attributes: Attributes | None = None,
            certificate: Certificate | None = None) -> Mesh:
        """Of arrays that the library has made."""
        made = cls.__new__(cls)
        made._formula = None
        made._set(vertices, faces, attributes, certificate)
        return made

    def _ready(self) -> Mesh:
        """Computes what operators have collected."""
        if self._formula is not None:
            made = self._formula.result().mesh
            self._set(made._vertices, made._faces, made._attributes, made._certificate)
            self._formula = None
        return self

    @property
    def vertices(self) -> Floats:
        """(V, 3) float64, not to be written to."""
        return _read_only(self._ready()._vertices)

    @property
    def faces(self) -> Ids:
        """(F, 3) uint32, not to be written to."""
        return _read_only(self._ready()._faces)

    @property
    def attributes(self) -> Attributes | None:
        """What else was in the file; None where there was none."""
        return self._ready()._attributes

    @property
    def certificate(self) -> Certificate | None:
        """What was checked about the coordinates by the operation that made them; `write` does not
        round these unless told to. None for other meshes."""
        return self._ready()._certificate

    @property
    def is_solid(self) -> bool:
        """Whether the mesh bounds a solid, as set operations need it: cut along itself, it is
        closed. It may overlap itself. Decided exactly, once. A cloud is none."""
        mesh = self._ready()
        return not mesh._is_cloud() and bool(mesh.solid_certificate)

    def _is_cloud(self) -> bool:
        return len(self._faces) == 0 and len(self._vertices) != 0

    @property
    def solid_certificate(self) -> Certificate:
        """Why it bounds a solid or not. Raises ValueError for a cloud."""
        mesh = self._ready()
        if mesh._solid is None:
            mesh._solid = _core.check_solid(mesh._held)
        return mesh._solid

    @property
    def volume(self) -> float:
        """The volume inside, negative where the mesh is inside out; in cubic units. Of an open
        mesh, the sum over its faces of tetrahedra from the origin."""
        return _core.signed_volume(self._ready()._held)

    @property
    def area(self) -> float:
        """The area of all faces, in square units."""
        return _core.surface_area(self._ready()._held)

    @property
    def bounds(self) -> Floats | None:
        """(2, 3): the lowest and highest coordinates of finite vertices; None where there are
        none."""
        return _core.bounds(self._ready()._held)

    def show(self, *others: MeshLike, **look: Any) -> View:
        """A view of the mesh, and others, for a notebook or a page: see `show`, which takes the
        same arguments."""
        from ._show import show

        return show(self, *others, **look)

    to_trimesh = _others.to_trimesh
    to_open3d = _others.to_open3d
    to_pyvista = _others.to_pyvista
    to_vtk = _others.to_vtk
    to_meshio = _others.to_meshio

    __or__, __ror__ = _operators("|")
    __and__, __rand__ = _operators("&")
    __sub__, __rsub__ = _operators("-")
    __xor__, __rxor__ = _operators("^")

    #: NumPy leaves `array - mesh` to the mesh.
    __array_ufunc__ = None

    def __iter__(self) -> Iterator[NDArray[Any]]:
        """`vertices, faces = mesh`"""
        yield self.vertices
        yield self.faces

    def __reduce__(self) -> Any:
        mesh = self._ready()
        return Mesh._of, (mesh._vertices, mesh._faces, mesh._attributes, mesh._certificate)

    def __copy__(self) -> Mesh:
        return self

    def __repr__(self) -> str:
        if self._formula is not None:
            return f"Mesh(of {len(self._formula.operands())} meshes, not computed yet)"
        return f"Mesh({len(self._vertices):,} vertices, {len(self._faces):,} faces)"


MeshLike = Union[Mesh, HasMesh, HasFaces, HasTriangles, HasCells, HasTensors, HasPolys,
                 Tuple[ArrayLike, ArrayLike]]
#: A mesh, or a cloud (n, 3).
Body = Union[MeshLike, ArrayLike]


_Array = TypeVar("_Array", Floats, Ids)


def _read_only(array: _Array) -> _Array:
    """The same memory, through a buffer that NumPy cannot be told to write to."""
    memory: Any = array
    locked: Any = memoryview(memory).toreadonly()
    return np.asarray(locked)


def listed(meshes: Any) -> tuple[Any, ...] | None:
    """What is in a list of meshes, or in anything else that can be gone through; None for what is
    no list, but a mesh."""
    if not isinstance(meshes, Iterable) or isinstance(meshes, (str, bytes)) or any(
            hasattr(meshes, name) for name in ("mesh", "vertices", "points", "__array__")):
        return None
    several = tuple(meshes)
    is_pair = len(several) == 2 and isinstance(several[0], np.ndarray)
    return None if is_pair or _arrays.is_pair(several) else several


def as_mesh(mesh: Any) -> Mesh:
    """`mesh` as a Mesh."""
    made = getattr(mesh, "mesh", mesh)
    if isinstance(made, Mesh):
        return made._ready()
    return Mesh(*arrays_of(mesh))


def held(mesh: Any) -> _core.HeldMesh:
    """`mesh` as operations take it. A Mesh keeps what they index; other things do not."""
    made = mesh if type(mesh) is Mesh else getattr(mesh, "mesh", mesh)
    if isinstance(made, Mesh):
        return made._ready()._held
    vertices, faces = arrays_of(mesh)
    return _core.HeldMesh(_arrays.points(vertices), _arrays.faces(faces), False)


def cloud_of(body: Any) -> Floats | None:
    """The points of an array of points, or of what has `points` or `vertices` and no faces; None
    for a mesh."""
    if isinstance(body, np.ndarray) or isinstance(body,
                                                  (list, tuple)) and not _arrays.is_pair(body):
        return _arrays.points(body, "points")
    if any(hasattr(body, name) for name in ("mesh", "faces", "triangles", "cells_dict", "triangle",
                                          "GetPolys")):
        return None
    if hasattr(body, "point"):  # of open3d.t.geometry
        return _arrays.points(np.asarray(body.point["positions"].cpu().numpy()), "points")
    for name in ("points", "vertices"):
        if hasattr(body, name):
            return _arrays.points(np.asarray(getattr(body, name)), "points")
    return None


def held_body(body: Any) -> _core.HeldMesh:
    """The same for a mesh or a cloud."""
    points = cloud_of(body)
    return held(body) if points is None else _core.HeldMesh(points)


def bodies(fixed: Any) -> list[_core.HeldMesh]:
    """One body, or a list of them."""
    if fixed is None:
        return []
    if isinstance(fixed, (list, tuple)) and not _arrays.is_pair(fixed):
        return [held_body(one) for one in fixed]
    return [held_body(fixed)]


def points_of(body: Body) -> Floats:
    """Those of a cloud, or the vertices of a mesh."""
    points = cloud_of(body)
    return as_mesh(body).vertices if points is None else points


class _Formula:
    """What operators have collected: an operation on two sides, each a mesh or such a thing."""

    __slots__ = ("sign", "left", "right", "size")

    #: More operations than this are computed before others are added.
    MOST = 4096

    def __init__(self, sign: str, left: Mesh, right: Mesh) -> None:
        self.sign = sign
        self.left: Mesh | _Formula = left._formula or left
        self.right: Mesh | _Formula = right._formula or right
        self.size: int = 1 + sum(side.size for side in (self.left, self.right)
                            if isinstance(side, _Formula))

    def _in_order(self) -> Iterator[Mesh | str]:
        """Brackets, signs and meshes from left to right, however deep they are."""
        rest: list[Mesh | _Formula | str] = [self]
        while rest:
            one = rest.pop()
            if isinstance(one, _Formula):
                rest += [")", one.right, one.sign, one.left, "("]
            else:
                yield one

    def operands(self) -> list[Mesh]:
        """Each mesh once."""
        return list({id(one): one for one in self._in_order() if isinstance(one, Mesh)}.values())

    def result(self) -> Any:
        """What it comes to."""
        from ._booleans import boolean

        operands = self.operands()
        names = {id(one): f"m{i}" for i, one in enumerate(operands)}
        text = "".join(one if isinstance(one, str) else names[id(one)]
                       for one in self._in_order())
        named: Any = {names[id(one)]: one for one in operands}
        return boolean(text, **named)


def _operation(sign: str, left: Any, right: Any) -> Mesh:
    sides = []
    for side in (left, right):
        mesh = getattr(side, "mesh", side)
        try:
            mesh = mesh if isinstance(mesh, Mesh) else Mesh(*arrays_of(side))
        except ValueError:
            if not isinstance(side, (tuple, list)) and not hasattr(side, "faces"):
                return NotImplemented
            raise
        if mesh._formula is None:
            require(mesh.solid_certificate)
        elif mesh._formula.size > _Formula.MOST:
            mesh._ready()
        sides.append(mesh)
    made = Mesh.__new__(Mesh)
    made._formula = _Formula(sign, sides[0], sides[1])
    return made


class MeshResult(Result):
    """A result with a mesh; it stands wherever a mesh is asked for."""

    mesh: Mesh

    @property
    def vertices(self) -> Floats:
        """(V, 3) float64, of the mesh."""
        return self.mesh.vertices

    @property
    def faces(self) -> Ids:
        """(F, 3) uint32, of the mesh."""
        return self.mesh.faces
