"""Nearest points, inside tests, rays, deviations."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import NotClosedError, options, require
from ._mesh import MeshOrCloud, MeshLike, as_mesh, held, held_body
from ._progress import Progress
from ._results import Result, tuple_repr

__all__ = ["AllRayHits", "ClosestPoints", "Deviation", "RayHits", "closest_point", "contains",
           "deviation", "locate", "raycast", "raycast_all", "raycast_any", "signed_distance",
           "winding_number"]
# end


OUTSIDE = 0


def located(mesh: MeshLike, points: ArrayLike,
            progress: Progress) -> tuple[NDArray[np.uint8], NDArray[np.int32]]:
    """Where points are, and their winding numbers. Raises NotClosedError if the mesh is open."""
    try:
        return _core.locate_points(held(mesh), _arrays.points(points, "points"), progress=progress)
    except ValueError:
        if len(as_mesh(mesh).faces):
            require(as_mesh(mesh)._as_operand(), of="")
        raise


def distances(mesh: MeshLike, points: ArrayLike, progress: Progress) -> Floats:
    """Signed distances, positive inside."""
    cloud = _arrays.points(points, "points")
    if len(cloud) == 0:
        return np.empty(0)
    how = _core.DeviationOptions(bins=0, both_ways=False)
    made = _core.deviation(_core.HeldMesh(cloud), held(mesh), how, progress=progress)
    if made is None:
        return np.full(len(cloud), -np.inf)
    if not made.is_signed:
        raise NotClosedError(as_mesh(mesh)._as_operand(), "")
    return np.asarray(-made.distances + 0.0)


class AllRayHits(NamedTuple):
    """All hits of rays, in the order of trimesh's `intersects_location`:
    `point, ray, face = raycast_all(...)`.

    point: (n, 3) the points that are hit, rounded.
    ray: (n,) uint32 the number of the ray, ascending.
    face: (n,) uint32 the face.
    """

    point: Floats
    ray: Ids
    face: Ids

    def __repr__(self) -> str:
        return tuple_repr(self)


def all_hits(mesh: MeshLike, origins: ArrayLike, directions: ArrayLike, t_min: float, t_max: float,
             progress: Progress) -> AllRayHits:
    """Implements `raycast_all`."""
    start, along = _arrays.points(origins, "origins"), _arrays.points(directions, "directions")
    t, ray, face = _core.raycast_all(held(mesh), start, along, _arrays.number(t_min, "t_min"),
                                     _arrays.number(t_max, "t_max"), progress=progress)
    from_, to = (one[ray] if len(one) != 1 else one for one in (start, along))
    return AllRayHits(from_ + t[:, None] * to, ray, face)


# made of headers:
#   ClosestPoints closest_point contains locate winding_number signed_distance RayHits raycast
#   raycast_all raycast_any Deviation deviation
class ClosestPoints(NamedTuple):
    """The nearest point of a mesh for each query, in the order of trimesh: `point, distance, face =
    closest_point(mesh, points)`.

    point: (n, 3) points on the mesh, rounded; NaN if none is within the radius.
    distance: (n,) distances, not squared; infinite if there is no point.
    face: (n,) uint32 face numbers; 4294967295 if there is no point.
    """

    point: Floats
    distance: Floats
    face: Ids

    def __repr__(self) -> str:
        return tuple_repr(self)


def closest_point(mesh: MeshOrCloud, points: ArrayLike, *, radius: float = np.inf,
                  progress: Progress = None) -> ClosestPoints:
    """The point on the surface nearest to each of `points` (n, 3). The error of a distance is at
    most 16 u L, where u = 2^-53 and L is the larger of the distance and the diagonal of the
    bounding box of the face. If several faces have the same computed distance, the one with the
    lowest number is returned. A Mesh keeps the index for later calls.

    radius: ignore points on the surface that are farther away than this.

    Raises ValueError naming a face with a corner out of range or not finite, or a query that is not
    finite; for a radius that is negative or NaN.

    Cost: O(F log F) and 128 bytes a face for the index, which a `Mesh` keeps. A query opens O(log
    F) nodes in most cases; more if much of the mesh is about equally far, or if the query is
    further away than 1e5 times the extent of the mesh.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> point, distance, face = treeform.closest_point(cube, [[0.5, 0.25, 3.0]])
    >>> point.tolist(), distance.tolist()
    ([[0.5, 0.25, 1.0]], [2.0])
    """
    return _core.closest_point(held_body(mesh), _arrays.points(points, "points"),
                               _arrays.number(radius, "radius"), progress=progress)


def contains(mesh: MeshLike, points: ArrayLike, *, progress: Progress = None) -> NDArray[np.bool_]:
    """(n,) bool: whether each of `points` (n, 3) is inside a closed mesh or on its surface. A point
    is inside if its winding number is not 0. Exact for every point. Raises NotClosedError if the
    mesh is open. For other errors and the cost, see `locate`.

    >>> import treeform
    >>> treeform.contains(treeform.read("data/cube.stl"), [[0.5, 0.5, 0.5], [1, 1, 1], [2, 0, 0]])
    array([ True,  True, False])
    """
    return np.asarray(located(mesh, points, progress)[0] != OUTSIDE)


def locate(mesh: MeshLike, points: ArrayLike, *, progress: Progress = None) -> NDArray[np.int8]:
    """The position of a point relative to a closed mesh.

    Exact on the coordinates as given, for every point. The crossings of one ray along x are
    counted. An edge that the ray grazes is treated as lying to one side, by a rule that all faces
    share, so no second ray is needed. Points with equal coordinates are one vertex.

    Returns (n,) int8: 1 for points strictly inside, 0 for points on the surface, -1 for points
    outside. The error for an open mesh is a NotClosedError.

    points: (n, 3) the points to locate.

    Raises ValueError if the mesh is open, naming an open edge; naming a face with a corner out of
    range or not finite, or a point that is not finite.

    Cost: O(F log F) for the indexes, which a `Mesh` keeps; O(log F + B) a point, for the B faces
    whose boxes meet the ray from the point along +x.

    >>> import treeform
    >>> treeform.locate(treeform.read("data/cube.stl"), [[0.5, 0.5, 0.5], [1, 1, 1], [2, 0, 0]])
    array([ 1,  0, -1], dtype=int8)
    """
    return np.array([-1, 1, 0], np.int8)[located(mesh, points, progress)[0]]


def winding_number(mesh: MeshLike, points: ArrayLike, *,
                   progress: Progress = None) -> NDArray[np.int32]:
    """(n,) int32: the winding number of a closed mesh around each of `points` (n, 3); 0 for points
    on the surface. Exact. Raises NotClosedError if the mesh is open.

    >>> import treeform
    >>> treeform.winding_number(treeform.read("data/cube.stl"), [[0.5, 0.5, 0.5], [2, 0, 0]])
    array([1, 0], dtype=int32)
    """
    return np.asarray(located(mesh, points, progress)[1])


def signed_distance(mesh: MeshLike, points: ArrayLike, *, progress: Progress = None) -> Floats:
    """(n,) the signed distance of each of `points` (n, 3) from the surface of a closed mesh:
    positive inside, as in trimesh, negative outside, and exactly 0 on the surface. The sign is
    exact. `deviation` uses the opposite sign, as metrology does. Raises NotClosedError if the mesh
    is open. For other errors and the cost, see `closest_point` and `locate`.

    >>> import treeform
    >>> treeform.signed_distance(treeform.read("data/cube.stl"), [[0.5, 0.5, 0.75], [0, 0, 3]])
    array([ 0.25, -2.  ])
    """
    return distances(mesh, points, progress)


class RayHits(NamedTuple):
    """The first face that each ray hits.

    t: (n,) the point hit is origin + t direction; infinite without a hit.
    face: (n,) uint32 face numbers; 4294967295 without a hit.
    at: (n,) uint8: the corner (0, 1, 2), edge (3, 4, 5) or interior (6) of the face that was hit.
    """

    t: Floats
    face: Ids
    at: NDArray[np.uint8]

    def __repr__(self) -> str:
        return tuple_repr(self)


def raycast(mesh: MeshLike, origins: ArrayLike, directions: ArrayLike, *, t_min: float = 0.0,
            t_max: float = np.inf, progress: Progress = None) -> RayHits:
    """The first face that a ray hits; none if it hits no face. Of several faces at the same point,
    the lowest number.

    The faces that a ray hits, their order, and the corner, edge or interior hit are exact. Only the
    parameters t are rounded. A ray that hits an edge or a corner hits every face there: through a
    vertex of six faces it has six hits at equal t, each with the vertex as a corner of its face.
    Faces include their edges and are hit from both sides.

    origins: (n, 3) the start points of the rays; (1, 3) for all.
    directions: (n, 3) of any length; (1, 3) for all.
    t_min: ignore hits before origin + t_min * direction.
    t_max: ignore hits beyond origin + t_max * direction.

    Raises ValueError for a ray with a zero direction or a number that is not finite (t_min and
    t_max may be infinite); naming a face with a corner out of range or not finite.

    Cost: O(F log F) for the index, which a `Mesh` keeps; for most rays O(log F) plus the faces at
    the hit.

    >>> import treeform
    >>> hits = treeform.raycast(treeform.read("data/cube.stl"), [[0.5, 0.25, 3]], [[0, 0, -1]])
    >>> hits.t.tolist(), hits.at.tolist()
    ([2.0], [6])
    """
    return _core.raycast(held(mesh), _arrays.points(origins, "origins"),
                         _arrays.points(directions, "directions"), _arrays.number(t_min, "t_min"),
                         _arrays.number(t_max, "t_max"), progress=progress)


def raycast_all(mesh: MeshLike, origins: ArrayLike, directions: ArrayLike, *, t_min: float = 0.0,
                t_max: float = np.inf, progress: Progress = None) -> AllRayHits:
    """All faces that each ray hits, in the exact order along the ray, then by number.

    origins: (n, 3) the start points of the rays; (1, 3) for all.
    directions: (n, 3) of any length; (1, 3) for all.
    t_min: ignore hits before origin + t_min * direction.
    t_max: ignore hits beyond origin + t_max * direction.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> point, ray, face = treeform.raycast_all(cube, [[0.5, 0.25, 3]], [[0, 0, -1]])
    >>> point.tolist()
    [[0.5, 0.25, 1.0], [0.5, 0.25, 0.0]]
    """
    return all_hits(mesh, origins, directions, t_min, t_max, progress)


def raycast_any(mesh: MeshLike, origins: ArrayLike, directions: ArrayLike, *, t_min: float = 0.0,
                t_max: float = np.inf, progress: Progress = None) -> NDArray[np.bool_]:
    """(n,) bool: whether each ray hits any face. Exact.

    origins: (n, 3) the start points of the rays; (1, 3) for all.
    directions: (n, 3) of any length; (1, 3) for all.
    t_min: ignore hits before origin + t_min * direction.
    t_max: ignore hits beyond origin + t_max * direction.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.raycast_any(cube, [[0.5, 0.5, 3], [5, 5, 5]], [[0, 0, -1], [0, 0, -1]])
    array([ True, False])
    """
    return _core.raycast_any(held(mesh), _arrays.points(origins, "origins"),
                             _arrays.points(directions, "directions"),
                             _arrays.number(t_min, "t_min"), _arrays.number(t_max, "t_max"),
                             progress=progress).view(np.bool_)


@dataclass(frozen=True, repr=False)
class Deviation(Result):
    """Distances of points from a surface, and their statistics.

    distances: (V,) of `a`: the distance of each point from the surface of `b`, negative inside the
        solid that `b` bounds, exactly 0 on its surface. Never negative if `b` bounds no solid.
    faces: (V,) the nearest face of `b`.
    is_signed: Whether distances have a sign.
    side_counts: If distances have a sign: points of `a` inside, on and outside of `b`.
    mean: Mean of the signed distances.
    mean_absolute: Mean of their magnitudes.
    rms: Root mean square of the distances.
    p50: Median of the magnitudes: the least value that half of them do not exceed.
    p95: The same for 95% of them.
    p99: The same for 99% of them.
    max: The largest magnitude.
    worst: The lowest point number with that magnitude.
    lowest: The least signed distance.
    highest: The greatest signed distance.
    histogram: (bins,) number of signed distances in intervals of equal length from `lowest` to
        `highest`.
    band_counts: With a band: points below, within and above it. Both ends are within.
    max_bound: Bound of the distance from any point of the surface `a` to `b`: the maximum, over its
        faces, of the largest corner distance plus the longest edge / sqrt(3). For a cloud it is
        `max`, rounded up.
    reverse_max: With `both_ways`, the largest distance of a vertex of `b` from `a`. The larger of
        this and `max` is the Hausdorff distance of the points.
    reverse_max_bound: With `both_ways`, a bound of the distance from any point of the surface `b`
        to `a`. The larger of this and `max_bound` bounds the Hausdorff distance of the surfaces.
    """

    distances: Floats
    faces: Ids
    is_signed: bool
    side_counts: tuple[int, int, int] | None
    mean: float
    mean_absolute: float
    rms: float
    p50: float
    p95: float
    p99: float
    max: float
    worst: int
    lowest: float
    highest: float
    histogram: NDArray[np.uint64]
    band_counts: tuple[int, int, int] | None
    max_bound: float
    reverse_max: float | None
    reverse_max_bound: float | None


def deviation(a: MeshOrCloud, b: MeshOrCloud, *, band: tuple[float, float] | None = None,
              bins: int = 40, both_ways: bool = True, progress: Progress = None) -> Deviation:
    """The signed distances of all points of `a`, used by faces or not, from the surface of `b`.

    The sign is exact: that of the winding number of `b` around the point (`locate`). Corners of `b`
    with equal coordinates are one vertex. If `b` is open, or a cloud, it has no inside, and
    distances have no sign. Magnitudes have the error bound of `closest_point`; a distance may round
    to 0.

    Raises ValueError if `a` or `b` is empty.

    `a` and `b` are each a mesh or a cloud (n, 3).

    band: the lowest and highest signed distance that are within tolerance.
    bins: Number of intervals of the histogram; 0: none.
    both_ways: Also compute distances of the points of `b` from `a`.

    Raises ValueError for a point of `a` that is not finite; a face of `b` as in `closest_point`; a
    band that is NaN or reversed; more than 2^20 bins.

    Cost: `closest_point` for each point, in a spatial order; for signs a winding number for one
    point in 1024, and the faces between neighbors for the others.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> map = treeform.deviation([[0.5, 0.5, 0.75], [0.5, 0.5, 3.0]], cube, band=(-0.5, 0.5))
    >>> map.distances.tolist(), map.band_counts, map.is_signed, map.side_counts
    ([-0.25, 2.0], (0, 1, 1), True, (1, 0, 1))
    """
    how = options(_core.DeviationOptions, locals())
    made = _core.deviation(held_body(a), held_body(b), how, progress=progress)
    if made is None:
        raise ValueError("deviation: a has no points, or b no faces")
    return made
# end
