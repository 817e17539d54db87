"""Offset, hollowed and thickened solids; simplification; wall thickness; boxes; isolines."""

from __future__ import annotations

# made of uses:
import os
from dataclasses import dataclass
from typing import Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import checked, options
from ._mesh import MeshOrCloud, MeshLike, held, points_of
from ._progress import Progress
from ._repair import MadeMesh
from ._results import Result

__all__ = ["Isoline", "Isolines", "OffsetResult", "OrientedBox", "SimplifyResult", "Thickness",
           "hollow", "isolines", "offset", "oriented_box", "simplify", "thicken", "wall_thickness",
           "wrap"]
# end


def drains_of(drains: ArrayLike) -> Floats:
    """Drain holes as an array (n, 4)."""
    return np.empty((0, 4)) if np.size(drains) == 0 else _arrays.rows(drains, 4, "drains")


# made of headers:
#   Isolines
@dataclass(frozen=True, repr=False)
class Isolines(Result):
    """The isolines of all levels, in the given order of levels.

    lines: The lines; `points_of` returns the points of one.
    points: (n, 3) on edges of the mesh, rounded.
    faces: (points,) the face that contains the segment after each point.
    """

    lines: list[Isoline]
    points: Floats
    faces: Ids
# end

    def points_of(self, line: int) -> Floats:
        """(n, 3) the points of a line; a closed line does not repeat its first point."""
        of = self.lines[line]
        return self.points[of.first_point:of.first_point + of.point_count]

    def write(self, path: Union[str, os.PathLike[str]], *, normal: ArrayLike = (0, 0, 1),
              format: str = "", unit: str = "", progress: Progress = None) -> None:
        """Writes all lines as SVG (seen against the direction of `normal`), DXF, OBJ or JSON,
        according to `format` or the extension; `unit` as for `Section.write`."""
        _core.write_isolines(os.fspath(path), self.lines, self.points,
                             _arrays.vector(normal, "normal"), _arrays.word(format, "format"),
                             _arrays.word(unit, "unit"), progress=progress)


# made of headers:
#   OffsetResult offset hollow thicken wrap SimplifyResult simplify Thickness wall_thickness
#   OrientedBox oriented_box Isoline isolines
@dataclass(frozen=True, repr=False)
class OffsetResult(MadeMesh):
    """An offset, hollowed, thickened or wrapped solid.

    blind_drains: (n,) For `hollow`: numbers of drains that do not lead from outside into a cavity,
        judged by the ends of their axes.
    distance: The given distance, without its sign; for `wrap`, the offset used.
    resolution: The resolution used; for `wrap`, its `size`.
    cells: Cells that the surface may pass through.
    sealed_cavities: For `hollow`: number of cavities without an opening, including those of the
        input.
    tetrahedra: For `wrap`: tetrahedra at the end.
    tetrahedra_points: For `wrap`: points of the tetrahedra.
    filled_tetrahedra: For `wrap`: tetrahedra filled to make the surface manifold.
    least_distance: Lower bound of the distance from any point of the new surface, also inside its
        faces, to the input surface. For `hollow`, the new surface is the surface of the cavities;
        for `thicken`, the distance is to the moved surface. By branch and bound: this and
        `greatest_distance` are within a sixteenth of the resolution of the true extremes. 0 if
        there is no surface, and for `wrap`.
    greatest_distance: Upper bound of the same distances.
    """

    blind_drains: Ids
    distance: float
    resolution: float
    cells: int
    sealed_cavities: int
    tetrahedra: int
    tetrahedra_points: int
    filled_tetrahedra: int
    least_distance: float
    greatest_distance: float


def offset(mesh: MeshLike, distance: float, *, resolution: float | None = None,
           precision: str = "float64", check: bool = True,
           progress: Progress = None) -> OffsetResult:
    """The solid grown by `distance`: points inside, or at most this far from the surface. If
    negative, the solid shrunk: points inside, and at least |distance| from the surface.

    Convex edges and corners become round outward. Edges that the exact offset keeps sharp are cut
    off by at most a cell. The mesh must bound a solid, like an operand of `boolean`; if it meets
    itself, the solid that it winds around is used. What is inside is decided exactly. Vertices are
    at the given distance, up to about a thousandth of a cell.

    resolution: Edge length of the cells from which the surface is made, in the mesh's length unit;
        at most half of the distance. Every point whose distance differs from the given one by more
        than twice the resolution is on the right side of the surface. Smaller details may be lost.
        None: a quarter of the distance, at most 1/64 of the diagonal of the result; larger, up to
        half of the distance, if there would be more than about 2^16 cells at the surface (170,000
        faces). `OffsetResult` has the value used, and the error.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh is open, NotCertifiedError if the result could not be
    certified; ValueError as `boolean`; for a distance that is 0 or not finite; for a resolution
    that is not positive, more than half of the distance, below the spacing of the coordinates, or
    so fine that there would be more than 2^22 cells: the message names a sufficient one.

    Cost: O(A log F) for A cells, about 3 area / resolution^2; 600 bytes a cell.

    >>> import treeform
    >>> grown = treeform.offset(treeform.read("data/cube.stl"), 0.25, resolution=0.05)
    >>> grown.mesh.is_solid, 2.9 < grown.mesh.volume < 3.3
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return checked(_core.offset(held(mesh), _arrays.number(distance, "distance"), how,
                                progress=progress), check, of="")


def hollow(mesh: MeshLike, wall: float, *, drains: ArrayLike = (), resolution: float | None = None,
           precision: str = "float64", check: bool = True,
           progress: Progress = None) -> OffsetResult:
    """Hollows the solid: its points deeper inside than `wall` become cavities; the outer surface
    stays bit for bit. The cavities are made of flat faces, so the wall may be thinner than given:
    `OffsetResult.least_distance` is a lower bound. The status is `vanished` if there is no cavity.

    `drains` are holes through the wall: a point and a diameter. Each runs from the point of the
    surface nearest to the given one, along the shortest segment to a cavity. It is a regular prism
    of 32 sides; the diameter is that of the circle through its corners. It extends beyond both ends
    by its diameter, but at most half of the way to the next surface.

    drains: (n, 4) drain holes through the wall: for each, a point and a diameter. The hole is at
        the surface point nearest to that point.
    resolution: Edge length of the cells from which the surface is made, in the mesh's length unit;
        at most half of the distance. Every point whose distance differs from the given one by more
        than twice the resolution is on the right side of the surface. Smaller details may be lost.
        None: a quarter of the distance, at most 1/64 of the diagonal of the result; larger, up to
        half of the distance, if there would be more than about 2^16 cells at the surface (170,000
        faces). `OffsetResult` has the value used, and the error.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh is open, NotCertifiedError if the result could not be
    certified; ValueError as `offset`; for a wall that is not positive; for a drain that is not
    finite, or with a diameter that is not positive.

    Cost: as `offset` and `difference`.

    >>> import treeform
    >>> shell = treeform.hollow(treeform.read("data/cube.stl"), 0.1, resolution=0.05)
    >>> shell.mesh.is_solid, 0.4 < shell.mesh.volume < 0.55
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return checked(_core.hollow(held(mesh), _arrays.number(wall, "wall"), drains_of(drains), how,
                                progress=progress), check, of="")


def thicken(mesh: MeshLike, thickness: float, *, resolution: float | None = None,
            shift: float = 0.0, precision: str = "float64", check: bool = True,
            progress: Progress = None) -> OffsetResult:
    """A solid around any surface: all points at most half of `thickness` away. Its rim is round.

    With a `shift`, the surface is first moved toward its front, the side from which faces are seen
    counter-clockwise. Each vertex moves so that the planes of its faces move by the shift, on
    average. This is exact where the surface is flat; where it bends, it becomes rounder. Vertices
    of sharp folds move by at most twice the shift. Faces must be consistently oriented.

    resolution: Edge length of the cells from which the surface is made, in the mesh's length unit;
        at most half of the distance. Every point whose distance differs from the given one by more
        than twice the resolution is on the right side of the surface. Smaller details may be lost.
        None: a quarter of the distance, at most 1/64 of the diagonal of the result; larger, up to
        half of the distance, if there would be more than about 2^16 cells at the surface (170,000
        faces). `OffsetResult` has the value used, and the error.
    shift: move the surface by this distance before thickening: toward its front if positive, toward
        its back if negative. By default, half of the thickness is added on each side; with half of
        the thickness as `shift`, all of it is added on the front.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotCertifiedError if the result could not be certified; ValueError as `offset`, with half
    of the thickness as the distance; for a mesh without faces; for a shift that is not finite; with
    a shift, naming a face that is inconsistent with its neighbor.

    Cost: as `offset`.

    >>> import treeform
    >>> sheet = treeform.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> plate = treeform.thicken(sheet, 0.2)
    >>> plate.mesh.is_solid, 0.2 < plate.mesh.volume < 0.32
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return checked(_core.thicken(held(mesh), _arrays.number(thickness, "thickness"), how,
                                 progress=progress), check, of="")


def wrap(mesh: MeshLike, size: float, *, offset: float | None = None, precision: str = "float64",
         check: bool = True, progress: Progress = None) -> OffsetResult:
    """Alpha wrapping: a solid that contains all faces of `mesh`, which may be open, intersecting,
    inconsistently oriented or degenerate. The wrap is the surface that a ball of radius `size`
    cannot pass when rolled over the mesh from outside: holes and gaps narrower than the ball are
    closed, sharp edges are rounded, and cavities without an opening for the ball are filled. A
    smaller size follows the mesh more closely, with more faces: about area / `size`^2.

    No face of the mesh meets the wrap or is outside of it: this is verified exactly, on the
    coordinates of both. The wrap's vertices are at the offset from the mesh, up to rounding.

    offset: the distance of the wrap's vertices from the mesh, in its length unit. None: a thirtieth
        of `size`.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotCertifiedError if the result could not be certified; ValueError naming a face with a
    corner out of range or not finite; for a mesh without faces, larger than 2^150 or smaller than
    2^-150; for a size or offset that is not positive and finite; for an offset near the spacing of
    the coordinates; for a wrap of more than 2^30 faces.

    Cost: O(n log n) for n points in most cases, with O(n) queries of a tree over the F faces; about
    400 bytes a point; serial.

    >>> import treeform
    >>> around = treeform.wrap(treeform.read("data/two_spheres.stl"), 0.5)
    >>> around.mesh.is_solid, bool(around.certificate)
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return checked(_core.wrap(held(mesh), _arrays.number(size, "size"), how,
                              progress=progress), check, of="")


@dataclass(frozen=True, repr=False)
class SimplifyResult(MadeMesh):
    """A mesh with fewer faces.

    face_source: (F,) the input face of each face.
    collapses: Edges collapsed.
    refused_by_topology: Edges whose collapse would change the topology.
    refused_by_turning: Edges whose collapse would turn a face too far.
    refused_by_distance: Edges whose collapse was not proven within the distance.
    refused_by_contact: Edges whose collapse would make faces meet.
    input_to_result_bound: Bound of the distance from any input point to the result.
    result_to_input_bound: Bound of the distance from any point of the result to the input.
    vertex_source: (V,) input vertex equal to each vertex; `NONE`: new.
    face_of_new_vertex: (V,) for a new vertex, the nearest input face on its side of seams; else
        `NONE`.
    corner_source: (3 F,) for each corner, an input corner (3 f + i for corner i of face f) at its
        vertex, on the same side of seams; none at new vertices.
    fixed_vertices: Number of vertices that cannot be removed, since they are at nonmanifold edges
        or vertices.
    """

    face_source: Ids
    collapses: int
    refused_by_topology: int
    refused_by_turning: int
    refused_by_distance: int
    refused_by_contact: int
    input_to_result_bound: float
    result_to_input_bound: float
    vertex_source: Ids
    face_of_new_vertex: Ids
    corner_source: Ids
    fixed_vertices: int


def simplify(mesh: MeshLike, max_distance: float, *, face_groups: ArrayLike | None = None,
             precision: str = "float64", target_faces: int = 0, feature_angle: float = 180.0,
             check: bool = True, progress: Progress = None) -> SimplifyResult:
    """The mesh with fewer faces, by edge collapses in the order of their quadric error.

    Input and result are within `max_distance` of each other: this is proven for each face, not
    sampled. No collapse makes faces meet, exactly, on the coordinates returned; faces of the input
    that meet may still meet. A closed, oriented manifold remains a closed, oriented manifold. The
    nesting of components is only checked at the end, in the certificate.

    Borders, features, and borders of groups are simplified as polylines, within the same distance:
    vertices on them are removed, but not moved. Vertices stay where such lines end, branch or
    cross, at nonmanifold or inconsistently oriented edges, and where their faces are not one fan.

    Nothing is collapsed if the distance is below about 2^-46 of the largest coordinate, which
    doubles cannot prove, or if squares of coordinates overflow or underflow. Corners with equal
    coordinates are one vertex; faces with two equal corners are dropped, and distances do not take
    them into account.

    Values of vertices and corners are interpolated. Seams, and borders between faces with different
    materials or values, are preserved.

    face_groups: (F,) a group number for each face; borders between groups are preserved, too.
    precision: 'float32' or 'float64'. Precision of the returned points. With float32, all points
        are rounded first, and the bounds include this; values are stored as doubles.
    target_faces: Stop at this number of faces.
    feature_angle: Edges are features if the normals of their faces differ by more than this, in
        degrees; 180: none.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotCertifiedError if the result could not be certified; ValueError for a distance that is
    negative or not finite, for a number of groups other than that of faces or corners; naming a
    face with a corner that is out of range or not finite.

    Cost: O(n log n) for n collapses, 50 to 150 microseconds each, serial; more if a face replaces
    many; 1 kB a face; plus `find_solid_defects` before and after.

    >>> import treeform
    >>> few = treeform.simplify(treeform.read("data/two_spheres.stl"), 0.05)
    >>> len(few.mesh.faces) < 500, few.input_to_result_bound <= 0.05
    (True, True)
    """
    how = options(_core.SimplifyOptions, locals())
    return checked(_core.simplify(held(mesh), _arrays.number(max_distance, "max_distance"),
                                  _arrays.labels(face_groups, "face_groups"), how,
                                  progress=progress), check, of="")


@dataclass(frozen=True, repr=False)
class Thickness(Result):
    """The thickness at each face, and the least thickness.

    of_face: (F,) The thickness at each face; infinite if nothing is behind it, or if it has no
        area.
    thinnest: The lowest face with the least thickness.
    min: Smallest thickness of all faces.
    """

    of_face: Floats
    thinnest: int
    min: float


def wall_thickness(mesh: MeshLike, by: str = "ray", *, progress: Progress = None) -> Thickness:
    """The wall thickness of a solid at each face. The face through which a ray leaves is exact, for
    the rounded center and normal; lengths are rounded. Balls are accurate to 2^-20 of their
    diameter. Near a sharp edge, balls are small: there, their diameter is not the thickness of a
    wall.

    by: 'ray': along the inward normal from the center of each face; 'sphere': the diameter of the
        largest inscribed sphere that touches the center of the face.

    Raises ValueError naming a face with a corner out of range or not finite.

    Cost: a `raycast_all` for each face, and about ten `closest_point` for each ball.

    >>> import treeform
    >>> treeform.wall_thickness(treeform.read("data/cube.stl")).min
    1.0
    """
    return _core.wall_thickness(held(mesh), _arrays.word(by, "by"), progress=progress)


@dataclass(frozen=True, repr=False)
class OrientedBox(Result):
    """A box in any orientation.

    center: (3,) center of the box.
    axes: (3, 3) Unit axes, right-handed, rounded: along the longest, middle and shortest side.
    size: (3,) lengths along these axes.
    """

    center: Floats
    axes: Floats
    size: Floats


def oriented_box(points: MeshOrCloud, *, progress: Progress = None) -> OrientedBox | None:
    """A box of small volume around points. It is the smallest of these: the axis-aligned box, and
    all boxes with a side in a side of the convex hull and another along an edge of that side. For
    coplanar points, the one of least area. None without points. For a hull of more than a few
    thousand sides, only the largest sides are tried, up to 2^26 corners of sides.

    Axes, center and size are rounded: a point may be outside by 2^-48 of the largest coordinate.

    points: points (n, 3), or a mesh.

    Raises ValueError as `convex_hull`.

    Cost: `convex_hull`, and O(S H log H) for S sides and H corners of the hull.

    >>> import treeform
    >>> treeform.oriented_box(treeform.read("data/cube.stl")).size.tolist()
    [1.0, 1.0, 1.0]
    """
    return _core.oriented_box(points_of(points), progress=progress)


@dataclass(frozen=True, repr=False)
class Isoline(Result):
    """A line on a mesh along which a value equals a level.

    level: The value along the line.
    first_point: Number of its first point; its points are consecutive.
    point_count: Number of its points.
    closed: Whether the last point is joined to the first; otherwise the line ends at borders of the
        mesh.
    oriented: Whether the faces along it are consistently oriented: seen from outside, larger values
        are to its left.
    length: Sum of the lengths of its segments.
    """

    level: float
    first_point: int
    point_count: int
    closed: bool
    oriented: bool
    length: float


def isolines(mesh: MeshLike, values: ArrayLike, levels: ArrayLike, *,
             progress: Progress = None) -> Isolines:
    """Lines at given levels of a value: `values` has one value for each vertex, interpolated
    linearly in each face.

    Lines are decided exactly; their points are interpolated and rounded. A vertex at a level counts
    as above it, as in `section`: with heights as values, the lines are sections by planes
    perpendicular to z. Vertices with equal coordinates are joined if their values are equal;
    otherwise lines end there.

    values: (V,) a value for each vertex, interpolated linearly over each face.
    levels: (K,) the values of the lines.

    Raises ValueError naming a face with a corner out of range or not finite, a corner or level with
    a value that is not finite, or if there is not one value for each vertex.

    Cost: O(V log K + F + S log S) for K levels and S segments of lines.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> lines = treeform.isolines(cube, cube.vertices[:, 2], [0.25, 0.5])
    >>> [(line.closed, line.length) for line in lines.lines]
    [(True, 4.0), (True, 4.0)]
    """
    return _core.isolines(held(mesh), _arrays.floats(values, "values"),
                          np.atleast_1d(_arrays.floats(levels, "levels")), progress=progress)
# end
