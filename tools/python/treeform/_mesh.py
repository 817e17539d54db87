"""Meshes, and other objects that are accepted as meshes."""

from __future__ import annotations

from copy import copy
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
    """A mesh of trimesh or PyVista."""

    @property
    def faces(self) -> Any: ...


class HasTriangles(Protocol):
    """A mesh of Open3D."""

    @property
    def triangles(self) -> Any: ...


class HasCells(Protocol):
    """A mesh of meshio, or a grid of PyVista."""

    @property
    def cells_dict(self) -> Any: ...


class HasTensors(Protocol):
    """A mesh of `open3d.t.geometry`."""

    @property
    def triangle(self) -> Any: ...


class HasPolys(Protocol):
    """A mesh of VTK."""

    def GetPolys(self) -> Any: ...


class HasMesh(Protocol):
    """A result of treeform."""

    @property
    def mesh(self) -> "Mesh": ...


_Operator = Callable[[Any, "MeshLike"], "Mesh"]
_Take = Callable[[Any], _core.HeldMesh]


def _operators(sign: str) -> tuple[_Operator, _Operator]:
    """`mesh sign other`, and `other sign mesh`."""
    return (lambda mesh, other: _operation(sign, mesh, other),
            lambda mesh, other: _operation(sign, other, mesh))


class Mesh:
    """A triangle mesh.

    vertices: (V, 3) coordinates. A contiguous float64 array is not copied; others are converted.
    faces: (F, 3) the vertex numbers of each face, counter-clockwise from outside. A contiguous
    uint32 array is not copied. The flat [3, a, b, c, 3, ...] of PyVista and VTK is also accepted.
    attributes: an `Attributes`, copied; `mesh.attributes.vertex["q"] = values` sets a column of it.

    Faces with a vertex number that is out of range are reported by the first operation.

    A mesh is immutable: its arrays are read-only, and the arrays that it was made from must not be
    changed while it is in use. It keeps the indexes that queries build, so later queries are fast.

    `a | b`, `a - b`, `a & b` and `a ^ b` are exact set operations on solids (see `boolean`);
    `a + b` is `a | b`, and `a * b` is `a & b`. They are evaluated together when the result is first
    used: `(a | b) - c` is cut and rounded only once. An operand that does not bound a solid raises
    NotClosedError. For a file of floats, such as STL: `boolean("a-b", a, b, precision="float32")`.

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
                 "_operand", "_solid", "__weakref__")

    def __init__(self, vertices: ArrayLike, faces: ArrayLike = (),
                 attributes: Attributes | None = None) -> None:
        if attributes is not None:
            attributes = copy(_arrays.expect(isinstance(attributes, Attributes), attributes,
                "attributes", "Attributes (mesh.attributes.vertex['q'] = values)"))
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
        self._operand: Certificate | None = None
        self._solid: bool | None = None

    @classmethod
    def _of(cls, vertices: Floats, faces: Ids, attributes: Attributes | None = None,
            certificate: Certificate | None = None) -> Mesh:
        """A mesh with arrays that the library has made."""
        made = cls.__new__(cls)
        made._formula = None
        made._set(vertices, faces, attributes, certificate)
        return made

    def _ready(self) -> Mesh:
        """The mesh after evaluating pending set operations."""
        if self._formula is not None:
            made = self._formula.result().mesh
            self._set(made._vertices, made._faces, made._attributes, made._certificate)
            self._formula = None
        return self

    @property
    def vertices(self) -> Floats:
        """(V, 3) float64, read-only."""
        return _read_only(self._ready()._vertices)

    @property
    def faces(self) -> Ids:
        """(F, 3) uint32, read-only."""
        return _read_only(self._ready()._faces)

    @property
    def attributes(self) -> Attributes:
        """The other data of the file that it was read from; without a file, empty columns."""
        mesh = self._ready()
        mesh._attributes = mesh._held.data = mesh._attributes or Attributes()
        return mesh._attributes

    @property
    def certificate(self) -> Certificate | None:
        """What the operation that made the mesh verified about its coordinates, or None. `write`
        does not round certified coordinates unless `round` is set."""
        return self._ready()._certificate

    @property
    def is_solid(self) -> bool:
        """Whether the mesh is a solid: closed, oriented, manifold, free of self-intersections.
        `find_solid_defects` lists what is missing. Exact; computed once."""
        mesh = self._ready()
        if mesh._solid is None:
            mesh._solid = not _core.find_solid_defects(mesh._held)
        return mesh._solid

    def _as_operand(self) -> Certificate:
        """As `check_operand`; computed once."""
        mesh = self._ready()
        if mesh._operand is None:
            mesh._operand = _core.check_operand(mesh._held)
        return mesh._operand

    @property
    def volume(self) -> float:
        """The enclosed volume in cubic units, negative if the mesh is inside out. For an open mesh,
        the sum of the signed volumes of tetrahedra from the origin to each face."""
        return _core.signed_volume(self._ready()._held)

    @property
    def area(self) -> float:
        """The total area of the faces, in square units."""
        return _core.surface_area(self._ready()._held)

    @property
    def bounds(self) -> Floats | None:
        """(2, 3) the lowest and highest coordinates of the finite vertices; None without any."""
        return _core.bounds(self._ready()._held)

    @classmethod
    def box(cls, low: ArrayLike, high: ArrayLike) -> Mesh:
        """The box between two corners, as a solid of 8 vertices and 12 faces.

        >>> import treeform
        >>> treeform.Mesh.box([0, 0, 0], [1, 2, 3]).volume
        6.0
        """
        return _core.box(_arrays.vector(low, "low"), _arrays.vector(high, "high"))

    def show(self, *others: MeshLike, **look: Any) -> View:
        """An interactive view of this mesh and others; the arguments are those of `show`."""
        from ._show import show

        return show(self, *others, **look)

    to_trimesh = _others.to_trimesh
    to_open3d = _others.to_open3d
    to_pyvista = _others.to_pyvista
    to_vtk = _others.to_vtk
    to_meshio = _others.to_meshio

    __or__, __ror__ = __add__, __radd__ = _operators("|")
    __and__, __rand__ = __mul__, __rmul__ = _operators("&")
    __sub__, __rsub__ = _operators("-")
    __xor__, __rxor__ = _operators("^")

    #: So that NumPy leaves `array - mesh` to the mesh.
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
MeshOrCloud = Union[MeshLike, ArrayLike]


_Array = TypeVar("_Array", Floats, Ids)


def _read_only(array: _Array) -> _Array:
    """The same memory in a read-only buffer, which NumPy cannot make writable."""
    memory: Any = array
    locked: Any = memoryview(memory).toreadonly()
    return np.asarray(locked)


def listed(meshes: Any) -> tuple[Any, ...] | None:
    """The elements of a list or another iterable of meshes; None if `meshes` is a single mesh."""
    if isinstance(meshes, dict):
        return tuple(meshes.values())
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
    """`mesh` for the extension. A Mesh keeps the indexes that operations build."""
    made = mesh if type(mesh) is Mesh else getattr(mesh, "mesh", mesh)
    if isinstance(made, Mesh):
        return made._ready()._held
    vertices, faces = arrays_of(mesh)
    return _core.HeldMesh(_arrays.points(vertices), _arrays.faces(faces), False)


def cloud_of(body: Any) -> Floats | None:
    """The points of an array, or of an object with `points` or `vertices` and no faces; None for a
    mesh."""
    if any(hasattr(body, name) for name in ("mesh", "faces", "triangles", "cells_dict", "triangle",
                                          "GetPolys")):
        return None
    if isinstance(body, np.ndarray) or isinstance(body,
                                                  (list, tuple)) and not _arrays.is_pair(body):
        first = body[0] if isinstance(body, (list, tuple)) and body else None
        _arrays.expect(not hasattr(first, "faces"), body, "mesh", "one mesh or cloud")
        return _arrays.points(body, "points")
    if hasattr(body, "point"):  # of open3d.t.geometry
        return _arrays.points(np.asarray(body.point["positions"].cpu().numpy()), "points")
    for name in ("points", "vertices"):
        if hasattr(body, name):
            return _arrays.points(np.asarray(getattr(body, name)), "points")
    return None


def held_body(body: Any) -> _core.HeldMesh:
    """A mesh or point cloud for the extension."""
    points = cloud_of(body)
    return held(body) if points is None else _core.HeldMesh(points)


def each(many: Any, name: str, take: _Take = held_body) -> list[_core.HeldMesh]:
    """Several bodies for the extension. Errors have the number of the body."""
    many = list(many.values()) if isinstance(many, dict) else many
    pair = _is_mesh(many)
    if pair or hasattr(many, "vertices") or hasattr(many, "mesh"):
        what = "(vertices, faces)" if pair else f"a {type(many).__name__}"
        raise ValueError(f"{name}: expected a list of meshes, not {what}")
    made = []
    for number, one in enumerate(_arrays.several(many, name)):
        try:
            made.append(take(one))
        except ValueError as error:
            error.args = (f"{name}[{number}]: {error}".replace(": mesh: ", ": "),)
            raise
    return made


def _is_mesh(many: Any) -> bool:
    """Whether `many` is (vertices, faces), not two clouds."""
    faces = np.asarray(many[1]) if _arrays.is_pair(many) else np.empty(0)
    return faces.dtype.kind in "iu" and 0 < faces.size and faces.max() <= max(len(many[0]), 4)


def bodies(fixed: Any) -> list[_core.HeldMesh]:
    """One body, or a list of them."""
    if fixed is None:
        return []
    if isinstance(fixed, (list, tuple)) and not (_arrays.is_pair(fixed) or hasattr(fixed, "mesh")):
        return each(fixed, "fixed")
    return [held_body(fixed)]


def points_of(body: MeshOrCloud) -> Floats:
    """The points of a cloud, or the vertices of a mesh."""
    points = cloud_of(body)
    return as_mesh(body).vertices if points is None else points


class _Formula:
    """A pending set operation on two sides, each a mesh or another pending operation."""

    __slots__ = ("sign", "left", "right", "size")

    #: Formulas with more operations are evaluated before others are added.
    MOST = 4096

    def __init__(self, sign: str, left: Mesh, right: Mesh) -> None:
        self.sign = sign
        self.left: Mesh | _Formula = left._formula or left
        self.right: Mesh | _Formula = right._formula or right
        self.size: int = 1 + sum(side.size for side in (self.left, self.right)
                            if isinstance(side, _Formula))

    def _in_order(self) -> Iterator[Mesh | str]:
        """Parentheses, operators and meshes from left to right, without recursion."""
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
        """Evaluates the formula."""
        from ._booleans import boolean

        operands = self.operands()
        names = {id(one): f"m{i}" for i, one in enumerate(operands)}
        text = "".join(one if isinstance(one, str) else names[id(one)]
                       for one in self._in_order())
        named: Any = {names[id(one)]: one for one in operands}
        return boolean(text, **named)


def _operation(sign: str, left: Any, right: Any) -> Mesh:
    sides = []
    for side, which in ((left, "left"), (right, "right")):
        mesh = getattr(side, "mesh", side)
        try:
            mesh = mesh if isinstance(mesh, Mesh) else Mesh(*arrays_of(side))
        except ValueError:
            if not isinstance(side, (tuple, list)) and not hasattr(side, "faces"):
                return NotImplemented
            raise
        if mesh._formula is None:
            require(mesh._as_operand(), of=f" of the {which} operand of {sign}")
        elif mesh._formula.size > _Formula.MOST:
            mesh._ready()
        sides.append(mesh)
    made = Mesh.__new__(Mesh)
    made._formula = _Formula(sign, sides[0], sides[1])
    return made


class MeshResult(Result):
    """A result with a mesh. It can be passed wherever a mesh is expected."""

    mesh: Mesh

    @property
    def vertices(self) -> Floats:
        """(V, 3) float64, the vertices of the mesh."""
        return self.mesh.vertices

    @property
    def faces(self) -> Ids:
        """(F, 3) uint32, the faces of the mesh."""
        return self.mesh.faces
