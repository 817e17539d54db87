"""Where a mesh goes: moved against others, laid on a bed, aligned, packed; and how two lie."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, NamedTuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._core import Certificate
from ._errors import need, options
from ._mesh import Mesh, MeshLike, MeshResult, held, held_body
from ._progress import Progress
from ._properties import Feature
from ._results import Result, tuple_repr

__all__ = ["Alignment", "Body", "Contacts", "Depth", "Impact", "LaidFlat", "Measure", "PackedPart",
           "Packing", "Placement", "SearchEffort", "align", "drop", "lay_flat", "mate",
           "mate_features", "measure", "pack", "penetration_depth", "separate", "slide",
           "time_of_impact", "turn"]

#: A mesh, or a cloud (n, 3).
Body = Union[MeshLike, ArrayLike]


# made of results:
#   search_effort
class SearchEffort(NamedTuple):
    """The work of a bounded search, in pairs of faces looked at. It depends on the input alone.
    What the search found is valid even where it was cut short.

    pairs: Pairs of faces looked at; a pair in motion counts as two.
    bound: The most that the search was to look at.
    cut: Candidates skipped, since each would take more than 1/32 of the bound, or than what was
        left of it. If not 0, a better answer may exist.
    """

    pairs: int
    bound: int
    cut: int
# end


class Contacts(NamedTuple):
    """Pairs of faces that meet at a place, or keep the clearance there.

    points: (n, 3)
    normals: (n, 3) of length 1, from the fixed to the moving mesh; 0 where there is none.
    moving: (n,) faces of the moving mesh.
    fixed_face: (n,) faces of the fixed mesh; 4294967295 for the bed.
    fixed: (n,) which fixed mesh.
    """

    points: Floats
    normals: Floats
    moving: Ids
    fixed_face: Ids
    fixed: Ids

    def __repr__(self) -> str:
        return tuple_repr(self)


# made of results:
#   mesh_measure
@dataclass(frozen=True, repr=False)
class Measure(Result):
    """How two meshes lie to each other.

    relation: 'separate', 'touching' or 'penetrating'. Exact.
    distance: Not squared. 0 if and only if the meshes touch or penetrate each other.
    surface_distance: Exactly 0 if and only if a face of one meets a face of the other. So it is
        positive for a mesh inside a solid whose surface it does not touch.
    on_a: (3,) the nearest point on the surface of `a`; where they meet, a common one.
    on_b: (3,) the nearest point on the surface of `b`; where they meet, a common one.
    face_a: The face of `a` that `on_a` is on.
    face_b: The face of `b` that `on_b` is on.
    a_inside_b: A part of `a` lies inside the solid `b` and does not touch `b`.
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
# end


# made of results:
#   placement
@dataclass(frozen=True, repr=False)
class Placement(MeshResult):
    """Where a mesh goes. True where it has a place; else `message` says why not.

    mesh: The moved mesh, in coordinates that have been checked; where it was, if it has no place.
    matrix: (4, 4) new = M * old: a translation. `points` are moved by it and rounded once, except
        for those that are set on the bed.
    end: Why it ended there: 'contact', 'bed', 'stays', 'moved_apart', 'nothing_met', 'too_far',
        'starts_penetrating', 'starts_too_near', 'starts_touching', 'starts_below_bed',
        'no_coordinates', 'too_many_steps', 'out_of_range'.
    message: Half a sentence; empty where there is a place.
    direction: (3,) of the travel, of length 1; 0 when there is none.
    travel: A length; for `too_far` the one that would be needed.
    at_start: Exact: 'separate', 'touching', 'penetrating', 'closer_than_clearance' or 'clear'.
    at_place: The same at the place: 'separate', 'touching', 'penetrating', 'closer_than_clearance'
        or 'clear'.
    contacts: Pairs of faces that meet there, or keep the clearance.
    contact_count: Of all, listed or not.
    nearest: The fixed mesh that matters most, and how the mesh lies to it; None where all are far.
    certificate: What was checked about the coordinates.
    effort: Of `separate`: what its search took. Where some of its questions were cut, a shorter way
        may exist; without a place, one that was not found.
    angle: Of `turn` and `mate_features`: in degrees.
    tolerance: Of `turn`: the gap beyond the clearance that counts as contact.
    offset: Of `mate_features`: how far the center of the moving feature ended from the fixed one.
    """

    mesh: Mesh
    matrix: Floats
    end: str
    message: str
    direction: Floats
    travel: float
    at_start: str
    at_place: str
    contacts: Contacts
    contact_count: int
    nearest: tuple[int, Measure] | None
    certificate: Certificate
    effort: SearchEffort
    angle: float = 0.0
    tolerance: float = 0.0
    offset: float = 0.0
# end

    def __bool__(self) -> bool:
        return bool(self.certificate)


def _bodies(fixed: Any) -> list[_core.HeldMesh]:
    """Fixed bodies: one, or a list of them."""
    if fixed is None:
        return []
    if isinstance(fixed, (list, tuple)) and not _arrays.is_pair(fixed):
        return [held_body(one) for one in fixed]
    return [held_body(fixed)]


def slide(moving: Body, onto: Any, direction: ArrayLike, clearance: float = 0.0, *,
          max_travel: float | None = None, bed: float | None = None, precision: str = "float64",
          progress: Progress = None) -> Placement:
    """Moves a mesh along a direction until it first meets others, or comes as near as the
    clearance. It does not penetrate in the coordinates returned: they are checked exactly.

    moving: a mesh, or points (n, 3). onto: a fixed body, or a list of them.
    direction: (3,) of any length. max_travel: a length. bed: z of a bed that also stops it.

    Raises ValueError naming the operand and face.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> seated = treeform.slide((cube.vertices + [0.25, 0, 5], cube.faces), cube, [0, 0, -1])
    >>> bool(seated), seated.travel, seated.at_place
    (True, 4.0, 'touching')
    """
    how = options(_core.SlideOptions, locals())
    return _core.slide(held_body(moving), _bodies(onto), _arrays.vector(direction, "direction"),
                       how,
                       progress=progress)


def drop(moving: Body, onto: Any = None, *, clearance: float = 0.0,
         max_travel: float | None = None, bed: float | None = None,
         direction: ArrayLike = (0.0, 0.0, -1.0), precision: str = "float64",
         progress: Progress = None) -> Placement:
    """Moves a mesh down until it rests on the bed (z = 0 unless told), or on `onto`; from below the
    bed it goes up. The lowest points then have exactly the z of the bed.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> low = treeform.drop((cube.vertices + 3.25, cube.faces))
    >>> low.travel, low.mesh.bounds[:, 2].tolist()
    (3.25, [0.0, 1.0])
    """
    how = options(_core.DropOptions, locals(), direction=_arrays.vector(direction, "direction"))
    return _core.drop(held_body(moving), _bodies(onto), how, progress=progress)


def mate(moving: Body, onto: Any, *, clearance: float = 0.0, max_travel: float | None = None,
         precision: str = "float64", progress: Progress = None) -> Placement:
    """Translates a mesh so that its nearest points to others come together, or to the clearance.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.mate((cube.vertices + [0, 3, 0], cube.faces), cube).travel
    2.0
    """
    how = options(_core.MateOptions, locals())
    return _core.mate(held_body(moving), _bodies(onto), how, progress=progress)


def separate(moving: Body, fixed: Any, clearance: float = 0.0, *, max_travel: float | None = None,
             effort: int = 0, precision: str = "float64", progress: Progress = None) -> Placement:
    """Translates a mesh to where it penetrates none of the others and keeps the clearance; it stays
    where it already does. Some fifty directions are tried.

    effort: pairs of faces to look at, at most; 0: 20 million and 200 for each face.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> apart = treeform.separate((cube.vertices + [0.75, 0, 0], cube.faces), cube)
    >>> apart.travel, apart.at_start, apart.at_place
    (0.25, 'penetrating', 'touching')
    """
    how = options(_core.SeparateOptions, locals())
    return _core.separate(held_body(moving), _bodies(fixed), how, progress=progress)


def turn(moving: Body, fixed: Any, axis: ArrayLike, origin: ArrayLike = (0.0, 0.0, 0.0), *,
         clearance: float = 0.0, max_angle: float = 360.0, tolerance: float | None = None,
         precision: str = "float64", progress: Progress = None) -> Placement:
    """Turns a mesh about an axis, counter-clockwise seen against it, until it comes within the
    tolerance of others, or of the clearance from them. `angle` is in degrees.

    axis: (3,) of any length. origin: (3,) a point on it. tolerance: the gap that counts as contact;
    None: 2**-32 of the largest distance from the axis.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> door = treeform.turn(cube, (cube.vertices + [-1.5, 0, 0], cube.faces), [0, 0, 1])
    >>> bool(door), 0 < door.angle < 180
    (True, True)
    """
    how = options(_core.TurnOptions, locals())
    return _core.turn(held_body(moving), _bodies(fixed), _arrays.vector(axis, "axis"),
                      _arrays.vector(origin, "origin"), how, progress=progress)


def mate_features(moving: Body, onto: Any, of_moving: Feature, of_fixed: Feature, *,
                  clearance: float = 0.0, flip: bool = False, precision: str = "float64",
                  progress: Progress = None) -> Placement:
    """Brings two planes face to face, or two axes on one line, and slides until first contact.

    of_moving, of_fixed: of `find_features`. flip: planes look the same way; axes are turned around.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> other = (cube.vertices + [0, 0, 5], cube.faces)
    >>> side, top = treeform.find_features(other)[0], treeform.find_features(cube)[0]
    >>> treeform.mate_features(other, cube, side, top).at_place
    'touching'
    """
    need(of_moving, "of_moving", Feature)
    need(of_fixed, "of_fixed", Feature)
    if of_moving.kind != of_fixed.kind:
        raise ValueError(f"of_fixed: {of_fixed.kind!r}, but of_moving is {of_moving.kind!r}")
    how = options(_core.FeatureMateOptions, locals())
    return _core.mate_features(
        held_body(moving), _bodies(onto), of_moving.kind, of_moving.origin, of_moving.direction,
        of_fixed.origin, of_fixed.direction, how, progress=progress)


# made of results:
#   laid_flat
@dataclass(frozen=True, repr=False)
class LaidFlat(MeshResult):
    """A mesh on the bed.

    mesh: The mesh on the bed.
    matrix: (4, 4) new = M * old, a rotation and a translation. `points` differ from it by a few
        units in the last place of the largest coordinate, old or new.
    chosen: Number in `sides`.
    message: Half a sentence for people.
    areas: (S,) of the flat sides of the convex hull, largest first.
    normals: (S, 3) outward, before the turn.
    tip_angles: (S,) degrees of tilt at which it tips over; negative: by itself.
    overhangs: (S,) area of the faces that would need support; NaN where it was not computed.
    center_of_mass: (3,) before the turn, rounded.
    mass: What that is the center of: 'solid', 'surface' or 'points'.
    on_bed: (n,) points of that side, ascending.
    certificate: What was checked about the coordinates.
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
    mass: str
    on_bed: Ids
    certificate: Certificate
# end


def lay_flat(mesh: MeshLike, *, choose: str = "largest", toward: ArrayLike = (0.0, 0.0, 0.0),
             keep_spin: bool = False, tolerance: float = 0.0, bed: float = 0.0,
             overhang_angle: float = 45.0, precision: str = "float64",
             progress: Progress = None) -> LaidFlat:
    """Turns a mesh so that a flat side of its convex hull is on the bed.

    choose: 'largest' area, 'nearest_normal' to the direction `toward`, 'holding_point' `toward`, or
    'most_stable'. keep_spin: only bring the side down. tolerance: points this far from the plane of
    a side belong to it. overhang_angle: in degrees from the vertical.

    Raises ValueError where there is no side: fewer than three points, or all on a line.

    >>> import treeform
    >>> laid = treeform.lay_flat(treeform.read("data/cube.stl"))
    >>> laid.message, laid.mesh.bounds[0, 2]
    ('on side 0 of 6, of area 1', 0.0)
    """
    how = options(_core.LayFlatOptions, locals(), toward=_arrays.vector(toward, "toward"))
    made = _core.lay_flat(held(mesh), how, progress=progress)
    if made is None:
        raise ValueError("lay_flat: no side: fewer than three points, or all on a line")
    return made


# made of results:
#   align_result
@dataclass(frozen=True, repr=False)
class Alignment(MeshResult):
    """The motion that `align` has found.

    matrix: (4, 4) new = M * old, with `start` included. Far from the origin its last column is
        large, and so is its rounding. There, new = `pivot_moved` + (linear part of M) * (old -
        `pivot`) is more accurate.
    mesh: The moved mesh; of a cloud, one without faces.
    rms: Root mean square of the distances that count, after, by weights if there are; 0 for none.
        Of two clouds by `plane_to_plane`, the distances to the planes, as far as both sides agree.
    rms_at_start: The same at the start, without weights.
    overlap: Share of all moving points whose nearest fixed point is within `max_distance`, after.
    inliers: How many of the moving points are within 4.5 medians of the distances that count.
    correlation: Correlation of the signed distances of neighbors, in [-1, 1]: near 0 where they are
        noise, near 1 where whole regions are off to one side.
    uncertainty: How far the points may be from where they belong: the standard deviation that the
        distances leave, and how little they hold, as a root mean square over the points; without
        the motions that `undetermined` counts.
    scale: The scale found, in addition to that of `start`.
    end: 'converged', 'out_of_iterations', 'doubtful' or 'nothing_to_align'.
    converged: `end` is `converged`.
    iterations: Steps from the best start.
    start: Which start that was: 0 is the present position.
    undetermined: How many independent motions nothing holds, as where a plane slides on a plane.
    message: Half a sentence for people.
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
    end: str
    converged: bool
    iterations: int
    start: int
    undetermined: int
    message: str
# end

    def __bool__(self) -> bool:
        return self.converged


def align(moving: Body, onto: Body, *, method: str = "automatic", overlap: float = 1.0,
          weights: str = "welsch", max_distance: float = np.inf,
          scale: bool | tuple[float, float] = False,
          max_iterations: int = 100, tolerance: float = 1e-6, starts: int = 1,
          samples: int = 100_000, start: ArrayLike | None = None, precision: str = "float64",
          progress: Progress = None) -> Alignment:
    """The rigid motion that brings a mesh or cloud (n, 3) near another one: iterative closest
    point, from where it is or from several places.

    method: 'point_to_plane', 'point_to_point', 'plane_to_plane' (of two clouds) or 'automatic'
    (planes of a mesh, planes of both clouds). overlap: the share of the moving points that have a
    partner. weights: 'welsch', by which far pairs count less, or 'equal'.
    max_distance: ignore partners further apart. scale: find a uniform scale, too; a pair is its
    bounds, in addition to the scale of `start`.
    starts: places to start from, turned all around. samples: points used in the steps; 0 is all.
    start: (4, 4) applied first.

    True where it has converged and nothing speaks against the place.

    >>> import treeform
    >>> part = treeform.read("data/two_spheres.stl")
    >>> found = treeform.align(part.vertices + [0.02, 0.01, 0], part)
    >>> bool(found), abs(found.matrix[:3, 3] + [0.02, 0.01, 0]).max() < 1e-6
    (True, True)
    """
    arguments = locals()
    least, most = 0.0, np.inf
    if not isinstance(scale, (bool, np.bool_)):
        least, most = _arrays.pair(scale, "scale")
        scale = True
    how = options(_core.AlignOptions, arguments, scale=bool(scale), least_scale=least,
                  most_scale=most, start=_arrays.matrix(start, "start"))
    return _core.align(held_body(moving), held_body(onto), how, progress=progress)


# made of results:
#   packed_part
class PackedPart(NamedTuple):
    """A part on a plate.

    placed: It has a place.
    plate: Number of its plate, from 0.
    matrix: (4, 4) new = M * old, a turn about z and a translation; the identity when the part is
        not placed. `points` differ from it by a few units in the last place of the largest
        coordinate.
    mesh: The part where it goes; where it was, if it is not placed.
    """

    placed: bool
    plate: int
    matrix: Floats
    mesh: Mesh
# end


# made of results:
#   packing
@dataclass(frozen=True, repr=False)
class Packing(Result):
    """Filled plates. True where every part has a place.

    parts: In the order of the input.
    not_placed: (n,) numbers of parts without a place, ascending.
    plates_used: Plates with a part.
    tries: Made.
    density: Share of the plates that the parts on them cover, seen from above, as the raster has
        it; with `stack`, of the boxes that their solids with what they enclose fill.
    message: Half a sentence for people.
    """

    parts: list[PackedPart]
    not_placed: Ids
    plates_used: int
    tries: int
    density: float
    message: str
# end

    def __bool__(self) -> bool:
        return len(self.not_placed) == 0


def pack(parts: Iterable[MeshLike], size: ArrayLike, *, corner: ArrayLike = (0.0, 0.0, 0.0),
         spacing: float = 2.0, turns: str = "quarter", stack: bool = False, plates: int = 1,
         plate_step: ArrayLike = (0.0, 0.0, 0.0), seed: int = 0, tries: int = 32,
         seconds: float = np.inf, precision: str = "float64",
         progress: Progress = None) -> Packing:
    """Puts parts on plates, at least `spacing` apart, each turned about the vertical.

    size: (2,) or (3,): length, depth and height. turns: 'none', 'quarter', 'eighth' or 'any'.
    stack: fill the box up to its height. plates: most that are used, `plate_step` (3,) apart.

    Distances are checked in the coordinates returned. This is a search: a part without a place may
    have had one. Same input, same result, unless `seconds` ends the search.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.pack([cube, cube, cube], [4, 4], spacing=0.5).message
    '3 of 3 parts placed'
    """
    extent = _arrays.floats(size, "size")
    if extent.shape == (2,):
        extent = np.append(extent, np.inf)
    how = options(_core.PackOptions, locals(), size=_arrays.vector(extent, "size"),
                  corner=_arrays.vector(corner, "corner"),
                  plate_step=_arrays.vector(plate_step, "plate_step"))
    return _core.pack([held(part) for part in _arrays.several(parts, "parts")], how,
                      progress=progress)


def measure(a: Body, b: Body, *, radius: float = np.inf, vertices: str = "by_coordinates",
            progress: Progress = None) -> Measure | None:
    """How two bodies lie to each other: separate, touching or penetrating, how far apart, and
    where. Each is a mesh or a cloud (n, 3). None where one has no faces, or they are further apart
    than `radius`. The relation is exact, and so is whether a distance is 0.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> how = treeform.measure(cube, (cube.vertices + [0, 0, 3], cube.faces))
    >>> how.relation, how.distance, how.on_a[2], how.on_b[2]
    ('separate', 2.0, 1.0, 3.0)
    """
    how = options(_core.MeasureOptions, locals())
    return _core.measure(held_body(a), held_body(b), how, progress=progress)


# made of results:
#   penetration_depth_result
class Depth(NamedTuple):
    """The move apart that was found.

    depth: The length of `move`, rounded.
    move: (3,) Adding this to every point of `a`, each coordinate rounded, takes `a` out of `b`:
        then `relation` does not find them penetrating.
    effort: What the search took. Where some of its questions were cut, one more reason why a
        shorter way may exist.
    """

    depth: float
    move: Floats
    effort: SearchEffort
# end

    def __repr__(self) -> str:
        return tuple_repr(self)


def penetration_depth(a: MeshLike, b: MeshLike, *, directions: int = 256, effort: int = 0,
                      progress: Progress = None) -> Depth | None:
    """The length of a short translation that takes `a` out of `b`: an upper bound of the depth of
    penetration. None where they do not penetrate. `directions` are tried beside those of faces.

    effort: pairs of faces to look at, at most; 0: 20 million and 200 for each face.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.penetration_depth(cube, (cube.vertices + [0.75, 0, 0], cube.faces)).depth
    0.25
    """
    how = options(_core.DepthOptions, locals())
    return _core.penetration_depth(held(a), held(b), how, progress=progress)


# made of results:
#   impact
class Impact(NamedTuple):
    """The first contact of two meshes in motion.

    end: 'free', 'contact' or 'at_start'.
    time: The greatest double that is not beyond the exact time t of the contact: `a` moved by
        `time` times the motion has not passed it. 0 when `end` is at_start.
    faces: (n, 2) the faces of `a` and `b` that meet at that time.
    points: (n, 3) a common point of each pair, rounded.
    """

    end: str
    time: float
    faces: Ids
    points: Floats
# end

    def __repr__(self) -> str:
        return tuple_repr(self)


def time_of_impact(a: MeshLike, b: MeshLike, motion: ArrayLike, *,
                   move_a: ArrayLike | None = None, move_b: ArrayLike | None = None,
                   latest: float = np.inf, progress: Progress = None) -> Impact:
    """The least t >= 0 at which `a`, moved by t times `motion` (3,), has a point in common with
    `b`.
    Exact: meshes that only graze each other have a contact. Surfaces count, not solids.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.time_of_impact((cube.vertices + [0, 0, 4], cube.faces), cube, [0, 0, -1]).time
    3.0
    """
    how = options(_core.ImpactOptions, locals(), move_a=_arrays.matrix(move_a, "move_a"),
                  move_b=_arrays.matrix(move_b, "move_b"))
    return _core.time_of_impact(held(a), held(b), _arrays.vector(motion, "motion"), how,
                                progress=progress)
