"""Placement of meshes: moving until contact, laying flat, aligning, packing, measuring."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Any, Iterable, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import need, options
from ._mesh import MeshOrCloud, Mesh, MeshLike, MeshResult, bodies, each, held, held_body
from ._progress import Progress
from ._properties import Feature
from ._results import Certificate, Result, tuple_repr

__all__ = ["Alignment", "Contacts", "Depth", "Impact", "LaidFlat", "Measure", "PackedPart",
           "Packing", "Placement", "SearchEffort", "align", "drop", "lay_flat", "mate",
           "mate_features", "measure", "pack", "penetration_depth", "separate", "slide",
           "time_of_impact", "turn"]
# end


def scale_of(scale: bool | tuple[float, float]) -> dict[str, Any]:
    """The options of `align` for its argument `scale`."""
    if isinstance(scale, (bool, np.bool_)):
        return {"scale": bool(scale)}
    least, most = _arrays.pair(scale, "scale")
    return {"scale": True, "least_scale": least, "most_scale": most}


def extent_of(size: ArrayLike) -> Floats:
    """The size of a plate, (3,); the height is infinite if it is not given."""
    extent = _arrays.floats(size, "size")
    return np.append(extent, np.inf) if extent.shape == (2,) else extent


# made of headers:
#   Contacts Placement SearchEffort Measure slide drop mate separate turn mate_features LaidFlat
#   lay_flat Alignment align PackedPart Packing pack measure Depth penetration_depth Impact
#   time_of_impact
class Contacts(NamedTuple):
    """Pairs of faces that touch in the final position, or are at the clearance. On the bed, only
    the lowest point is listed, once. A tuple of arrays: the number of contacts is
    `len(contacts.point)`.

    point: (n, 3) a common point of each pair, rounded.
    normal: (n, 3) of length 1, from the fixed to the moving mesh; 0 if there is none.
    moving: (n,) faces of the moving mesh.
    fixed_face: (n,) faces of the fixed mesh; 4294967295 for the bed.
    fixed: (n,) number of the fixed mesh.
    """

    point: Floats
    normal: Floats
    moving: Ids
    fixed_face: Ids
    fixed: Ids

    def __repr__(self) -> str:
        return tuple_repr(self)


@dataclass(frozen=True, repr=False)
class Placement(MeshResult):
    """The result of a placement. True if the mesh has a place; else `message` has the reason.

    mesh: The moved mesh, in the checked coordinates; the unmoved mesh if there is no place.
    matrix: (4, 4) new = M * old: a translation; for `turn` and `mate_features` also a rotation.
        Vertices are moved by it and rounded once, except for points that are set on the bed.
    message: Why there is no place, as a clause; empty if there is a place.
    direction: (3,) unit direction of the travel; 0 if there is none.
    travel: Distance moved; for `too_far` the distance needed.
    relation_at_start: Exact: 'disjoint', 'touching', 'penetrating', 'closer_than_clearance' or
        'clear'.
    relation: Relation at the place: 'disjoint', 'touching', 'penetrating', 'closer_than_clearance'
        or 'clear'.
    contacts: Pairs of faces that touch in the final position, or are at the clearance.
    contact_count: Number of all contacts, listed or not.
    nearest: The relation, at the place, of the moving mesh (`a`) to the fixed mesh that it
        penetrates, else to one that it touches, else to the nearest. None if all are too far away.
    certificate: The outcome of checking the coordinates.
    effort: For `separate`: the effort of its search. If `skipped_candidates` is not 0, there may be
        a shorter translation, or a place although none was found.
    angle: For `turn` and `mate_features`: angle of the rotation, in degrees.
    tolerance: For `turn`: the gap, beyond the clearance, that counts as contact.
    offset: For `mate_features`: the distance of the moving feature's center from the fixed
        feature's center at the place, along the direction of the fixed feature. For planes, their
        distance.
    nearest_fixed: Fixed mesh of `nearest`; the lowest if several qualify.
    outcome: Why the placement ended where it did: 'contact', 'bed', 'unchanged', 'moved_apart',
        'nothing_met', 'too_far', 'starts_penetrating', 'starts_too_near', 'starts_touching',
        'starts_below_bed', 'not_representable', 'too_many_steps', 'out_of_range'.
    """

    mesh: Mesh
    matrix: Floats
    message: str
    direction: Floats
    travel: float
    relation_at_start: str
    relation: str
    contacts: Contacts
    contact_count: int
    nearest: Measure | None
    certificate: Certificate
    effort: SearchEffort
    angle: float
    tolerance: float
    offset: float
    nearest_fixed: int
    outcome: str

    def __bool__(self) -> bool:
        return bool(self.certificate)


class SearchEffort(NamedTuple):
    """The work of a bounded search, in pairs of faces tested. It depends on the input alone. A
    result is valid even if the bound was reached.

    pairs: Pairs of faces tested; a pair in motion counts as two.
    bound: The limit of `pairs`.
    skipped_candidates: Number of candidates skipped because testing one would take more than 1/32
        of the bound, or more than the rest of it. If not 0, a better result may exist.
    """

    pairs: int
    bound: int
    skipped_candidates: int

    def __repr__(self) -> str:
        return tuple_repr(self)


@dataclass(frozen=True, repr=False)
class Measure(Result):
    """The relation and distance of two meshes.

    relation: 'disjoint', 'touching' or 'penetrating'. Exact.
    distance: Not squared. 0 if and only if the meshes touch or penetrate each other.
    surface_distance: Exactly 0 if and only if a face of one meets a face of the other. So it is
        positive for a mesh inside a solid whose surface it does not touch.
    on_a: (3,) the nearest point on the surface of `a`; a common point if they meet.
    on_b: (3,) the nearest point on the surface of `b`; a common point if they meet.
    face_a: The face of `a` that contains `on_a`.
    face_b: The face of `b` that contains `on_b`.
    a_inside_b: A component of `a` is inside the solid `b` without touching it.
    b_inside_a: The same with `a` and `b` exchanged.
    """

    relation: str
    distance: float
    surface_distance: float
    on_a: Floats
    on_b: Floats
    face_a: int
    face_b: int
    a_inside_b: bool
    b_inside_a: bool


def slide(moving: MeshOrCloud, fixed: Any, direction: ArrayLike, clearance: float = 0.0, *,
          max_travel: float | None = None, precision: str = "float64", bed: float | None = None,
          progress: Progress = None) -> Placement:
    """Moves `moving` along `direction` (of any length) until it first meets one of `fixed`, or is
    at the clearance from one.

    The returned coordinates are checked again: if rounding made the mesh penetrate, or come nearer
    than the clearance, it is moved back by units in the last place. A mesh that touches at the
    start stays there. A mesh that penetrates at the start has no place. Points that no face uses
    move along and are otherwise ignored; points without any face are a cloud.

    Only fixed meshes on the way are tested and indexed. For many calls, pass a `Mesh`.

    fixed: a fixed body, or a list of them.
    direction: (3,) the direction of motion, of any length.
    clearance: Gap to leave, a distance; 0: contact.
    max_travel: Largest distance to move; obstacles beyond are ignored.
    precision: 'float32' or 'float64'. Precision of the returned points.
    bed: z of a bed, which also stops the mesh: points resting on the bed have exactly this z (for
        float32, the smallest value not below it), and no point is below it.

    Raises ValueError for a direction that is zero or not finite; a clearance that is negative or
    not finite; a bed that is not finite or beyond float32, or with a direction that does not lead
    down to it; naming the operand and its lowest face with a corner out of range or not finite.

    Cost: O(V + F) of all meshes to check the input; the search in motion; for each attempt at
    rounding a tree over `moving` and a `measure` to the meshes nearby.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> seated = treeform.slide((cube.vertices + [0.25, 0, 5], cube.faces), cube, [0, 0, -1])
    >>> bool(seated), seated.travel, seated.relation
    (True, 4.0, 'touching')
    """
    how = options(_core.PlacementOptions, locals())
    return _core.slide(held_body(moving), bodies(fixed), _arrays.vector(direction, "direction"),
                       how, progress=progress)


def drop(moving: MeshOrCloud, fixed: Any = None, *, direction: ArrayLike = (0, 0, -1),
         clearance: float = 0.0, max_travel: float | None = None, precision: str = "float64",
         bed: float | None = None, progress: Progress = None) -> Placement:
    """Moves `moving` down until it rests on the bed or on one of `fixed`. A mesh below the bed
    moves up to it, against the direction; but with `fixed`, it has no place.

    fixed: a fixed body, or a list of them.
    direction: (3,) the downward direction, of any length.
    clearance: as for `slide`.
    max_travel: as for `slide`.
    precision: as for `slide`.
    bed: z of the bed. None: no bed if there are fixed bodies, otherwise a bed at 0.

    Raises ValueError as `slide`; for a direction that does not point down.

    Cost: O(V).

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> low = treeform.drop((cube.vertices + 3.25, cube.faces))
    >>> low.travel, low.mesh.bounds[:, 2].tolist()
    (3.25, [0.0, 1.0])
    """
    how = options(_core.PlacementOptions, locals())
    return _core.drop(held_body(moving), bodies(fixed), _arrays.vector(direction, "direction"), how,
                      progress=progress)


def mate(moving: MeshOrCloud, fixed: Any, *, clearance: float = 0.0,
         max_travel: float | None = None, precision: str = "float64",
         progress: Progress = None) -> Placement:
    """Translates `moving` so that the nearest points of `moving` and `fixed` meet, or are at the
    clearance. Coordinates are checked as in `slide`. A mesh that touches stays; a mesh that
    penetrates has no place.

    fixed: a fixed body, or a list of them.
    clearance: Gap to leave, a distance; 0: contact.
    max_travel: Largest distance to move; obstacles beyond are ignored.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError as `slide`.

    Cost: `measure` for the fixed meshes that may be the nearest, and a `slide`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.mate((cube.vertices + [0, 3, 0], cube.faces), cube).travel
    2.0
    """
    how = options(_core.PlacementOptions, locals())
    return _core.mate(held_body(moving), bodies(fixed), how, progress=progress)


def separate(moving: MeshOrCloud, fixed: Any, clearance: float = 0.0, *,
             max_travel: float | None = None, precision: str = "float64", effort: int = 0,
             progress: Progress = None) -> Placement:
    """Translates `moving` to a place where it penetrates none of `fixed` and keeps the clearance.
    If it already does, in coordinates of the precision, it stays.

    About fifty directions are tried: along the axes, away from the nearest points, along normals of
    faces that meet, and others around the best. The nearest of the places found is returned, if its
    coordinates pass the check of `slide`. It need not be the globally nearest place, which is on
    the boundary of a set with O(n^2 m^2) faces, for meshes of n and m faces. The search is limited
    by `effort`, and skips candidates that would take much of it, as in `penetration_depth`;
    `Placement.effort` counts them.

    fixed: a fixed body, or a list of them.
    clearance: Gap to leave, a distance; 0: contact.
    max_travel: Largest distance to move; obstacles beyond are ignored.
    precision: 'float32' or 'float64'. Precision of the returned points.
    effort: limit for the number of pairs of faces that the search examines, where a pair in motion
        counts as two; 0: 20 million, plus 200 for each face. Distance computations for a clearance
        are not counted.

    Raises ValueError as `slide`.

    Cost: for each direction up to about 12 `intersects` or `distance`, a tree over `moving` and a
    search in motion.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> apart = treeform.separate((cube.vertices + [0.75, 0, 0], cube.faces), cube)
    >>> apart.travel, apart.relation_at_start, apart.relation
    (0.25, 'penetrating', 'touching')
    """
    how = options(_core.PlacementOptions, locals())
    return _core.separate(held_body(moving), bodies(fixed), how, progress=progress)


def turn(moving: MeshOrCloud, fixed: Any, axis: ArrayLike, origin: ArrayLike = (0.0, 0.0, 0.0), *,
         clearance: float = 0.0, max_angle: float = 360.0, tolerance: float | None = None,
         precision: str = "float64", progress: Progress = None) -> Placement:
    """Turns `moving` until its distance from one of `fixed` is at most the clearance plus the
    tolerance. The axis is the line through `origin` along `axis`, of any length but 0. Turns are
    right-handed: counter-clockwise seen against the direction.

    Conservative advancement: bounds on the speed of corners guarantee that no faces meet within a
    step, up to the rounding of distances. The returned coordinates are checked exactly: they
    penetrate nothing, and keep the clearance as computed by `distance`. If rounding violates that,
    the rotation is reduced by units in the last place. A mesh that touches at the start stays; one
    that penetrates has no place. With `nothing_met`, all of `max_angle` is free. `too_many_steps`
    means undecided: the mesh passes another at a distance that is very small compared with its
    size, over a long way.

    `travel` is 0, and vertices differ from `matrix` by a few units in the last place of the largest
    coordinate. `contacts` are the pairs of faces within the tolerance, beyond the clearance.
    `Placement.relation` is exact: in general disjoint, by at most the tolerance beyond the
    clearance.

    Points that no face uses turn along and are otherwise ignored; points without any face are a
    cloud.

    fixed: a fixed body, or a list of them.
    axis: (3,) the direction of the axis, of any length.
    origin: (3,) a point on the axis.
    clearance: Gap to leave, a distance; 0: contact.
    max_angle: the largest rotation, in degrees; greater than 0 and at most 360.
    tolerance: the largest gap, beyond the clearance, that counts as contact; greater than 0. None:
        2^-32 of the largest distance of a point from the axis.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError as `slide`; for an axis that is zero or not finite, an angle out of range, or
    a tolerance that is not positive.

    Cost: for each step the pairs of faces near each other. About 10 to 100 steps to a head-on
    contact; O(sqrt(length / gap)) steps for each radian along which it passes a mesh at a gap.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> door = treeform.turn(cube, (cube.vertices + [-1.5, 0, 0], cube.faces), [0, 0, 1])
    >>> bool(door), 0 < door.angle < 180
    (True, True)
    """
    how = options(_core.PlacementOptions, locals())
    return _core.turn(held_body(moving), bodies(fixed), _arrays.vector(axis, "axis"),
                      _arrays.vector(origin, "origin"), how, progress=progress)


def mate_features(moving: MeshOrCloud, fixed: Any, of_moving: Feature, of_fixed: Feature, *,
                  clearance: float = 0.0, max_travel: float | None = None, flip: bool = False,
                  precision: str = "float64", progress: Progress = None) -> Placement:
    """Rotates `moving` by the least angle that makes the features' directions opposite (planes) or
    parallel (axes), aligns their centers, and slides `moving` from outside along the direction of
    the fixed feature until first contact with any of `fixed`, or the clearance, exactly like
    `slide`. Planes approach from the front of the fixed plane; axes from the side where `moving`
    is.

    A shaft may go through its bore and meet nothing: then its center stays at the center of the
    bore, if that penetrates nothing and keeps the clearance. The place is checked exactly, on the
    returned coordinates. `travel` is always 0.

    fixed: a fixed body, or a list of them.
    of_moving: a plane or an axis found by `find_features`.
    of_fixed: one of the same kind.
    clearance: Gap to leave, a distance; 0: contact.
    max_travel: Largest distance to move; obstacles beyond are ignored.
    flip: make the normals of the planes point in the same direction instead of in opposite
        directions; for axes, reverse the direction.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError as `slide`; for features of different kinds, with a direction that is not of
    length 1, or with an origin that is not finite.

    Cost: that of `slide`, and two trees over `moving`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> other = (cube.vertices + [0, 0, 5], cube.faces)
    >>> side, top = treeform.find_features(other)[0], treeform.find_features(cube)[0]
    >>> treeform.mate_features(other, cube, side, top).relation
    'touching'
    """
    how = options(_core.PlacementOptions, locals())
    return _core.mate_features(held_body(moving), bodies(fixed),
                               need(of_moving, "of_moving", Feature),
                               need(of_fixed, "of_fixed", Feature), how, progress=progress)


@dataclass(frozen=True, repr=False)
class LaidFlat(MeshResult):
    """A mesh on the bed.

    mesh: The mesh on the bed.
    matrix: (4, 4) new = M * old, a rotation and a translation. Vertices differ from it by a few
        units in the last place of the largest coordinate, old or new.
    chosen: The side that is on the bed, as an index into `areas`.
    message: The outcome as a clause for people, without a full stop.
    areas: (S,) areas of the flat sides of the convex hull, largest first.
    normals: (S, 3) outward normals, before the rotation.
    tip_angles: (S,) for each side the least tilt, in degrees, that brings the center of mass over
        an edge of it, so that the mesh tips over. 90 if the center is in the plane of the side.
        Negative if the center is not over the side: then the mesh tips over by itself.
    overhangs: (S,) area of the faces that need support if the side is down: faces off the bed that
        point down at more than `overhang_angle` from the vertical. Only computed for the 32 largest
        sides and the chosen one, else NaN.
    center_of_mass: (3,) before the rotation, rounded.
    on_bed: (n,) points of the chosen side, ascending.
    certificate: The outcome of checking the coordinates.
    center_heights: (S,) height of the center of mass above each side.
    mass_dimension: What the mass is attributed to: 3 for the solid that a closed mesh bounds; 2 for
        the faces of an open mesh, as sheets of equal thickness; 0 for the points of a mesh without
        a face of positive area.
    """

    mesh: Mesh
    matrix: Floats
    chosen: int
    message: str
    areas: Floats
    normals: Floats
    tip_angles: Floats
    overhangs: Floats
    center_of_mass: Floats
    on_bed: Ids
    certificate: Certificate
    center_heights: Floats
    mass_dimension: int


def lay_flat(mesh: MeshLike, *, normal: ArrayLike | None = None, point: ArrayLike | None = None,
             most_stable: bool = False, keep_spin: bool = False, tolerance: float = 0.0,
             bed: float = 0.0, overhang_angle: float = 45.0, precision: str = "float64",
             progress: Progress = None) -> LaidFlat:
    """Rotates `mesh` so that a flat side of its convex hull is on the bed. The center of its box
    keeps x and y. Raises ValueError if there is no side: fewer than three points, or all on a line.

    Every point in the plane of the side, exactly or within the tolerance, gets exactly the z of the
    bed, and no point is below. Areas and angles are rounded; values within 2^-40 of the best are
    treated as equal. Of equal sides, one that is already exactly down is chosen, else the largest,
    else the first in `LaidFlat.areas`. Points without faces move along and are otherwise ignored; a
    mesh without faces uses all its points.

    normal: (3,) The side whose outward normal makes the least angle with this direction, of any
        length, in the coordinates of the mesh.
    point: (3,) The side nearest to this point: the one that contains it, if one does.
    most_stable: The side with the largest tip angle.
    keep_spin: Do not rotate about the vertical. Otherwise the mesh is also rotated about it, by at
        most 45 degrees, so that the longest edge of the side runs along x or y.
    tolerance: Points at most this far from the plane of a side belong to it. With 0, a side is
        exactly coplanar, which suits models in round numbers. A flat face that was rotated and
        rounded falls into many exactly coplanar sides; about 1e-6 of the size joins them.
    bed: Z of the bed.
    overhang_angle: In degrees from the vertical, 0 to 90.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError naming a point that is not finite or a face with a corner out of range; for a
    zero `normal`; for several choices of a side; for options that are not finite, a negative
    tolerance, or an overhang angle out of range; OverflowError for coordinates that overflow in the
    rotation.

    Cost: `convex_hull`, plus O(F) for the center of mass and for each side with an overhang.

    >>> import treeform
    >>> laid = treeform.lay_flat(treeform.read("data/cube.stl"))
    >>> laid.message, laid.mesh.bounds[0, 2]
    ('on side 0 of 6, of area 1', 0.0)
    """
    how = options(_core.LayFlatOptions, locals())
    made = _core.lay_flat(held(mesh), how, progress=progress)
    if made is None:
        raise ValueError("lay_flat: no flat side: fewer than three points, or all on a line")
    return made


@dataclass(frozen=True, repr=False)
class Alignment(MeshResult):
    """The motion that `align` found.

    matrix: (4, 4) new = M * old, with `start` included.
    mesh: The moved mesh; without faces for a cloud.
    rms: Root mean square of the distances at the end, weighted if weights are used; 0 without
        partners. For two clouds with `plane_to_plane`: of the distances to the planes, weighted by
        the agreement of both planes.
    rms_at_start: The same at the start, unweighted.
    overlap: Share of all moving points whose nearest fixed point is within `max_distance`, at the
        end.
    inliers: Number of moving points within 4.5 times the median of the distances used.
    correlation: Correlation of the signed distances of neighbors, in [-1, 1]: near 0 for noise,
        near 1 if whole regions deviate to one side.
    uncertainty: Estimated standard deviation of the position, as a root mean square over the
        points, from the residuals and the stiffness of the motions. Motions that `undetermined`
        counts are left out.
    scale: The scale found, in addition to that of `start`.
    converged: Whether `outcome` is 'converged'.
    iterations: Steps from the best start.
    undetermined: Number of independent motions that the data do not determine, such as a plane
        sliding on a plane.
    message: The outcome as a clause for people, without a full stop.
    outcome: 'converged', 'out_of_iterations', 'doubtful' or 'nothing_to_align'.
    best_start: Number of the best start; 0 is the present position.
    """

    matrix: Floats
    mesh: Mesh
    rms: float
    rms_at_start: float
    overlap: float
    inliers: int
    correlation: float
    uncertainty: float
    scale: float
    converged: bool
    iterations: int
    undetermined: int
    message: str
    outcome: str
    best_start: int

    def __bool__(self) -> bool:
        return self.converged


def align(moving: MeshOrCloud, fixed: MeshOrCloud, *, scale: bool | tuple[float, float] = False,
          method: str = "automatic", overlap: float = 1.0, robust: bool = True,
          max_distance: float = np.inf, max_iterations: int = 100, tolerance: float = 1e-6,
          starts: int = 1, max_samples: int = 100_000, start: ArrayLike | None = None,
          precision: str = "float64", progress: Progress = None) -> Alignment:
    """The rigid motion, with a uniform scale if requested, that brings the moving points near the
    fixed mesh, or near its points if it has no faces.

    From each start this is a local optimum: the right one if the motion is small compared with the
    features of the shape. The result is never worse than the present position; if nothing better is
    found, it is `start`, scaled about its center to the bounds of the scale. Results are compared
    by a mean of squared distances to the nearest fixed points, each at most `max_distance` squared,
    over the nearest `overlap` share of the points. If `robust`, or with an overlap below 1, they
    are compared by the mean of Welsch's function with the final v instead, so that an overlap
    somewhat too large does no harm. Motions in which points slide freely (a plane on a plane) are
    not made. Equal points of a cloud count once.

    Along motions with a stiffness below 0.02, such as the rotation of a gear about its axis,
    positions up to 6% of the diagonal away are also tried.

    Small distances alone do not prove that a result is correct. In a correct alignment residuals
    are noise; in a wrong one, whole regions deviate to one side. With 4000 moving points or more,
    every fourth is held out of the fit and used for this test. If its residuals are more than
    noise, other starts around `start` are tried: shifts by 8% of the diagonal, rotations by 14
    degrees. If residuals are still more than noise: on a fixed cloud, the result is `doubtful` if
    they exceed 0.6 times the thickness of both point sets around their fitted planes. On a fixed
    mesh, it is `doubtful` if another start, tried with few points, ends better, or if the deviation
    exceeds 0.2% of the diagonal.

    If `moving` or `fixed` has no points, the result is `start`, not converged.

    scale: also find a uniform scale; a pair gives its lower and upper bound, relative to the scale
        of `start`.
    method: 'point_to_plane', 'point_to_point', 'automatic' or 'plane_to_plane'.
    overlap: Share of the moving points that have a partner (a corresponding fixed point), in (0,
        1]. Each step uses this share of the points, those with the nearest partners.
    robust: Weight partners at distance d by exp(-d^2 / (2 v^2)) (Welsch), so that up to half of the
        points may have no partner, without a given `overlap`. v starts at 3 times the median
        distance, and is halved while at least a third of the points are within v; finally it is 4.5
        times the median of the near distances. If false, all partners have the same weight.
    max_distance: Ignore partners farther apart than this. Not squared, not negative.
    max_iterations: Largest number of steps from each start.
    tolerance: Converged if the cost falls by less than this share in each of 5 consecutive steps,
        or if a step moves no point near the fixed mesh by more than 1e-11 of the diagonal of the
        fixed mesh's box.
    starts: Number of starts, at least 1. The first is the present position; then the principal axes
        of `moving` and `fixed` aligned, in the 4 possible ways; then rotations spread evenly over
        all rotations, small ones first, with aligned centers. The best result is returned; of equal
        results the first.
    max_samples: Use at most this many moving points in the steps, spread evenly over space; 0 is
        all.
    start: (4, 4) Applied to the moving points first, which gives the "present position"; any affine
        map.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError naming a point that is not finite or a face with a corner out of range; for an
    option out of its range; OverflowError if the matrix, a rounded point, or a squared distance
    relative to the fixed mesh's diagonal overflows double.

    Cost: the index of `closest_point` over the fixed mesh; nearest points of all moving points at
    the start and at the end, and of the samples in each step (for a fixed cloud, only of those
    whose nearest point may have changed). Each further start: about 20 steps with 1000 points.

    >>> import treeform
    >>> part = treeform.read("data/two_spheres.stl")
    >>> found = treeform.align(part.vertices + [0.02, 0.01, 0], part)
    >>> bool(found), abs(found.matrix[:3, 3] + [0.02, 0.01, 0]).max() < 1e-6
    (True, True)
    """
    how = options(_core.AlignOptions, locals(), **scale_of(scale))
    return _core.align(held_body(moving), held_body(fixed), how, progress=progress)


class PackedPart(NamedTuple):
    """A part on a plate.

    placed: Whether a position was found.
    plate: Number of its plate, from 0.
    matrix: (4, 4) new = M * old, a rotation about z and a translation; the identity if the part is
        not placed. Vertices differ from it by a few units in the last place of the largest
        coordinate.
    mesh: The moved part; the unmoved part if it is not placed.
    """

    placed: bool
    plate: int
    matrix: Floats
    mesh: Mesh

    def __repr__(self) -> str:
        return tuple_repr(self)


@dataclass(frozen=True, repr=False)
class Packing(Result):
    """Filled plates. True if every part was placed.

    parts: In the order of the input.
    not_placed: (n,) numbers of parts without a position, ascending.
    plates_used: Plates with a part.
    tries: Number of tries made.
    density: Share of the area of the used plates that their parts cover, by the raster; with
        `stack`, share of the volume that the solids fill, cavities included.
    message: The outcome as a clause for people, without a full stop.
    """

    parts: list[PackedPart]
    not_placed: Ids
    plates_used: int
    tries: int
    density: float
    message: str

    def __bool__(self) -> bool:
        return len(self.not_placed) == 0


def pack(parts: Iterable[MeshOrCloud], size: ArrayLike, *, corner: ArrayLike = (0.0, 0.0, 0.0),
         spacing: float = 2.0, turns: int = 4, stack: bool = False, plates: int = 1,
         plate_step: ArrayLike = (0.0, 0.0, 0.0), seed: int = 0, tries: int = 32,
         seconds: float = np.inf, precision: str = "float64", progress: Progress = None) -> Packing:
    """Places the parts on plates, each rotated about z by one of `turns`. Unless stacked, each part
    stands on the bed with its lowest point.

    For the rounded coordinates:
    - The lowest z of a placed part is exactly that of the bed (with float32, the least number not
      below it); of a stacked part, it is not below the bed.
    - No coordinate is outside the plate or above its height.
    - Any two placed parts of a plate are at least `spacing` apart, by their exact boxes or by
      `distance` minus its error, and no part is inside another. With a spacing of 0, parts may only
      touch in a plane that separates their boxes.

    No part is placed in a void that is closed all around.

    This is a heuristic search: a place may exist for a part that is not placed. In the first try,
    parts are placed in descending order of the area that they cover. Each part goes to the first
    plate with room, to the free position with the least y, then the least x, on a raster of about
    512 cells a side. Then it is moved toward lower y and x until it meets an obstacle. With
    `stack`, the order is by volume, z comes before y, and the raster has about 96 cells a side.
    While parts are not placed, other orders and rotations are tried: at random by the seed, and
    with unplaced parts first. With several plates, tries also go on while more plates are used than
    the area requires. The result is the try with the most parts placed, then with the least area
    unplaced, then with the fewest plates, then the earliest.

    Empty parts occupy no space: they are placed at their present position. Points that no face uses
    move along with their part and are otherwise ignored. Equal parts are prepared once.

    size: (2,) or (3,) the width, depth and height of a plate.
    corner: (3,) The corner of the first plate with the lowest x and y; its z is the bed.
    spacing: Least distance between parts; parts may touch the plate's rim.
    turns: Rotations about the vertical that are tried for each part, evenly over the full circle: 1
        (none), 2, 3, 4, 6, 8, 12 or 24.
    stack: Fill the box up to its height, which must be finite: parts may be above, below and inside
        one another, and hang in the air. Otherwise each part stands on the bed.
    plates: Largest number of plates to use; at least 1.
    plate_step: (3,) from the corner of a plate to that of the next; its z is ignored.
    seed: Seed of the orders and rotations that are tried if not all parts fit.
    tries: Largest number of tries; at least 1.
    seconds: Start no more tries after this many seconds. If that ends the search, the result
        depends on the speed of the machine.
    precision: 'float32' or 'float64'. Precision of the returned points.

    Raises ValueError naming the part with a corner out of range or not finite; for options that are
    negative, NaN, or (except for the height and the seconds) not finite.

    Cost: O(F) for a raster of each part and rotation; in each try a few milliseconds for each part
    and rotation to find a free place; for the chosen place a tree over the part and some `distance`
    to each neighbor. Tries run in parallel.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.pack([cube, cube, cube], [4, 4], spacing=0.5).message
    '3 of 3 parts placed'
    """
    how = options(_core.PackOptions, locals(), size=extent_of(size))
    return _core.pack(each(parts, "parts"), how, progress=progress)


def measure(a: MeshOrCloud, b: MeshOrCloud, *, radius: float = np.inf,
            vertices: str = "by_coordinates", progress: Progress = None) -> Measure | None:
    """The relation of two bodies (disjoint, touching or penetrating), their distance, and the
    nearest points. Each body is a mesh or a cloud (n, 3). Returns None if a mesh has no faces, or
    if the bodies are farther apart than `radius`. The relation is exact, and so is whether the
    distance is 0. Other distances are rounded as in `distance`.

    radius: ignore bodies farther apart than this; inclusive.
    vertices: 'by_coordinates': vertices with equal coordinates are the same vertex; 'by_index':
        only those with the same number.

    Raises ValueError naming the mesh and its lowest face with a corner out of range or not finite;
    for a radius that is negative or NaN.

    Cost: `distance`; if the boxes of the meshes meet, also `mesh_intersections` and `locate`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> how = treeform.measure(cube, (cube.vertices + [0, 0, 3], cube.faces))
    >>> how.relation, how.distance, how.on_a[2], how.on_b[2]
    ('disjoint', 2.0, 1.0, 3.0)
    """
    how = options(_core.MeasureOptions, locals())
    return _core.measure(held_body(a), held_body(b), how, progress=progress)


class Depth(NamedTuple):
    """The separating translation found.

    depth: The length of `move`, rounded.
    move: (3,) Translation that separates them: added to every point of `a`, with each coordinate
        rounded, it ends the penetration.
    effort: The effort of the search. If `skipped_candidates` is not 0, a shorter translation is
        more likely to exist.
    """

    depth: float
    move: Floats
    effort: SearchEffort

    def __repr__(self) -> str:
        return tuple_repr(self)


def penetration_depth(a: MeshOrCloud, b: MeshOrCloud, *, directions: int = 256, effort: int = 0,
                      progress: Progress = None) -> Depth | None:
    """The length of a short translation that separates `a` from `b`: an upper bound of the
    penetration depth, which is the length of the shortest one. None if they do not penetrate each
    other, or one is a cloud.

    The translation is verified exactly, in the moved coordinates. The search starts with the result
    of `separate`, tries `directions` other directions, and then rotates the best one in ever
    smaller steps as long as it becomes shorter. For nonconvex shapes, a shorter one may exist.

    The search is limited by its effort: a candidate is skipped if testing it would take more than
    1/32 of the effort. So if very many boxes of faces overlap, as with long thin triangles, the
    result may be longer, but at most the translation along an axis past the box of `b`.

    directions: the number of directions, spread over the sphere, to try in addition to the normals
        of intersecting faces.
    effort: limit for the number of pairs of faces that the search examines, where a pair in motion
        counts as two; 0: 20 million, plus 200 for each face.

    Raises ValueError as `measure`.

    Cost: `separate`; an `intersects` for each direction, and a `time_of_impact` for each shorter
    one; at most `effort`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.penetration_depth(cube, (cube.vertices + [0.75, 0, 0], cube.faces)).depth
    0.25
    """
    how = options(_core.MeasureOptions, locals())
    return _core.penetration_depth(held_body(a), held_body(b), how, progress=progress)


class Impact(NamedTuple):
    """The first contact of a moving mesh with another.

    time: The greatest double that is not beyond the exact time t of the contact: `a` moved by
        `time` times the motion has not passed it. 0 if they meet at the start, infinite if never.
    faces: (n, 2) the faces of `a` and `b` that touch at that time.
    points: (n, 3) a common point of each pair, rounded.
    outcome: 'nothing_met', 'contact' or 'starts_touching'.
    """

    time: float
    faces: Ids
    points: Floats
    outcome: str

    def __repr__(self) -> str:
        return tuple_repr(self)


def time_of_impact(a: MeshOrCloud, b: MeshOrCloud, motion: ArrayLike, *,
                   transform_a: ArrayLike | None = None, transform_b: ArrayLike | None = None,
                   latest: float = np.inf, progress: Progress = None) -> Impact:
    """The least t >= 0 at which `a`, moved by t times `motion`, has a common point with `b`.

    Exact on the coordinates as given, or as moved by the options. Times of pairs of faces are
    compared as exact quotients of determinants, so all simultaneous contacts are found, even of
    parallel or coplanar faces. Surfaces count, not solids: inside a closed mesh, `a` moves until it
    meets the surface. Grazing is a contact.

    `a` and `b` are each a mesh or a cloud (n, 3). Points of a cloud count as faces.

    motion: (3,) the translation of `a` in one unit of time.
    transform_a: (4, 4) an affine transform applied to `a` first.
    transform_b: (4, 4) an affine transform applied to `b` first.
    latest: Ignore contacts after this time.

    Raises ValueError for a motion that is zero or not finite; a time that is negative or NaN;
    naming the mesh and its lowest face with a corner out of range or not finite.

    Cost: `intersects`, plus a search along the motion, which excludes most boxes; serial.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.time_of_impact((cube.vertices + [0, 0, 4], cube.faces), cube, [0, 0, -1]).time
    3.0
    """
    how = options(_core.ImpactOptions, locals())
    return _core.time_of_impact(held_body(a), held_body(b), _arrays.vector(motion, "motion"), how,
                                progress=progress)
# end
