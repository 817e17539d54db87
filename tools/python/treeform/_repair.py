"""Meshes mended, wrapped, rounded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, TypeVar, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._core import Certificate
from ._errors import options, require
from ._mesh import Mesh, MeshLike, MeshResult, as_mesh, cloud_of, held
from ._progress import Progress
from ._results import Result

__all__ = ["ConvexHull", "MadeMesh", "RepairResult", "ResolveResult", "WrapResult", "convex_hull",
           "find_rounding_defects", "join_equal_points", "repair", "resolve_self_intersections",
           "rounded", "wrap"]


@dataclass(frozen=True, repr=False)
class MadeMesh(MeshResult):
    """A mesh that an operation has made, and what was checked about it.

    mesh: Faces are counter-clockwise from outside.
    certificate: What was checked about the coordinates.
    """

    mesh: Mesh
    certificate: Certificate


# made of results:
#   resolve_result
@dataclass(frozen=True, repr=False)
class ResolveResult(MadeMesh):
    """A mesh without self-intersections.

    face_source: (F',) input face, lowest of those merged, or `NONE`.
    vertex_source: (V',) input vertex that each is, or `NONE`.
    statistics: Counts of what was done.
    """

    face_source: Ids
    vertex_source: Ids
    statistics: dict[str, Any]
# end


# made of results:
#   repair_result
@dataclass(frozen=True, repr=False)
class RepairResult(MadeMesh):
    """A mended mesh.

    face_source: (F',) input face, lowest of those merged, or `NONE`.
    vertex_source: (V',) input vertex that each is, or `NONE`.
    is_left: (faces of the input,) whether something is left of each, also where it was merged with
        others.
    steps: What each step has done: faces flipped, holes filled, ...
    """

    face_source: Ids
    vertex_source: Ids
    is_left: NDArray[np.bool_]
    steps: dict[str, Any]
# end


# made of results:
#   wrap_result
@dataclass(frozen=True, repr=False)
class WrapResult(MadeMesh):
    """A closed surface around a mesh.

    statistics: What it took.
    """

    statistics: dict[str, Any]
# end


_Made = TypeVar("_Made", bound=MadeMesh)


def _checked(made: _Made, check: bool, *also: str) -> _Made:
    if check:
        require(made.certificate, *also, of_one=True)
    return made


def resolve_self_intersections(mesh: MeshLike, mode: str = "outer", *, inside: str = "nonzero",
                               precision: str = "float64", max_displacement: float = np.inf,
                               keep_cuts: bool = False, touching: bool = False,
                               max_loss: float = 0.05, check: bool = True,
                               progress: Progress = None) -> ResolveResult:
    """The mesh without self-intersections.

    mode: 'outer' cuts faces along each other and keeps what bounds the solid; 'split' keeps every
    piece; 'remove' deletes faces that meet and fills the holes, for surfaces that bound no solid.
    inside: for 'outer', what is solid: 'nonzero', 'odd' or 'positive' winding numbers.
    keep_cuts: for 'outer', leave coplanar faces apart that were cut, or overlap; they are merged
    otherwise, but not where vertices have values, or faces different ones.
    touching: for 'remove', delete faces that only touch, too.
    max_loss: more than this share of the volume (or area) lost is an error; 1 allows any loss.
    precision, max_displacement, check: as for `boolean`.

    What is cut and what is inside is decided exactly, on the coordinates as given. Points on cuts
    are rounded, and the result is checked in the rounded numbers.

    Raises NotSolidError where 'outer' is asked of an open mesh, NotCertifiedError.

    >>> import treeform
    >>> solid = treeform.resolve_self_intersections(treeform.read("data/two_spheres.stl"))
    >>> solid.mesh, solid.certificate, len(treeform.self_intersections(solid))
    (Mesh(326 vertices, 648 faces), Certificate(ok), 0)
    """
    how = options(_core.ResolveOptions, locals())
    return _checked(_core.resolve(held(mesh), mode, how, progress=progress), check)


_STEPS = ("join", "orient", "fill", "resolve", "detach")


def repair(mesh: MeshLike, *, steps: Iterable[str] = _STEPS, gap: float | None = None,
           largest_hole: int | None = None, strays: float = 0.001, inside: str = "automatic",
           max_loss: float = 0.05, sheet: bool = False, precision: str = "float64",
           max_displacement: float = np.inf, keep_cuts: bool = False, check: bool = True,
           progress: Progress = None) -> RepairResult:
    """A solid made of a dirty mesh: closed, oriented, manifold, free of self-intersections.

    steps: those to take. 'join' drops degenerate and repeated faces and closes cracks, 'orient'
    makes faces agree and look outward, 'fill' fills holes, 'resolve' cuts self-intersections,
    'detach' moves apart what touches in an edge or a vertex.
    gap: the widest crack to close, a length; None finds one. largest_hole: in edges.
    strays: loose open pieces below this share of the area are dropped.
    inside: 'automatic', 'nonzero', 'odd' or 'positive'.
    sheet: the mesh is an open surface, and its border stays.
    max_loss, precision, max_displacement, keep_cuts, check: as for `resolve_self_intersections`.

    What meets and what is inside is decided exactly; which cracks close, which way faces look and
    what fills a hole are guesses, and counted in `steps`. A solid comes back bit for bit.

    Raises NotCertifiedError or NotSolidError where that was not possible, saying where.

    >>> import treeform
    >>> mended = treeform.repair(treeform.read("data/dirty.stl"))
    >>> mended.mesh.is_solid, mended.steps["flipped"], mended.steps["holes"]
    (True, 40, 2)
    """
    arguments = locals()
    taken = [_arrays.word(step, "steps") for step in _arrays.several(steps, "steps")]
    for step in taken:
        if step not in _STEPS:
            raise ValueError(f"steps: \"{step}\" is none of {', '.join(_STEPS)}")
    how = options(_core.RepairOptions, arguments, **{step: step in taken for step in _STEPS})
    return _checked(_core.repair(held(mesh), how, progress=progress), check, "sheet")


def wrap(mesh: MeshLike, size: float, *, offset: float | None = None, precision: str = "float64",
         check: bool = True, progress: Progress = None) -> WrapResult:
    """A closed surface around all faces, whatever they are: open, crossing, of no area. It enters
    no gap or hole narrower than about twice `size`, a length.

    offset: how far its vertices are from the faces; None: size / 30.

    No face of the mesh meets the wrap or is outside of it: that is exact.

    >>> import treeform
    >>> around = treeform.wrap(treeform.read("data/two_spheres.stl"), 0.5)
    >>> around.mesh.is_solid, bool(around.certificate)
    (True, True)
    """
    how = options(_core.WrapOptions, locals())
    return _checked(_core.wrap(held(mesh), size, how, progress=progress), check)


# made of results:
#   convex_hull_result
@dataclass(frozen=True, repr=False)
class ConvexHull(Result):
    """The convex hull of points: triangles, grouped by flat sides.

    dimension: 3 for points that span space, 2 in a plane, 1 on a line, 0 when all are equal, -1 for
        none.
    faces: (F, 3) numbers of the points, outward.
    first_face: (S,) the first face of each flat side; its faces follow one another.
    areas: (S,) the area of each side.
    normals: (S, 3) the outward normal of each side, of length 1.
    """

    dimension: int
    faces: Ids
    first_face: Ids
    areas: Floats
    normals: Floats
# end

    def mesh(self, points: Union[MeshLike, ArrayLike]) -> Mesh:
        """The hull as a closed mesh, of the points that it uses. points: those it is the hull
        of."""
        cloud = cloud_of(points)
        used, faces = np.unique(self.faces, return_inverse=True)
        vertices = as_mesh(points).vertices if cloud is None else np.asarray(cloud)
        return Mesh(vertices[used], faces.reshape(-1, 3))


def convex_hull(points: Union[MeshLike, ArrayLike], *, progress: Progress = None) -> ConvexHull:
    """The convex hull of points (n, 3), or of those of a mesh. Exact: no point is outside the plane
    of a face, and faces are of one side if and only if they are exactly coplanar.

    >>> import treeform
    >>> hull = treeform.convex_hull(treeform.read("data/cube.stl"))
    >>> hull.dimension, len(hull.faces), hull.areas.tolist()
    (3, 12, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    >>> hull.mesh(treeform.read("data/cube.stl")).volume
    1.0
    """
    cloud = cloud_of(points)
    return _core.convex_hull(as_mesh(points).vertices if cloud is None else cloud,
                             progress=progress)


def rounded(points: ArrayLike, precision: str = "float32", *,
            progress: Progress = None) -> Floats:
    """(n, 3) the points with each coordinate rounded to the nearest number of the precision, as
    float64.

    >>> import treeform
    >>> treeform.rounded([[0.1, 0.2, 0.3]]).tolist()
    [[0.10000000149011612, 0.20000000298023224, 0.30000001192092896]]
    """
    return _core.rounded(_arrays.points(points, "points"), precision, progress=progress)


def find_rounding_defects(mesh: MeshLike, placed: ArrayLike, *,
                          progress: Progress = None) -> tuple[int, int]:
    """What breaks when the vertices of a mesh become `placed` (V, 3): the number of faces that have
    lost their area, and of pairs of faces that meet now and did not before. Exact.

    >>> import treeform
    >>> m = treeform.read("data/sphere.ply")
    >>> treeform.find_rounding_defects(m, treeform.rounded(m.vertices))
    (0, 0)
    """
    return _core.find_rounding_defects(held(mesh), _arrays.points(placed, "placed"),
                                       progress=progress)


def join_equal_points(mesh: MeshLike, *, progress: Progress = None) -> Mesh:
    """The mesh with vertices of equal coordinates joined. Faces keep their order and number.

    >>> import treeform
    >>> soup = treeform.read("data/cube.stl", join=False)
    >>> soup, treeform.join_equal_points(soup)
    (Mesh(36 vertices, 12 faces), Mesh(8 vertices, 12 faces))
    """
    points, faces, data = _core.join_equal_points(held(mesh), progress=progress)
    return Mesh._of(points, faces, None, data)
