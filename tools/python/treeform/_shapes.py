"""Solids grown, shrunk, hollowed; surfaces made thick; fewer faces; thickness; boxes; isolines."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import options, require
from ._mesh import MeshLike, as_mesh, cloud_of, held
from ._progress import Progress
from ._repair import MadeMesh
from ._results import Result

__all__ = ["Isoline", "Isolines", "OffsetResult", "OrientedBox", "SimplifyResult", "Thickness",
           "hollow", "isolines", "offset", "oriented_box", "simplify", "thicken", "wall_thickness"]


# made of results:
#   offset_result
@dataclass(frozen=True, repr=False)
class OffsetResult(MadeMesh):
    """A solid at a distance from a mesh, around it or hollow.

    statistics: What it took, and was measured.
    blind_drains: (n,) Of `hollow`: numbers of drains that are not known to lead from outside into a
        cavity: an end of their axis is neither there nor there.
    """

    statistics: dict[str, Any]
    blind_drains: Ids
# end


def _checked(made: OffsetResult, check: bool) -> OffsetResult:
    if check:
        require(made.certificate, of_one=True)
    return made


def offset(mesh: MeshLike, distance: float, *, resolution: float | None = None,
           precision: str = "float64", check: bool = True,
           progress: Progress = None) -> OffsetResult:
    """The solid grown by a distance, or shrunk by one below 0. Convex edges become round outward;
    sharp edges of the result are cut off by no more than a cell.

    resolution: edge of the cells that the surface is made in; None: a quarter of the distance, at
    most a 64th of the diagonal, but half of the distance where there would be more than some
    170,000 faces. What was measured is in `statistics`: all of the result is between "least" and
    "greatest" from the mesh.
    precision, check: as for `boolean`.

    Raises NotSolidError where the mesh is open, NotCertifiedError.

    >>> import treeform
    >>> grown = treeform.offset(treeform.read("data/cube.stl"), 0.25, resolution=0.05)
    >>> grown.mesh.is_solid, 2.9 < grown.mesh.volume < 3.3
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return _checked(_core.offset(held(mesh), distance, how, progress=progress), check)


def hollow(mesh: MeshLike, wall: float, *, drains: ArrayLike = (), resolution: float | None = None,
           precision: str = "float64", check: bool = True,
           progress: Progress = None) -> OffsetResult:
    """The solid without what is further inside than `wall`: its surface stays bit for bit.

    drains: (n, 4) holes through the wall: a point, and the diameter of the hole at the nearest
    point of the surface. `blind_drains` are those that may lead nowhere;
    `statistics["sealed_cavities"]` counts cavities that nothing leads out of.
    resolution, precision, check: as for `offset`.

    >>> import treeform
    >>> shell = treeform.hollow(treeform.read("data/cube.stl"), 0.1, resolution=0.05)
    >>> shell.mesh.is_solid, 0.4 < shell.mesh.volume < 0.55
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    holes = np.asarray(drains, dtype=float).reshape(-1, 4) if np.size(drains) == 0 \
        else _arrays.rows(drains, 4, "drains")
    return _checked(_core.hollow(held(mesh), wall, holes, how, progress=progress), check)


def thicken(mesh: MeshLike, thickness: float, *, side: str = "both",
            resolution: float | None = None, precision: str = "float64", check: bool = True,
            progress: Progress = None) -> OffsetResult:
    """A solid around a surface, which may be open: all points no further from it than half of the
    thickness. Its rim is round.

    side: 'both', or where it goes: 'front' (faces are counter-clockwise there) or 'back'.
    resolution, precision, check: as for `offset`.

    >>> import treeform
    >>> sheet = treeform.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> plate = treeform.thicken(sheet, 0.2)
    >>> plate.mesh.is_solid, 0.2 < plate.mesh.volume < 0.32
    (True, True)
    """
    how = options(_core.OffsetOptions, locals())
    return _checked(_core.thicken(held(mesh), thickness, side, how, progress=progress), check)


# made of results:
#   simplify_result
@dataclass(frozen=True, repr=False)
class SimplifyResult(MadeMesh):
    """A mesh with fewer faces.

    face_source: (F,) the face of the input that each was.
    collapses: Edges that became a vertex.
    refused_by_topology: Edges tried whose collapse would change it.
    refused_by_turning: Edges whose collapse would turn a face about.
    refused_by_distance: Edges whose collapse was not proven near.
    refused_by_contact: Edges whose collapse would make faces meet.
    there_at_most: No point of the input is further from the result.
    back_at_most: No point of the result is further from the input.
    vertex_source: (V,) vertex of the input that each is; `NONE`: new.
    face_of_new_vertex: (V,) of a new vertex, the face of the input that is nearest to it, on its
        side of seams; else `NONE`.
    corner_source: (3 F,) the corner of the input that each is at (3 f + i for corner i of face f),
        on its side of seams; none at new vertices.
    """

    face_source: Ids
    collapses: int
    refused_by_topology: int
    refused_by_turning: int
    refused_by_distance: int
    refused_by_contact: int
    there_at_most: float
    back_at_most: float
    vertex_source: Ids
    face_of_new_vertex: Ids
    corner_source: Ids
# end


def simplify(mesh: MeshLike, max_distance: float, *, target_faces: int = 0,
             feature_angle: float = 180.0, face_groups: ArrayLike | None = None,
             precision: str = "float64", check: bool = True,
             progress: Progress = None) -> SimplifyResult:
    """A mesh with fewer faces: no point of either surface is further than `max_distance` from the
    other, which is proven face by face, and no faces are made to meet. Values of vertices and
    corners are interpolated; seams, and borders of materials and of values of faces, are kept.

    target_faces: stop at so many. feature_angle: edges whose faces turn by more degrees, and
    borders, are simplified along themselves. face_groups: (F,) numbers; edges between faces of
    different ones are borders, too.

    >>> import treeform
    >>> few = treeform.simplify(treeform.read("data/two_spheres.stl"), 0.05)
    >>> len(few.mesh.faces) < 500, few.there_at_most <= 0.05
    (True, True)
    """
    how = options(_core.SimplifyOptions, locals())
    groups = _arrays.ids([] if face_groups is None else face_groups, "face_groups")
    made = _core.simplify(held(mesh), max_distance, groups, how, progress=progress)
    if check:
        require(made.certificate, of_one=True)
    return made


# made of results:
#   thickness_result
@dataclass(frozen=True, repr=False)
class Thickness(Result):
    """The thickness at each face, and the least.

    of_face: (F,) Infinite where nothing is behind a face, or it has no area.
    least: Of all faces.
    thinnest: The lowest face with that.
    """

    of_face: Floats
    least: float
    thinnest: int
# end


def wall_thickness(mesh: MeshLike, by: str = "ray", *, progress: Progress = None) -> Thickness:
    """How thick the walls of a solid are, face by face.

    by: 'ray', along the normal inward from the center of a face; or 'sphere', the diameter of the
    largest ball within that touches the center.

    >>> import treeform
    >>> treeform.wall_thickness(treeform.read("data/cube.stl")).least
    1.0
    """
    how = options(_core.ThicknessOptions, locals())
    return _core.wall_thickness(held(mesh), how, progress=progress)


# made of results:
#   oriented_box
@dataclass(frozen=True, repr=False)
class OrientedBox(Result):
    """A box turned in any way.

    center: (3,) of the box.
    axes: (3, 3) of length 1, right-handed: along the longest side, the next, the shortest.
    size: (3,) along these.
    """

    center: Floats
    axes: Floats
    size: Floats
# end


def oriented_box(points: Union[MeshLike, ArrayLike], *,
                 progress: Progress = None) -> OrientedBox | None:
    """The box of least volume around points, of those along sides of their convex hull and those
    along the axes of space. None without points.

    points: (V, 3), or a mesh.

    >>> import treeform
    >>> treeform.oriented_box(treeform.read("data/cube.stl")).size.tolist()
    [1.0, 1.0, 1.0]
    """
    cloud = cloud_of(points)
    return _core.oriented_box(as_mesh(points).vertices if cloud is None else cloud,
                              progress=progress)


# made of results:
#   isoline
@dataclass(frozen=True, repr=False)
class Isoline(Result):
    """A line on a mesh along which a value has a level.

    level: Of the value, along it.
    first_point: Its points follow one another; the first is not repeated.
    point_count: Of its points.
    closed: Otherwise it ends where the mesh does.
    oriented: The faces along it agree: seen from outside, higher is to its left.
    length: Of its sides.
    """

    level: float
    first_point: int
    point_count: int
    closed: bool
    oriented: bool
    length: float
# end


# made of results:
#   isolines_result
@dataclass(frozen=True, repr=False)
class Isolines(Result):
    """Lines of all levels, in the order of the levels as given.

    lines: One after the other.
    points: (n, 3) on edges of the mesh, rounded.
    faces: (points,) the face that the side from each point on lies in.
    """

    lines: list[Isoline]
    points: Floats
    faces: Ids
# end

    def points_of(self, line: int) -> Floats:
        """(n, 3) the points of a line, by its number; a closed one does not repeat its first."""
        of = self.lines[line]
        return self.points[of.first_point:of.first_point + of.point_count]

    def write(self, path: Union[str, os.PathLike[str]], *, normal: ArrayLike = (0, 0, 1),
              format: str = "", unit: str = "", progress: Progress = None) -> None:
        """Writes all lines as SVG (as seen from where `normal` points), DXF, OBJ or JSON, by the
        extension or `format`; `unit` as for sections."""
        _core.write_isolines(os.fspath(path), self.lines, self.points,
                             _arrays.floats(normal, "normal"), format, unit, progress=progress)


def isolines(mesh: MeshLike, values: ArrayLike, levels: ArrayLike, *,
             progress: Progress = None) -> Isolines:
    """Lines along which a value has given levels; which faces make a line is exact.

    values: (V,) of the vertices, linear in each face. levels: (K,). A vertex at a level counts as
    above it.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> lines = treeform.isolines(cube, cube.vertices[:, 2], [0.25, 0.5])
    >>> [(line.closed, line.length) for line in lines.lines]
    [(True, 4.0), (True, 4.0)]
    """
    return _core.isolines(held(mesh), _arrays.floats(values, "values"),
                          np.atleast_1d(_arrays.floats(levels, "levels")), progress=progress)
