"""Repair and rounding of meshes."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Any, Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import checked, options
from ._mesh import MeshOrCloud, Mesh, MeshLike, MeshResult, held, points_of
from ._progress import Progress
from ._results import Certificate, Result

__all__ = ["ConvexHull", "MadeMesh", "RepairResult", "convex_hull", "find_rounding_defects",
           "join_equal_points", "repair", "resolve_self_intersections", "rounded"]
# end


@dataclass(frozen=True, repr=False)
class MadeMesh(MeshResult):
    """A mesh made by an operation, and what was verified about it.

    mesh: Faces are counter-clockwise from outside.
    certificate: What was verified about the coordinates.
    """

    mesh: Mesh
    certificate: Certificate


STEPS = ("join", "orient", "fill", "resolve", "detach")


def steps_of(steps: Iterable[str]) -> dict[str, bool]:
    """For each step, whether to perform it."""
    steps = [steps] if isinstance(steps, str) else _arrays.several(steps, "steps")
    taken = [_arrays.one_of(step, "steps", STEPS) for step in steps]
    return {step: step in taken for step in STEPS}


# made of headers:
#   ConvexHull
@dataclass(frozen=True, repr=False)
class ConvexHull(Result):
    """The convex hull of points: triangles, grouped by flat sides.

    dimension: The dimension that the points span: 3, 2 in a plane, 1 on a line, 0 if all are equal,
        -1 for no points.
    faces: (F, 3) triangles, by point numbers, outward.
    first_face: (S,) the first face of each flat side; its faces are consecutive.
    areas: (S,) the area of each side.
    normals: (S, 3) the outward normal of each side, of length 1.
    mesh: The hull as a closed mesh, with only the points that it uses.
    """

    dimension: int
    faces: Ids
    first_face: Ids
    areas: Floats
    normals: Floats
    mesh: Mesh
# end

# made of headers:
#   RepairResult resolve_self_intersections repair convex_hull rounded find_rounding_defects
#   join_equal_points
@dataclass(frozen=True, repr=False)
class RepairResult(MadeMesh):
    """A repaired mesh.

    face_source: (F',) input face of each face, lowest of those merged; or `NONE`.
    vertex_source: (V',) input vertex of each vertex, or `NONE`.
    is_kept: (faces of the input,) whether a part of each face is left, also if it was merged with
        others.
    statistics: Counts of each step's changes. The volume of the input is its `Mesh.volume`. Keys:
        'tetrahedra' (Tetrahedra formed by faces; only their boundary was kept); 'degenerate'
        (Dropped faces without area, and slivers dropped with them); 'repeated' (Faces that repeat
        another, dropped); 'closed_edges' (Pairs of border edges joined into one edge);
        'split_edges' (Border edges split at vertices that lie on them); 'gap_limit' (Largest width
        of cracks searched for); 'widest_closed' (Widest crack that was closed); 'flipped' (Faces
        flipped to agree with their neighbors); 'turned_outward' (Components flipped outward);
        'strays' (Faces of loose and inner pieces, dropped); 'holes' (Holes filled); 'hole_edges'
        (Edges around them); 'filled' (Faces that fill them); 'unfilled_rims' (Rims not filled,
        since they are borders of sheets); 'open_edges' (Open edges left after these steps);
        'resolved' (Whether faces met and were cut); 'pairs' (Pairs of faces that met);
        'labeled_cells' (Cells labeled inside or outside, since faces disagreed); 'dropped_area'
        (Area of faces dropped: equal labels on both sides); 'flipped_area' (Area of faces flipped
        by the labels); 'removed' (Input faces that resolving removed entirely); 'covered' (For
        `resolve_self_intersections` with `split`: input faces that lie entirely on faces of lower
        numbers. Their pieces are those of the lower faces, so they do not count as removed);
        'left_open' (For `resolve_self_intersections` with `remove`: edges that lost their second
        face); 'exact_faces' (For `resolve_self_intersections`: as in `BooleanResult.statistics`);
        'split_vertices' (Vertices split where parts of the solid touch); 'detached' (Vertices moved
        apart); 'touching' (Vertices that still have the coordinates of another);
        'vanished_components' (Components (faces linked by vertices) that lost all of their faces;
        for `repair`, only those larger than `stray_share`); 'dropped_shells' (Closed shells inside
        the solid, dropped; `even_odd` makes them cavities); 'volume_before' (After `join`, `orient`
        and `fill`; 0 if that is no solid); 'volume_after'; 'area_before'; 'area_after'; 'area_lost'
        (As in `max_loss`).
    message: What was changed, such as '40 faces flipped, 2 holes filled (9 edges)'; empty if
        nothing was.
    """

    face_source: Ids
    vertex_source: Ids
    is_kept: NDArray[np.bool_]
    statistics: dict[str, Any]
    message: str


def resolve_self_intersections(mesh: MeshLike, mode: str = "outer", *, fill_rule: str = "nonzero",
                               precision: str = "float64", max_displacement: float = np.inf,
                               keep_cuts: bool = False, touching: bool = False,
                               max_loss: float = 0.05, check: bool = True,
                               progress: Progress = None) -> RepairResult:
    """`mesh` without self-intersections. If this is not possible, an error is raised; with
    `check=False`, the certificate of the result says why.

    `split` and `outer` decide exactly, on the coordinates as given, what is cut and what is inside.
    Then they round the points on cuts. Faces that meet no other face do not change.

    `remove` is for surfaces that bound no solid, and works locally. It deletes the faces that meet
    or are degenerate. It closes each hole by triangles of the least total area between the vertices
    of its rim, but not beyond the former border of the mesh. Where the new triangles meet other
    faces, the hole is widened. A part is a set of faces linked by edges:
    - In a part that has a border, a hole stays open if widening does not help, or if the hole would
      surround the border. Then only one face of each pair is deleted.
    - A closed part is not changed where a part with a border passes through it.
    - If every face of a part has a copy, as in a sheet with a back, one copy stays.

    mode: 'outer' cuts faces along their intersections and keeps those that bound the solid; 'split'
        keeps all pieces; 'remove', for surfaces that do not bound a solid, deletes intersecting
        faces and fills the holes.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: For `split` and `outer`: as in `boolean`.
    keep_cuts: For `outer`: as in `boolean`; `split` keeps all cuts.
    touching: For `remove`: also delete faces that only touch.
    max_loss: For `outer` and `remove`: losing more than this share gives the status
        `excessive_loss`. The share is of the volume of the solid, or of the area if the mesh bounds
        none. 1 allows any loss. The loss is measured from the solid that `repair` makes without
        filling holes.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh is open, NotCertifiedError if the result could not be
    certified; ValueError as `boolean`; for `remove`, a coordinate may be beyond 2^1000.

    Cost: as `boolean`; plus `repair` to measure the loss, for `remove`, and for `outer` if a
    component is inside out; for `remove`, one `self_intersections` a round, and for a hole of n
    vertices O(n^3) if n <= 200, else O(n^2).

    >>> import treeform
    >>> solid = treeform.resolve_self_intersections(treeform.read("data/two_spheres.stl"))
    >>> solid.mesh, solid.certificate, len(treeform.self_intersections(solid))
    (Mesh(326 vertices, 648 faces), Certificate(ok), 0)
    """
    how = options(_core.ResolveOptions, locals())
    return checked(_core.resolve_self_intersections(held(mesh), _arrays.word(mode, "mode"), how,
                                                    progress=progress), check, of="")


def repair(mesh: MeshLike, *, steps: Iterable[str] = STEPS, gap: float | None = None,
           largest_hole: int | None = None, stray_share: float = 0.001,
           fill_rule: str | None = None, max_loss: float = 0.05, sheet: bool = False,
           precision: str = "float64", max_displacement: float = np.inf, keep_cuts: bool = False,
           check: bool = True, progress: Progress = None) -> RepairResult:
    """Repairs a mesh to a solid: closed, oriented, manifold and free of self-intersections. If this
    is not possible, an error is raised; with `check=False`, the certificate of the result says why
    and lists where.

    The steps are those of `steps`, in this order. Each changes only what is defective: a mesh that
    is a solid is returned bit for bit. Which faces meet and what is inside is decided exactly.
    Which cracks are closed, how faces are oriented, and how holes are filled is decided by
    heuristics, and counted in `RepairResult.statistics`. Points with equal coordinates are one. If
    faces are the sides of tetrahedra, only the boundary of the tetrahedra is kept. If faces remain
    inconsistent, a minimum cut labels cells inside or outside, by the orientations of faces and
    generalized winding numbers. Its result is used if it loses less area than repair without
    labels, or if there is no certified result otherwise.

    Holes are filled with triangles between their vertices; large holes in smooth surfaces also with
    new points, which continue the surface smoothly. Sheets are not filled, but reported as open,
    unless any loss is allowed. A sheet is a part whose fillings would have more than 0.6 times its
    area, unless its border is in a plane and it is on one side of the plane. In a mesh of F > 1000
    faces, no hole is filled if more than F / 10 edges have three or more faces and a signed face
    count that is not zero.

    steps: the steps to perform. 'join' removes degenerate and duplicate faces and closes cracks;
        'orient' orients faces consistently and outward; 'fill' fills holes; 'resolve' removes
        self-intersections; 'detach' separates parts that touch only at an edge or a vertex.
    gap: Widest crack to close, in the mesh's length unit. By default the narrowest that leaves the
        fewest open edges, out of 0, a unit in the last place of float32, and 1e-6, 1e-5, 1e-4, 1e-3
        of the diagonal of the bounding box.
    largest_hole: Fill holes of at most this many edges.
    stray_share: Drops loose open pieces below this share of the area, and loose pieces of one or
        two faces below 1% of the area. If a larger component vanishes because it bounds no solid,
        the status is `excessive_loss`, unless `max_loss` is 1.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside. None:
        'positive' if all shells are oriented outward, otherwise 'nonzero'; if faces are
        inconsistent, inside and outside are determined by a minimum cut.
    max_loss: Losing more than this share of the volume (of the area, if there were holes) gives the
        status `excessive_loss`. Faces that remain, or are inside the solid, do not count as lost. 1
        allows any loss.
    sheet: The mesh is an open surface: keep its border, and fill nothing.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: As in `boolean`.
    keep_cuts: as in `boolean`; faces that fill holes are only merged with each other.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh stays open, NotCertifiedError if the result could not be
    certified; ValueError as `boolean`; for a point cloud; if a gap or share is negative or not
    finite.

    Cost: O(V log V + F log F), plus `resolve_self_intersections` if faces meet; for a hole of n
    edges O(n^3) if n <= 100, else O(n^2).

    >>> import treeform
    >>> mended = treeform.repair(treeform.read("data/dirty.stl"))
    >>> mended.mesh.is_solid, mended.statistics["flipped"], mended.statistics["holes"]
    (True, 40, 2)
    """
    how = options(_core.RepairOptions, locals(), **steps_of(steps))
    return checked(_core.repair(held(mesh), how, progress=progress), check, of="")


def convex_hull(points: MeshOrCloud, *, progress: Progress = None) -> ConvexHull:
    """The convex hull of `points`, exact on the coordinates as given: no point is outside the plane
    of a face, and faces belong to one side if and only if they are exactly coplanar. Of equal
    points, the lowest number is used. Corners of triangles may lie on an edge or inside a side of
    the hull.

    points: points (n, 3), or a mesh.

    Raises ValueError naming the first point that is not finite; for more points than 32 bits can
    number.

    Cost: O(V log V) time for most inputs, O(V^2) for some; serial.

    >>> import treeform
    >>> hull = treeform.convex_hull(treeform.read("data/cube.stl"))
    >>> hull.dimension, len(hull.faces), hull.areas.tolist()
    (3, 12, [1.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    >>> hull.mesh.volume
    1.0
    """
    return _core.convex_hull(points_of(points), progress=progress)


def rounded(points: ArrayLike, precision: str = "float32", *, progress: Progress = None) -> Floats:
    """(n, 3) the points with each coordinate rounded to the nearest value of this precision, as
    float64; infinite if it is out of range.

    precision: 'float32' or 'float64'.

    >>> import treeform
    >>> treeform.rounded([[0.1, 0.2, 0.3]]).tolist()
    [[0.10000000149011612, 0.20000000298023224, 0.30000001192092896]]
    """
    return _core.rounded(_arrays.points(points, "points"), _arrays.word(precision, "precision"),
                         progress=progress)


def find_rounding_defects(mesh: MeshLike, placed: ArrayLike, *,
                          progress: Progress = None) -> tuple[int, int]:
    """The number of faces that become degenerate, and the number of pairs of faces that newly meet
    (all kinds except touching and degenerate), when the vertices of `mesh` become `placed`. Exact.
    Distances are not compared, so `placed` may also be moved and rotated.

    placed: (V, 3) the rounded vertices.

    Raises ValueError as `self_intersections` for either, or if the numbers of points differ.

    Cost: `self_intersections` of the mesh at the new points; also at the old points if any faces
    meet.

    >>> import treeform
    >>> m = treeform.read("data/sphere.ply")
    >>> treeform.find_rounding_defects(m, treeform.rounded(m.vertices))
    (0, 0)
    """
    return _core.find_rounding_defects(held(mesh), _arrays.points(placed, "placed"),
                                       progress=progress)


def join_equal_points(mesh: MeshLike, *, progress: Progress = None) -> Mesh:
    """`mesh` with equal points joined. Points are in the order in which they first appear, with the
    coordinates of the first, bit for bit. Nothing is dropped: faces keep their order, even those
    that now repeat a corner, and points that no face uses stay.

    Raises ValueError for more than 2^32 - 1 points, or naming the lowest face with a corner out of
    range.

    >>> import treeform
    >>> soup = treeform.read("data/cube.stl", join=False)
    >>> soup, treeform.join_equal_points(soup)
    (Mesh(36 vertices, 12 faces), Mesh(8 vertices, 12 faces))
    """
    return _core.join_equal_points(held(mesh), progress=progress)
# end
