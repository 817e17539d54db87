"""Plane sections of meshes, solids cut by planes, and parts of meshes."""

from __future__ import annotations

# made of uses:
import os
from dataclasses import dataclass
from typing import Iterable, List, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import checked, options
from ._mesh import Mesh, MeshLike, MeshResult, as_mesh, each, held
from ._progress import Progress
from ._repair import MadeMesh
from ._results import Certificate, Result

__all__ = ["CutPiece", "CutPieces", "MassProperties", "MeshPart", "Section", "SectionLoop",
           "components", "concatenate", "cut", "cut_along", "cut_to_fit", "layer_heights",
           "mass_properties", "section", "submesh", "transformed"]
# end


# made of headers:
#   Section
@dataclass(frozen=True, repr=False)
class Section(Result):
    """Sections by parallel planes: layers, in the order of the given heights. Layer i has the loops
    `loops(i)`.

    heights: (K,) heights of the layers.
    origins: (K, 3) a point of each plane.
    areas: (K,) area of each layer: the area inside a solid.
    lengths: (K,) total length of the loops of each layer.
    open_counts: (K,) number of open polylines in each layer; 0 for a solid.
    points: (P, 2) points of all loops, one after the other: (x . p, y . p) for p in space.
    faces: (P,) the face in which the segment after each point begins.
    axes: (3, 3) the axes x and y of `points`, and the normal, each of length 1.
    """

    heights: Floats
    origins: Floats
    areas: Floats
    lengths: Floats
    open_counts: Ids
    points: Floats
    faces: Ids
    _data: _core.SectionData
    axes: Floats
# end

    def __repr__(self) -> str:
        return f"Section({len(self.heights)} layers, {len(self._data)} loops)"

    def __len__(self) -> int:
        return len(self.heights)

    def loops(self, layer: int = 0) -> list[SectionLoop]:
        """The loops of a layer.

        >>> import treeform
        >>> cube = treeform.read("data/cube.stl")
        >>> [loop.area for loop in treeform.section(cube, at=(0, 0, 0.5)).loops()]
        [1.0]
        """
        return self._data.loops(range(len(self))[layer])

    def in_space(self, layer: int, points: ArrayLike) -> Floats:
        """(n, 3) the positions in space of `points` (n, 2) of a layer, rounded."""
        x, y, normal = self.axes
        flat = _arrays.rows(points, 2, "points")
        up: Floats = normal * (normal @ self.origins[layer])
        made: Floats = flat[:, :1] * x + flat[:, 1:] * y + up
        return made

    def write(self, path: Union[str, os.PathLike[str]], *, format: str = "", unit: str = "",
              progress: Progress = None) -> None:
        """Writes all layers as SVG, DXF, OBJ (lines in space) or JSON, according to `format` or the
        extension. With a unit ('mm', 'cm', 'm', 'in', 'ft' or 'um'), an SVG has its true size."""
        _core.write_section(os.fspath(path), self._data, _arrays.word(format, "format"),
                            _arrays.word(unit, "unit"), progress=progress)


def heights_of(heights: ArrayLike | None) -> Floats:
    """Heights of planes; None is the plane itself."""
    return np.zeros(1) if heights is None else np.atleast_1d(_arrays.floats(heights, "heights"))


class CutPieces(List["CutPiece"]):
    """A list of the pieces of a mesh.

    certificate: The certificate of the first piece that is not ok, or of the mesh if it does not
        bound a solid.
    resolved: Whether the mesh intersected itself. Then the solid that it encloses was cut, with
        overlapping parts united; without caps, the faces were cut along their intersections.
    """

    certificate: Certificate
    resolved: bool


def chosen_of(mesh: MeshLike, faces: ArrayLike) -> Ids:
    """Face numbers, also from a boolean mask."""
    chosen = np.asarray(faces)
    if chosen.dtype == bool:
        count = len(as_mesh(mesh).faces)
        if chosen.shape != (count,):
            raise ValueError(f"faces: the shape of the mask is {chosen.shape}, not ({count},)")
        chosen = np.flatnonzero(chosen)
    return _arrays.ids(chosen, "faces")


def joined(meshes: Iterable[MeshLike], progress: Progress) -> Mesh:
    """Implements `concatenate`."""
    return _core.concatenate(each(meshes, "meshes", held), progress=progress)


# made of headers:
#   SectionLoop section layer_heights CutPiece cut cut_to_fit cut_along MeshPart components
#   submesh concatenate transformed MassProperties mass_properties
@dataclass(frozen=True, repr=False)
class SectionLoop(Result):
    """A closed polygon, or an open polyline that ends at a border of the mesh.

    points: (n, 2) in the plane of the section; the first is not repeated.
    faces: (n,) the face in which the segment after each point begins.
    closed: Whether the loop is a closed polygon.
    oriented: Whether the faces along it are consistently oriented; then the inside is to the left,
        seen from above the plane.
    parent: Number of the innermost loop of the layer around this one; None if there is none.
    depth: Number of loops around this one; odd for holes in a solid.
    area: Positive if counter-clockwise; 0 for open loops.
    length: Length of the polyline.
    """

    points: Floats
    faces: Ids
    closed: bool
    oriented: bool
    parent: int | None
    depth: int
    area: float
    length: float


def section(mesh: MeshLike, normal: ArrayLike = (0, 0, 1), at: ArrayLike = (0, 0, 0), *,
            heights: ArrayLike | None = None, progress: Progress = None) -> Section:
    """Sections of a mesh by the planes at `heights` above a plane.

    The side of each vertex, the loops and their nesting are decided exactly, on the coordinates as
    given. Then points are rounded.

    A vertex in a plane counts as above it, so a section shows the mesh just below the plane: a box
    from height 0 to 1 has no section at 0, and its full top at 1. A point or line in which the mesh
    touches the plane from below gives no loop. A face in the plane is part of the section if the
    mesh continues below it.

    If the mesh is closed and consistently oriented, all polylines are closed. Loops may touch where
    faces touch; at an edge of four or more faces, segments that bound the same wedge of the solid
    are joined. Where the mesh has a border, polylines are open; across inconsistently oriented
    neighbors they continue, but are not `oriented`. If faces cross each other, so do loops:
    `parent` is then the innermost loop around one point of the loop, and areas count as often as
    the surface winds around them. Corners with equal coordinates are one.

    Where a loop runs straight from one face to a coplanar one, it has no point: the section of a
    box has four. The segment after a point begins in the face in `faces`, and may continue in
    others.

    The loops of a layer are in the order of their lowest face numbers.

    normal: (3,) the normal of the plane, of any length.
    at: (3,) a point on the plane.
    heights: (K,) the distances of K parallel planes from this plane, measured along its unit
        normal. None: this plane only.

    Raises ValueError naming a face with a corner out of range or not finite, for a plane or height
    that is not finite, or a normal that is zero.

    Cost: O(V log K + F + S log L) for K planes, and L loops of S segments in one plane.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> layers = treeform.section(cube, heights=treeform.layer_heights(cube, 0.25))
    >>> layers.areas.tolist(), layers.lengths.tolist()
    ([1.0, 1.0, 1.0, 1.0], [4.0, 4.0, 4.0, 4.0])
    """
    return _core.section(held(mesh), _arrays.vector(normal, "normal"), _arrays.vector(at, "at"),
                         heights_of(heights), progress=progress)


def layer_heights(mesh: MeshLike, thickness: float, normal: ArrayLike = (0, 0, 1),
                  at: ArrayLike = (0, 0, 0), *, progress: Progress = None) -> Floats:
    """(K,) heights for `section`: the middle of each layer of this thickness, from the lowest
    vertex to the highest. The first height is half a thickness above the lowest vertex. Vertices
    that are not finite are ignored.

    normal: (3,) the normal of the plane, of any length.
    at: (3,) a point on the plane.

    >>> import treeform
    >>> treeform.layer_heights(treeform.read("data/cube.stl"), 0.5).tolist()
    [0.25, 0.75]
    """
    return _core.layer_heights(held(mesh), _arrays.number(thickness, "thickness"),
                               _arrays.vector(normal, "normal"), _arrays.vector(at, "at"),
                               progress=progress)


@dataclass(frozen=True, repr=False)
class CutPiece(MadeMesh):
    """The part of the mesh between two neighboring planes.

    face_source: (F,) input face that contains each face; `NONE`: a cap.
    vertex_source: (V,) input vertex equal to each vertex; `NONE`: new.
    cap: (F,) for faces of a cap, the number of its plane (0: the lowest); else `NONE`.
    """

    face_source: Ids
    vertex_source: Ids
    cap: Ids


def cut(mesh: MeshLike, normal: ArrayLike = (0, 0, 1), at: ArrayLike = (0, 0, 0), *,
        heights: ArrayLike | None = None, precision: str = "float64",
        max_displacement: float = np.inf, caps: bool = True, check: bool = True,
        progress: Progress = None) -> CutPieces:
    """The pieces of a mesh below, between and above planes at `heights` above a plane.

    The side of each vertex is decided exactly, on the coordinates as given. A face in a plane
    belongs to the piece that it bounds. The section of the solid in a plane becomes a cap, the same
    on both sides. Only points on cuts are rounded, once; each piece is checked like a result of
    `boolean`. Caps perpendicular to an axis stay flat and equal when rounded; others may bend by a
    unit in the last place.

    With caps, the mesh must bound a solid, like an operand of `boolean`. If it meets itself, or has
    parts that are inside out or hidden in others, it is first replaced by the solid that it winds
    around, rounded; the statements above then hold for that solid. Equal planes count once.

    One plane cuts a solid into the piece below and the piece above it; K `heights` give K + 1
    pieces, from bottom to top. A piece may be empty.

    normal: (3,) the normal of the plane, of any length.
    at: (3,) a point on the plane.
    heights: (K,) the distances of K parallel planes from this plane, measured along its unit
        normal. None: this plane only.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: As in `boolean`.
    caps: Close pieces by caps. If false, the mesh is cut as a surface, which may be open, and
        pieces are open at the planes.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh is open, NotCertifiedError if the result could not be
    certified; ValueError as `section` and `boolean`.

    Cost: as `boolean` of the mesh with itself, and O(n log n) for the n faces that are cut; caps of
    n points O(n^1.5).

    >>> import treeform
    >>> below, above = treeform.cut(treeform.read("data/cube.stl"), (1, 1, 1), (0.5, 0.5, 0.5))
    >>> below.mesh.is_solid, round(below.mesh.volume, 12), round(above.mesh.volume, 12)
    (True, 0.5, 0.5)
    """
    how = options(_core.CutOptions, locals())
    return checked(_core.cut(held(mesh), _arrays.vector(normal, "normal"), _arrays.vector(at, "at"),
                             heights_of(heights), how, progress=progress), check, of="")


def cut_to_fit(mesh: MeshLike, size: ArrayLike, *, precision: str = "float64",
               max_displacement: float = np.inf, caps: bool = True, check: bool = True,
               progress: Progress = None) -> CutPieces:
    """Pieces that fit into a box of this size. They are cut by planes perpendicular to x, then y,
    then z: as few as possible for each axis, equally spaced up to rounding, and none for an axis
    with infinite size. Pieces without faces are omitted; the others are ordered by x, then y, then
    z. Planes are numbered in the same order. Later cuts cut the rounded pieces of earlier ones.

    size: (3,) the size of the box, such as the build volume of a printer.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: As in `boolean`.
    caps: Close pieces by caps. If false, the mesh is cut as a surface, which may be open, and
        pieces are open at the planes.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if the mesh is open, NotCertifiedError if the result could not be
    certified; ValueError as `cut`; for a size that is not positive; for more than 2^16 planes for
    an axis, or possibly more than 2^20 pieces.

    >>> import treeform
    >>> len(treeform.cut_to_fit(treeform.read("data/cube.stl"), (0.5, 0.4, 2)))
    6
    """
    how = options(_core.CutOptions, locals())
    return checked(_core.cut_to_fit(held(mesh), _arrays.vector(size, "size"), how,
                                    progress=progress), check, of="")


def cut_along(mesh: MeshLike, values: ArrayLike, levels: ArrayLike, *, check: bool = True,
              progress: Progress = None) -> CutPieces:
    """The mesh cut along its isolines (`isolines`): K + 1 pieces for K different levels in
    ascending order. A piece has the values from one level, inclusive, to the next. Pieces are open
    surfaces with common border points, and together cover the mesh. Only new points are rounded, by
    less than a step of their largest coordinate.

    The certificate is that of all pieces together. It lists faces that meet beyond common corners
    and edges, because faces of the mesh do, or by rounding. Its face numbers count through all
    pieces.

    values: (V,) a value for each vertex, interpolated linearly over each face.
    levels: (K,) the values to cut at.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotCertifiedError if the result could not be certified; ValueError as `isolines`.

    Cost: as `isolines` and `self_intersections`.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> low, high = treeform.cut_along(cube, cube.vertices[:, 2], [0.25])
    >>> round(low.mesh.area, 12), round(high.mesh.area, 12)
    (2.0, 4.0)
    """
    return checked(_core.cut_along(held(mesh), _arrays.floats(values, "values"),
                                   np.atleast_1d(_arrays.floats(levels, "levels")),
                                   progress=progress), check, of="")


@dataclass(frozen=True, repr=False)
class MeshPart(MeshResult):
    """A subset of the faces of a mesh, with the vertices that they use and their attributes.

    mesh: The part.
    face_source: (F,) the number of each face in the given mesh.
    vertex_source: (V,) the number of each point in the given mesh; ascending.
    volume: As `Mesh.volume`.
    area: As `Mesh.area`.
    """

    mesh: Mesh
    face_source: Ids
    vertex_source: Ids
    volume: float
    area: float


def components(mesh: MeshLike, *, min_volume: float = 0.0, largest: int = 0,
               progress: Progress = None) -> list[MeshPart]:
    """The connected components of a mesh (faces linked by common corners), in the order of their
    lowest faces. Corners with equal coordinates are one. A closed component that is inside out is a
    cavity; it is returned with the smallest closed component around it, if any. Parts with a volume
    below `min_volume`, in cubic units, are omitted; for this, volumes have no sign, and those of
    open parts are 0. If `largest` is not 0, only that many parts are returned: those of the
    greatest volume and, for equal volumes, the greatest area.

    min_volume: ignore components with a smaller volume, in cubic units.
    largest: return only this many of the largest components; 0: all.

    Raises ValueError naming the lowest face with a corner out of range, and for a `min_volume` that
    is negative or NaN.

    Cost: O(V + F); with cavities, plus `contains`.

    >>> import treeform
    >>> spheres = treeform.components(treeform.read("data/two_spheres.stl"))
    >>> [part.mesh for part in spheres]
    [Mesh(162 vertices, 320 faces), Mesh(162 vertices, 320 faces)]
    """
    return _core.components(held(mesh), _arrays.number(min_volume, "min_volume"),
                            _arrays.whole(largest, "largest"), progress=progress)


def submesh(mesh: MeshLike, faces: ArrayLike, *, progress: Progress = None) -> MeshPart:
    """The faces with these numbers, in this order, and the points that they use, in the order of
    `mesh`.

    Vertices keep their attributes.

    faces: (n,) face numbers, or a boolean mask (F,).

    Raises ValueError naming a number that is out of range, or a face with a corner out of range.

    Cost: O(V + F).

    >>> import treeform
    >>> treeform.submesh(treeform.read("data/cube.stl"), [0, 1]).mesh
    Mesh(4 vertices, 2 faces)
    """
    return _core.submesh(held(mesh), chosen_of(mesh, faces), progress=progress)


def concatenate(meshes: Iterable[MeshLike], *, progress: Progress = None) -> Mesh:
    """The points and faces of all meshes, one mesh after the other; points are not joined.

    Their attributes are concatenated as well.

    Raises ValueError for more points or faces than 32 bits can number.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.concatenate([cube, cube])
    Mesh(16 vertices, 24 faces)
    """
    return joined(meshes, progress)


def transformed(mesh: MeshLike, matrix: ArrayLike | None, *, progress: Progress = None) -> Mesh:
    """The mesh with transformed points. If `matrix` mirrors, faces are flipped, so that they still
    point outward.

    Attributes are kept, and normals are transformed as well.

    matrix: (4, 4) an affine transform.

    >>> import numpy as np
    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> mirrored = treeform.transformed(cube, np.diag([-2, 1, 1, 1]))
    >>> mirrored.volume, mirrored.bounds.tolist()
    (2.0, [[-2.0, 0.0, 0.0], [0.0, 1.0, 1.0]])
    """
    return _core.transformed(held(mesh), _arrays.matrix(matrix, "matrix"), progress=progress)


@dataclass(frozen=True, repr=False)
class MassProperties(Result):
    """Mass properties of a solid of density 1.

    volume: The enclosed volume; negative if the mesh is inside out.
    center: (3,) the center of mass.
    inertia: (3, 3) Inertia tensor about the center, in axes x, y and z: the kinetic energy at
        angular velocity w is w . (inertia w) / 2.
    """

    volume: float
    center: Floats
    inertia: Floats


def mass_properties(mesh: MeshLike, *, progress: Progress = None) -> MassProperties | None:
    """Volume, center of mass and inertia of the solid that a closed mesh bounds. If the mesh is
    inside out, volume and inertia have the opposite sign. A region counts as often as the surface
    winds around it. None if the volume is 0 (as for an empty mesh), not finite, or so small
    compared with the terms of its sum that the center would be noise. Meaningless for an open mesh.

    Coordinates are first taken relative to the center of the box, which rounds them by at most
    2^-53 of its diagonal. Sums have twice the precision of double; their terms have a relative
    error of at most 2^-50.

    Raises ValueError naming the lowest face with a corner out of range.

    Cost: O(V + F).

    >>> import treeform
    >>> cube = treeform.mass_properties(treeform.read("data/cube.stl"))
    >>> cube.center.tolist(), round(cube.inertia[0, 0], 12)
    ([0.5, 0.5, 0.5], 0.166666666667)
    """
    return _core.mass_properties(held(mesh), progress=progress)
# end
