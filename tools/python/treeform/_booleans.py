"""Set operations on solids."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Union

import numpy as np

from . import _arrays, _core
from ._arrays import Ids
from ._core import Certificate
from ._errors import options, require
from ._mesh import Mesh, MeshLike, MeshResult, held, listed
from ._progress import Progress

__all__ = ["BooleanResult", "MeshesLike", "boolean", "check_solid", "clip", "difference",
           "intersection", "split", "symmetric_difference", "union"]


# made of results:
#   boolean_result
@dataclass(frozen=True, repr=False)
class BooleanResult(MeshResult):
    """The surface of a solid, and what was checked about it. Every function that takes a mesh takes
    a result; `vertices, faces = result.mesh`.

    mesh: Faces are counter-clockwise from outside.
    certificate: What was checked about its coordinates.
    face_source: (F, 2) the lowest operand, and its face, that each face lies in.
    vertex_source: (V, 2) the lowest operand, and its vertex, that each vertex is; `NONE` for new
        ones.
    volumes: With `volumes`: of the first, the second, either and both.
    statistics: Counts of what was done.
    """

    mesh: Mesh
    certificate: Certificate
    face_source: Ids
    vertex_source: Ids
    volumes: tuple[float, float, float, float] | None
    statistics: dict[str, Any]
# end


def _checked(made: BooleanResult, check: bool) -> BooleanResult:
    if check:
        require(made.certificate)
    return made


#: What set operations take: a mesh, or several in whatever can be gone through.
MeshesLike = Union[MeshLike, Iterable[MeshLike]]


def _operands(meshes: Iterable[Any]) -> list[_core.HeldMesh]:
    """Those of `union(a, b, c)`, `union([a, b, c])` or `difference(a, [b, c])`."""
    all: list[_core.HeldMesh] = []
    for one in meshes:
        several = listed(one)
        all += [held(one)] if several is None else [held(mesh) for mesh in several]
    return all


def _combine(operation: str, meshes: tuple[Any, ...], arguments: dict[str, Any]) -> BooleanResult:
    how = options(_core.BooleanOptions, arguments)
    operands = _operands(meshes)
    if len(operands) == 1 and operation != "union":
        operands = _core.objects_of(operands[0]) or operands
    return _checked(_core.boolean(operands, operation, "", [], how,
                                  progress=arguments["progress"]), arguments["check"])


def union(*meshes: MeshesLike, inside: str = "nonzero", precision: str = "float64",
          keep_cuts: bool = False, simplify: bool = False, volumes: bool = False,
          max_displacement: float = np.inf, min_volume: float = 0.0, gap: float = 0.0,
          check: bool = True, progress: Progress = None) -> BooleanResult:
    """What is in any of the solids: `union(a, b, ...)`, or `union([a, b, ...])` as in trimesh. Of
    one mesh, the solid that it winds around, without self-intersections. See `boolean`.

    gap: the widest gap to fill between faces of different solids, where they lie over each other.
    Faces of what fills it, the last, have the face that they stand on, or lie opposite of, as
    `face_source`; `filled_faces` of `statistics` counts the faces at such gaps. No volumes then.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> both = treeform.union(a, (a.vertices + 0.5, a.faces))
    >>> both.mesh.volume, both.certificate
    (1.875, Certificate(ok))
    """
    return _combine("union", meshes, locals())


def intersection(*meshes: MeshesLike, inside: str = "nonzero", precision: str = "float64",
                 keep_cuts: bool = False, simplify: bool = False, volumes: bool = False,
                 max_displacement: float = np.inf, min_volume: float = 0.0, check: bool = True,
                 progress: Progress = None) -> BooleanResult:
    """What is in all of the solids. Of one mesh that a file of several objects was read to, its
    objects are the solids, as in `difference`. See `boolean`.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.intersection(a, (a.vertices + 0.5, a.faces)).mesh.volume
    0.125
    """
    return _combine("intersection", meshes, locals())


def difference(*meshes: MeshesLike, inside: str = "nonzero", precision: str = "float64",
               keep_cuts: bool = False, simplify: bool = False, volumes: bool = False,
               max_displacement: float = np.inf, min_volume: float = 0.0, check: bool = True,
               progress: Progress = None) -> BooleanResult:
    """The first solid without all others: `difference(a, b, c)`, or `difference(a, [b, c])`. See
    `boolean`.

    One mesh that a file of several objects was read to (`attributes.parts`) is the first object
    without the others, as in tf-boolean; `face_source` and `vertex_source` count in each object.
    One mesh without such objects is one solid, and nothing is taken from it.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> cutters = [(a.vertices + 0.5, a.faces), (a.vertices - 0.5, a.faces)]
    >>> treeform.difference(a, cutters).mesh.volume
    0.75
    """
    return _combine("difference", meshes, locals())


def symmetric_difference(*meshes: MeshesLike, inside: str = "nonzero", precision: str = "float64",
                         keep_cuts: bool = False, simplify: bool = False, volumes: bool = False,
                         max_displacement: float = np.inf, min_volume: float = 0.0,
                         check: bool = True, progress: Progress = None) -> BooleanResult:
    """What is in an odd number of the solids. Of one mesh that a file of several objects was read
    to, its objects are the solids, as in `difference`. See `boolean`.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.symmetric_difference(a, (a.vertices + 0.5, a.faces)).mesh.volume
    1.75
    """
    return _combine("xor", meshes, locals())


def boolean(expression: str, *, inside: str = "nonzero", precision: str = "float64",
            keep_cuts: bool = False, simplify: bool = False, volumes: bool = False,
            max_displacement: float = np.inf, min_volume: float = 0.0, check: bool = True,
            progress: Progress = None, **meshes: MeshLike) -> BooleanResult:
    """The solid that a formula makes of meshes, all cut along each other at once.

    expression: names of `meshes`, `+` or `|` union, `*` or `&` intersection, `-` difference, `^`
    exclusive or, and brackets. `*` and `&` bind tighter than the others, which go from left to
    right.
    inside: what is solid, by how often the surface winds around it: 'nonzero', 'odd', 'positive'.
    precision: of the coordinates returned; 'float32' for STL and GLB.
    keep_cuts: leave coplanar faces apart that were cut, or overlap; they are merged otherwise.
    simplify: merge all coplanar faces. volumes: compute those of two operands.
    max_displacement: where rounding makes faces meet, nothing longer is taken out at once.
    min_volume: parts of the result with less are left out, and voids with less filled;
    `small_parts` and `small_volume` of `statistics` say how many, and of what volume.
    check: raise where the result is not certified; False returns it with its certificate.

    The surface is decided exactly on the coordinates as given. Then points on cuts are rounded, and
    the rounded surface is checked: it is closed, manifold, outward, and no two faces meet but in a
    corner or an edge. Operands may overlap themselves, touch, be equal, be inside out or empty.

    Attributes of operands are carried over: a face has the values of the face that it lies in, a
    new vertex on a cut interpolated ones. 0 or NaN stand where an operand has none. Only faces of
    equal values are merged; where vertices have values, only with `simplify`.

    Raises NotSolidError where an operand is open, NotCertifiedError where the result cannot be
    certified, ValueError naming the face that is out of range or not finite, or the operand that
    has points but no faces.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> b, c = (a.vertices + 0.5, a.faces), (a.vertices + [0.5, 0, 0], a.faces)
    >>> treeform.boolean("(a - b) * c", a=a, b=b, c=c).mesh.volume
    0.375
    """
    how = options(_core.BooleanOptions, locals())
    return _checked(_core.boolean([held(mesh) for mesh in meshes.values()], "", expression,
                                  list(meshes), how, progress=progress), check)


def clip(sheet: MeshLike, *solids: MeshesLike, keep: str = "outside", inside: str = "nonzero",
         precision: str = "float64", keep_cuts: bool = False, max_displacement: float = np.inf,
         check: bool = True, progress: Progress = None) -> BooleanResult:
    """An open surface cut by solids, one by one or in a list: the pieces of `sheet` outside all of
    them, or inside all.

    keep: 'outside' or 'inside'. A piece on the surface of a solid is inside it, so both together
    are the sheet. Edges are not checked, since the result is open.

    Raises NotSolidError where a solid is open, and as `boolean`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> sheet = ([[-1, -1, 0.5], [2, -1, 0.5], [2, 2, 0.5]], [[0, 1, 2]])
    >>> round(treeform.clip(sheet, cube, keep="inside").mesh.area, 12)
    0.5
    """
    if keep not in ("outside", "inside"):
        raise ValueError(f"keep: {keep!r} is neither 'outside' nor 'inside'")
    operation = "difference" if keep == "outside" else "intersection"
    how = options(_core.BooleanOptions, locals())
    return _checked(_core.clip([held(sheet), *_operands(solids)], operation, how,
                               progress=progress), check)


def split(*meshes: MeshesLike, precision: str = "float64", max_displacement: float = np.inf,
          check: bool = True, progress: Progress = None) -> BooleanResult:
    """All faces of the meshes, cut along each other and along themselves, each piece once. They
    need not bound solids.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.split(a, (a.vertices + 0.5, a.faces)).certificate
    Certificate(ok)
    """
    how = options(_core.BooleanOptions, locals(), keep_cuts=True)
    return _checked(_core.split(_operands(meshes), how, progress=progress), check)


def check_solid(mesh: MeshLike, *, progress: Progress = None) -> Certificate:
    """Whether a mesh bounds a solid, as operands of `boolean` have to: True, or says where the
    surface ends. Raises ValueError for points without a face.

    >>> import treeform
    >>> bool(treeform.check_solid(treeform.read("data/cube.stl")))
    True
    >>> treeform.check_solid(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])).open_count
    3
    """
    return _core.check_solid(held(mesh), progress=progress)
