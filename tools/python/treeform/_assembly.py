"""Contacts and distances of two bodies or of all parts of an assembly, also in many poses."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Any, Iterable, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import options
from ._mesh import MeshOrCloud, each, held, held_body
from ._placement import SearchEffort
from ._progress import Progress
from ._results import Result, tuple_repr

__all__ = ["ClashResult", "ClosestPair", "PartClash", "PoseClashes", "RELATIONS", "check_poses",
           "clash", "closest_pair", "distance", "intersects"]
# end

#: The relations of two parts; numbers in `PoseClashes.relation` are indexes of this list.
RELATIONS = tuple(_core.RELATIONS)


def poses_of(values: ArrayLike | None, name: str) -> Floats:
    """Affine transforms as (n, 4, 4)."""
    if values is None:
        return _arrays.matrix(None, name)[None]
    array = _arrays.floats(values, name)
    fits = array.ndim in (2, 3) and array.shape[-2:] == (4, 4)
    array = _arrays.shaped(array, fits, name, "(4, 4) or (n, 4, 4)").reshape(-1, 4, 4)
    if not np.isfinite(array).all():
        at = int(np.argmin(np.isfinite(array).all(axis=(1, 2))))
        raise ValueError(f"{name}: an entry of {at} is not finite")
    wrong = (array[:, 3] != (0.0, 0.0, 0.0, 1.0)).any(axis=1)
    if wrong.any():
        at = int(np.argmax(wrong))
        raise ValueError(f"{name}: the last row of {at} is {array[at, 3].tolist()}, "
                         "not [0, 0, 0, 1]")
    return array


def one_or_all(found: NDArray[Any], *moves: ArrayLike | None) -> Any:
    """The single result, unless one of `moves` is a batch of transforms."""
    is_one = all(move is None or np.ndim(move) == 2 for move in moves)
    return found[0].item() if is_one else found


PartPairs = Iterable[Sequence[int]]


def _pairs(pairs: PartPairs) -> Ids:
    array = _arrays.ids(_arrays.several(pairs, "ignored"), "ignored")
    fits = not array.size or array.ndim == 2 and array.shape[1] == 2
    return _arrays.shaped(array, fits, "ignored", "(n, 2)").reshape(-1, 2)


def _at(body: _core.HeldMesh, pose: Floats) -> _core.HeldMesh:
    """A transformed body."""
    return held(_core.transformed(body, pose))


def clashes(parts: Iterable[MeshOrCloud], poses: ArrayLike | None, how: _core.ClashOptions,
            ignored: PartPairs, progress: Progress) -> ClashResult:
    """Implements `clash`."""
    bodies = each(parts, "parts")
    if poses is not None:
        maps = poses_of(poses, "poses")
        if np.ndim(poses) != 3 or len(maps) != len(bodies):
            raise ValueError(f"poses: the shape is {np.shape(poses)}, not ({len(bodies)}, 4, 4)")
        bodies = [_at(body, pose) for body, pose in zip(bodies, maps)]
    return _core.clash_parts(bodies, how, _pairs(ignored), progress=progress)


def clashes_in_poses(parts: Iterable[MeshOrCloud], poses: ArrayLike, how: _core.ClashOptions,
                     ignored: PartPairs, progress: Progress) -> PoseClashes:
    """Implements `check_poses`."""
    bodies = each(parts, "parts")
    array = _arrays.floats(poses, "poses")
    if array.ndim == 3 and array.shape[1:] == (4, 4):
        moves = np.tile(np.eye(4), (len(array), max(1, len(bodies)), 1, 1))
        moves[:, 0] = array
        array = moves
    _arrays.shaped(array, array.ndim == 4 and array.shape[1:] == (len(bodies), 4, 4), "poses",
                   f"(n, {len(bodies)}, 4, 4), or (n, 4, 4) for the first part")
    return _core.clash_in_poses(bodies, poses_of(array.reshape(-1, 4, 4), "poses"), how,
                                _pairs(ignored), progress=progress)


# made of headers:
#   intersects distance ClosestPair closest_pair PartClash ClashResult clash
#   PoseClashes check_poses
def intersects(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: ArrayLike | None = None,
               transform_b: ArrayLike | None = None, progress: Progress = None) -> Any:
    """Whether a face of `a` and a face of `b` have a common point; touching counts. Exact. Returns
    as soon as one pair is found. For meshes that are not a `Mesh`, only the faces that reach into
    the intersection of both bounding boxes (after the transforms) are indexed.

    `a` and `b` are each a mesh or a cloud (n, 3). Points of a cloud count as faces.

    transform_a: an affine transform of `a`, (4, 4), or several, (n, 4, 4). With several, the result
        is an array (n,).
    transform_b: likewise for `b`.

    Raises ValueError as `mesh_intersections`.

    >>> import numpy as np, treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> away = np.eye(4); away[0, 3] = 1.5
    >>> treeform.intersects(cube, cube), treeform.intersects(cube, cube, transform_b=away)
    (True, False)
    >>> treeform.intersects(cube, cube, transform_b=np.stack([np.eye(4), away]))
    array([ True, False])
    """
    return one_or_all(_core.intersects(held_body(a), held_body(b),
                                       poses_of(transform_a, "transform_a"),
                                       poses_of(transform_b, "transform_b"),
                                       progress=progress).view(np.bool_), transform_a, transform_b)


def distance(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: ArrayLike | None = None,
             transform_b: ArrayLike | None = None, radius: float = np.inf,
             progress: Progress = None) -> Any:
    """The distance between the surfaces `a` and `b`; infinite if `closest_pair` returns None.

    `a` and `b` are each a mesh or a cloud (n, 3). Points of a cloud count as faces.

    transform_a: an affine transform of `a`, (4, 4), or several, (n, 4, 4). With several, the result
        is an array (n,).
    transform_b: likewise for `b`.
    radius: larger distances are returned as infinite.

    >>> import numpy as np, treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> away = np.eye(4); away[0, 3] = 1.5
    >>> treeform.distance(cube, cube, transform_b=away)
    0.5
    """
    return one_or_all(_core.distance(held_body(a), held_body(b),
                                     poses_of(transform_a, "transform_a"),
                                     poses_of(transform_b, "transform_b"),
                                     _arrays.number(radius, "radius"),
                                     progress=progress), transform_a, transform_b)


class ClosestPair(NamedTuple):
    """The nearest points of two meshes.

    on_a: (3,) the point on the surface of `a`, rounded, as is `on_b`.
    on_b: (3,) the point on the surface of `b`.
    distance: Exactly 0 if and only if the meshes meet.
    face_a: The face of `a` that contains `on_a`.
    face_b: The face of `b` that contains `on_b`.
    """

    on_a: Floats
    on_b: Floats
    distance: float
    face_a: int
    face_b: int

    def __repr__(self) -> str:
        return tuple_repr(self)


def closest_pair(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: ArrayLike | None = None,
                 transform_b: ArrayLike | None = None, radius: float = np.inf,
                 progress: Progress = None) -> ClosestPair | None:
    """The nearest points of the surfaces `a` and `b`; none if one is empty, or if they are further
    apart than the radius. Surfaces count, not solids: inside a closed mesh, the distance is that to
    its surface.

    Whether the meshes meet is decided exactly, on the coordinates as given or as moved. If they do
    not, the error of the distance is at most 16 u L, where u = 2^-53 and L is the largest distance
    of two corners of the returned faces. Of several pairs of faces at the same computed distance,
    the lowest numbers are returned. If the meshes meet, any pair that meets may be returned, but
    the same one in every run.

    A `Mesh` caches tight bounds of its surface, which make later calls several times faster for
    nearly flat surfaces that are not axis-aligned. Transforms other than rotations, uniform
    scalings and reflections are slower.

    `a` and `b` are each a mesh or a cloud (n, 3). Points of a cloud count as faces.

    transform_a: (4, 4) an affine transform applied to `a` first.
    transform_b: (4, 4) an affine transform applied to `b` first.
    radius: return None if the meshes are farther apart than this.

    Raises ValueError naming the mesh and its lowest face with a corner out of range or not finite;
    for a transform that is not finite; for a radius that is negative or NaN.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.closest_pair(cube, (cube.vertices + [0, 0, 3], cube.faces)).distance
    2.0
    """
    return _core.closest_pair(held_body(a), held_body(b),
                              _arrays.matrix(transform_a, "transform_a"),
                              _arrays.matrix(transform_b, "transform_b"),
                              _arrays.number(radius, "radius"), progress=progress)


@dataclass(frozen=True, repr=False)
class PartClash(Result):
    """Two parts that penetrate, touch, or are closer than the clearance.

    a: The lower number.
    b: Number of the second part.
    a_inside_b: As in `measure`.
    b_inside_a: The same with `a` and `b` swapped.
    distance: Distance of the surfaces; 0 if they meet.
    nearest: (2, 3) For parts that are too close: the nearest points on a and on b.
    face_pairs: Pairs of faces that meet.
    volume: For closed parts that penetrate: the volume of their intersection.
    depth: For penetrating parts: `penetration_depth`, the length of `move`.
    move: (3,) a short translation that separates `a` from `b`.
    depth_effort: Of `depth`, as in `Depth`.
    regions: Regions where they meet: (box (2, 3), number of pairs of faces, faces of a, faces of
        b).
    relation: 'penetrating', 'touching' or 'closer_than_clearance'.
    """

    a: int
    b: int
    a_inside_b: bool
    b_inside_a: bool
    distance: float
    nearest: Floats | None
    face_pairs: int
    volume: float | None
    depth: float | None
    move: Floats
    depth_effort: SearchEffort
    regions: list[tuple[Floats, int, Ids, Ids]]
    relation: str


@dataclass(frozen=True, repr=False)
class ClashResult(Result):
    """The clashes of all parts of an assembly.

    pairs: Pairs found, ascending.
    counts: Number of tested pairs, by relation.
    clashes: Number of pairs that penetrate or are closer than the clearance; with a clearance, also
        pairs that touch.
    boxes_apart: Pairs excluded by their boxes.
    """

    pairs: list[PartClash]
    counts: dict[str, int]
    clashes: int
    boxes_apart: int


def clash(parts: Iterable[MeshOrCloud], clearance: float = 0.0, *, volumes: bool = True,
          depths: bool = True, limit: int = 1000, vertices: str = "by_coordinates",
          poses: ArrayLike | None = None, ignored: PartPairs = (),
          progress: Progress = None) -> ClashResult:
    """The relations of all pairs of parts of an assembly.

    Exact, like `measure`: parts penetrate, touch, or are disjoint. Boxes only exclude pairs: linked
    rings that do not meet are disjoint, although their boxes overlap. Empty parts are disjoint from
    all. Distances are those of `distance`, and only computed with a clearance. A part is only
    indexed if its box is near that of another.

    clearance: Parts nearer than this are too close; not squared.
    volumes: Compute the volume of the intersection of closed parts.
    depths: Compute depths of penetrating parts.
    limit: Largest number of faces listed for each region and part.
    vertices: 'by_coordinates' or 'by_index'. Which corners are the same vertex.
    poses: (N, 4, 4) an affine transform for each of the N parts. Transformed vertices are rounded
        to float64; everything after that is exact. The result refers to the transformed parts. For
        many poses of all parts, use `check_poses`.
    ignored: pairs of part numbers to ignore.

    Raises ValueError naming the part and its lowest face with a corner out of range or not finite;
    for a clearance that is negative or not finite; for an ignored pair with a number out of range.

    Cost: O(N log N + P) for N parts and the P pairs of parts whose boxes are within the clearance;
    for each of these pairs `measure`, `distance` with a clearance, `mesh_intersections` if they
    meet, `intersection` and `penetration_depth` if they penetrate.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> found = treeform.clash([cube, (cube.vertices + 0.5, cube.faces),
    ...                         (cube.vertices + [0, 0, 9], cube.faces)])
    >>> [(one.a, one.b, one.relation, one.volume) for one in found.pairs]
    [(0, 1, 'penetrating', 0.125)]
    >>> import numpy as np
    >>> poses = np.stack([np.eye(4), np.eye(4)])
    >>> poses[1, :3, 3] = 0.5, 0, 0
    >>> treeform.clash([cube, cube], poses=poses).pairs[0].volume
    0.5
    """
    how = options(_core.ClashOptions, locals())
    return clashes(parts, poses, how, ignored, progress)


@dataclass(frozen=True, repr=False)
class PoseClashes(Result):
    """The clashes in each of many poses: n pairs of parts, pose after pose.

    pose: (n,) the number of the pose, ascending.
    parts: (n, 2) the two parts, the lower number first.
    distance: (n,) for parts that are closer than the clearance; 0 if they touch or penetrate.
    in_collision: (P,) whether, in each pose, a pair penetrates or is too close; with a clearance,
        also whether a pair touches.
    clashing: Number of poses in collision.
    relation: (n,) uint8: their relation, an index into `RELATIONS`.
    """

    pose: Ids
    parts: Ids
    distance: Floats
    in_collision: NDArray[np.bool_]
    clashing: int
    relation: NDArray[np.uint8]


def check_poses(parts: Iterable[MeshOrCloud], poses: ArrayLike, clearance: float = 0.0, *,
                first_only: bool = False, vertices: str = "by_coordinates", ignored: PartPairs = (),
                progress: Progress = None) -> PoseClashes:
    """The clashes in each of many poses. All pairs are tested, also of parts that do not move: if
    such a pair meets, every pose is in collision, unless `ignored` has it. `in_collision` includes
    pairs that are too close; `distance` is that of pairs closer than the clearance, 0 if they touch
    or penetrate.

    Exact, like `clash` and `measure`, for the moved corners, rounded to double. Two parts are only
    copied and indexed again for a pose if they touch, if a corner of one is so near the surface of
    the other that rounding might change its side, or if a transform is not a rigid motion.

    poses: (P, N, 4, 4) for each of P poses, an affine transform for each of the N parts; or (P, 4,
        4), to move only the first part.
    clearance: Parts nearer than this are too close; not squared.
    first_only: Find only the first clash of each pose.
    vertices: 'by_coordinates' or 'by_index'. Which corners are the same vertex.
    ignored: pairs of part numbers to ignore.

    Raises ValueError naming the part and its lowest face with a corner out of range or not finite,
    the pose with a transform that is not finite; for a number of transforms that is not a multiple
    of the number of parts; as `clash`.

    Cost: the indexes of the parts; for each pose O(N^2) comparisons of boxes, and an `intersects`
    for each pair whose boxes overlap.

    >>> import numpy as np, treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> poses = np.tile(np.eye(4), (3, 2, 1, 1))
    >>> poses[:, 1, 0, 3] = [0.5, 1.0, 1.5]
    >>> found = treeform.check_poses([cube, cube], poses)
    >>> [(int(p), treeform.RELATIONS[h]) for p, h in zip(found.pose, found.relation)]
    [(0, 'penetrating'), (1, 'touching')]
    >>> found.in_collision
    array([ True, False, False])
    """
    how = options(_core.ClashOptions, locals())
    return clashes_in_poses(parts, poses, how, ignored, progress)
# end
