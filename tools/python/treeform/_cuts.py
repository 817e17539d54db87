"""Sections of meshes by planes, solids cut by them; parts of meshes."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Iterable, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import NONE, Floats, Ids
from ._core import Certificate
from ._errors import options, require
from ._mesh import Mesh, MeshLike, MeshResult, as_mesh, held, listed
from ._progress import Progress
from ._repair import MadeMesh
from ._results import Result

__all__ = ["CutPiece", "MassProperties", "MeshPart", "Section", "SectionLoop", "components",
           "concatenate", "cut", "cut_along", "cut_to_fit", "layer_heights", "mass_properties",
           "section",
           "submesh", "transformed"]


@dataclass(frozen=True, repr=False)
class SectionLoop(Result):
    """A closed polygon, or, where the mesh ends, an open polyline.

    points: (n, 2) in the frame of the section; the first is not repeated.
    faces: (n,) the face that the side from each point to the next lies in.
    closed: Whether it is a polygon.
    oriented: The faces along it agree: what is inside is to the left, seen from above the plane.
    parent: The innermost loop of the layer that is around it, by number; None for none.
    depth: How many loops are around it: of a solid, holes have an odd one.
    area: Positive where it runs counter-clockwise; 0 for open ones.
    length: Of its sides.
    """

    points: Floats
    faces: Ids
    closed: bool
    oriented: bool
    parent: int | None
    depth: int
    area: float
    length: float


@dataclass(frozen=True, repr=False)
class Section(Result):
    """What is in parallel planes: layers, in the order of their heights as given. Layer i has the
    loops `loops(i)`.

    heights: (K,) of the layers.
    origins: (K, 3) a point of each plane.
    areas: (K,) the area inside; of a solid, rounded.
    lengths: (K,) of all loops.
    open_counts: (K,) how many polylines are open; none of a solid.
    frame: (3, 3) the axes x and y of `points`, and the normal, each of length 1.
    points: (P, 2) of all loops, one after the other: (x . p, y . p) of p in space.
    faces: (P,) the face that the side from each point on lies in.
    """

    heights: Floats
    origins: Floats
    areas: Floats
    lengths: Floats
    open_counts: Ids
    frame: Floats
    points: Floats
    faces: Ids
    _data: _core.SectionData
    _loops: dict[str, NDArray[Any]]

    def __repr__(self) -> str:
        return f"Section({len(self.heights)} layers, {len(self._loops['closed'])} loops)"

    def __len__(self) -> int:
        return len(self.heights)

    def loops(self, layer: int = 0) -> list[SectionLoop]:
        """The loops of a layer.

        >>> import treeform
        >>> cube = treeform.read("data/cube.stl")
        >>> [loop.area for loop in treeform.section(cube, at=(0, 0, 0.5)).loops()]
        [1.0]
        """
        of = self._loops
        count = len(of["closed"])
        layer = range(len(self))[layer]
        first = int(of["first_loop"][layer])
        end = int(of["first_loop"][layer + 1]) if layer + 1 < len(self) else count
        found = []
        for i in range(first, end):
            last = int(of["first_point"][i + 1]) if i + 1 < count else len(self.points)
            points = slice(int(of["first_point"][i]), last)
            parent = int(of["parent"][i])
            found.append(SectionLoop(
                self.points[points], self.faces[points], bool(of["closed"][i]),
                bool(of["oriented"][i]), None if parent == NONE else parent - first,
                int(of["depth"][i]), float(of["loop_areas"][i]), float(of["loop_lengths"][i])))
        return found

    def in_space(self, layer: int, points: ArrayLike) -> Floats:
        """(n, 3) points (n, 2) of a layer in space, rounded."""
        x, y, normal = self.frame
        flat = _arrays.rows(points, 2, "points")
        up: Floats = normal * (normal @ self.origins[layer])
        made: Floats = flat[:, :1] * x + flat[:, 1:] * y + up
        return made

    def write(self, path: Union[str, os.PathLike[str]], *, format: str = "", unit: str = "",
              progress: Progress = None) -> None:
        """Writes all layers as SVG, DXF, OBJ (lines in space) or JSON, by the extension or
        `format`. With a unit, 'mm', 'cm', 'm', 'in', 'ft' or 'um', SVG has its size on paper."""
        _core.write_section(os.fspath(path), self._data, format, unit, progress=progress)


def _heights(heights: ArrayLike | None) -> Floats:
    """Without any, the plane itself."""
    return np.zeros(1) if heights is None else np.atleast_1d(_arrays.floats(heights, "heights"))


def section(mesh: MeshLike, normal: ArrayLike = (0, 0, 1), at: ArrayLike = (0, 0, 0), *,
            heights: ArrayLike | None = None, progress: Progress = None) -> Section:
    """The loops in which planes meet a mesh: closed where the mesh is, outer ones
    counter-clockwise, holes clockwise, nested. What makes a loop, and what lies in it, is decided
    exactly.

    normal, at: (3,) of the plane. A vertex in a plane counts as above it: the section is that just
    below.
    heights: (K,) of planes above that one, along its normal at length 1: thousands take little
    longer than one. None is the plane itself.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> layers = treeform.section(cube, heights=treeform.layer_heights(cube, 0.25))
    >>> layers.areas.tolist(), layers.lengths.tolist()
    ([1.0, 1.0, 1.0, 1.0], [4.0, 4.0, 4.0, 4.0])
    """
    return _core.section(held(mesh), _arrays.vector(at, "at"), _arrays.vector(normal, "normal"),
                         _heights(heights), progress=progress)


def layer_heights(mesh: MeshLike, thickness: float, normal: ArrayLike = (0, 0, 1),
                  at: ArrayLike = (0, 0, 0), *, progress: Progress = None) -> Floats:
    """(K,) heights for `section`: the middles of layers of this thickness, from the lowest vertex
    to the highest.

    >>> import treeform
    >>> treeform.layer_heights(treeform.read("data/cube.stl"), 0.5).tolist()
    [0.25, 0.75]
    """
    return _core.layer_heights(held(mesh), _arrays.vector(at, "at"),
                               _arrays.vector(normal, "normal"), thickness, progress=progress)


# made of results:
#   cut_piece
@dataclass(frozen=True, repr=False)
class CutPiece(MadeMesh):
    """What is between two planes.

    face_source: (F,) face of the input that each lies in; `NONE`: a cap.
    vertex_source: (V,) vertex of the input that each is; `NONE`: new.
    cap: (F,) of a cap, the number of its plane, from the lowest; else `NONE`.
    """

    face_source: Ids
    vertex_source: Ids
    cap: Ids
# end


def _checked(made: tuple[list[CutPiece], Certificate], check: bool) -> list[CutPiece]:
    pieces, certificate = made
    if check:
        require(certificate, of_one=True)
    return pieces


def cut(mesh: MeshLike, normal: ArrayLike = (0, 0, 1), at: ArrayLike = (0, 0, 0), *,
        heights: ArrayLike | None = None, caps: bool = True, precision: str = "float64",
        max_displacement: float = np.inf, check: bool = True,
        progress: Progress = None) -> list[CutPiece]:
    """A solid below and above a plane; with `heights`, between planes: K + 1 pieces, from the
    lowest up. Each is closed by caps. Some may have no faces.

    normal, at: (3,) of the plane. heights: (K,) above it, as for `section`.
    caps: False cuts a surface, which may end anywhere, and leaves it open.
    precision, max_displacement, check: as for `boolean`.

    On which side a vertex is, is decided exactly; points on cuts are rounded, and pieces are
    checked as booleans are. A mesh that meets itself is cut as the solid that it winds around.

    Raises NotSolidError where the mesh is open, NotCertifiedError.

    >>> import treeform
    >>> below, above = treeform.cut(treeform.read("data/cube.stl"), (1, 1, 1), (0.5, 0.5, 0.5))
    >>> below.mesh.is_solid, round(below.mesh.volume, 12), round(above.mesh.volume, 12)
    (True, 0.5, 0.5)
    """
    how = options(_core.CutOptions, locals())
    return _checked(_core.cut(held(mesh), _arrays.vector(at, "at"),
                              _arrays.vector(normal, "normal"), _heights(heights), how,
                              progress=progress), check)


def cut_to_fit(mesh: MeshLike, size: ArrayLike, *, caps: bool = True, precision: str = "float64",
               max_displacement: float = np.inf, check: bool = True,
               progress: Progress = None) -> list[CutPiece]:
    """Pieces of a solid that fit into a box of this size (3,), as the bed of a printer: as few
    along each axis as there can be, of equal length. An infinite size is not cut along. For the
    rest, see `cut`.

    >>> import treeform
    >>> len(treeform.cut_to_fit(treeform.read("data/cube.stl"), (0.5, 0.4, 2)))
    6
    """
    how = options(_core.CutOptions, locals())
    return _checked(_core.cut_to_fit(held(mesh), _arrays.vector(size, "size"), how,
                                     progress=progress), check)


def cut_along(mesh: MeshLike, values: ArrayLike, levels: ArrayLike, *, check: bool = True,
              progress: Progress = None) -> list[CutPiece]:
    """A mesh cut along its isolines: pieces with values below, between and from the levels on, from
    the lowest up, open where they were cut. Levels that repeat count once.

    values: (V,) of the vertices, linear in each face. levels: (K,).

    Raises NotCertifiedError where faces meet in the pieces, as those of the mesh do or rounding
    makes them.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> low, high = treeform.cut_along(cube, cube.vertices[:, 2], [0.25])
    >>> round(low.mesh.area, 12), round(high.mesh.area, 12)
    (2.0, 4.0)
    """
    how = _core.CutOptions()
    return _checked(_core.cut_along(held(mesh), _arrays.floats(values, "values"),
                                    np.atleast_1d(_arrays.floats(levels, "levels")), how,
                                    progress=progress), check)


# made of results:
#   mesh_part
@dataclass(frozen=True, repr=False)
class MeshPart(MeshResult):
    """Faces of a mesh by themselves, with the vertices that they use, and their attributes.

    mesh: The part.
    face_source: (F,) the number of each face in the whole.
    vertex_source: (V,) that of each point; ascending.
    volume: As `Mesh.volume`.
    area: As `Mesh.area`.
    """

    mesh: Mesh
    face_source: Ids
    vertex_source: Ids
    volume: float
    area: float
# end


def components(mesh: MeshLike, *, min_volume: float = 0.0, largest: int | None = None,
               progress: Progress = None) -> list[MeshPart]:
    """The faces that vertices link, as meshes, in the order of their lowest faces. A closed part
    that is inside out is a cavity, and goes with the part around it.

    min_volume: parts with less are left out, in cubic units; open ones have none.
    largest: so many of the greatest volume are kept.

    >>> import treeform
    >>> spheres = treeform.components(treeform.read("data/two_spheres.stl"))
    >>> [part.mesh for part in spheres]
    [Mesh(162 vertices, 320 faces), Mesh(162 vertices, 320 faces)]
    """
    how = options(_core.ComponentsOptions, locals())
    return _core.components(held(mesh), how, progress=progress)


def submesh(mesh: MeshLike, faces: ArrayLike, *, progress: Progress = None) -> MeshPart:
    """The faces of these numbers (n,), in this order, with their vertices and attributes. A mask
    (F,) of True and False will do.

    >>> import treeform
    >>> treeform.submesh(treeform.read("data/cube.stl"), [0, 1]).mesh
    Mesh(4 vertices, 2 faces)
    """
    chosen = np.asarray(faces)
    if chosen.dtype == bool:
        count = len(as_mesh(mesh).faces)
        if chosen.shape != (count,):
            raise ValueError(f"faces: the shape of the mask is {chosen.shape}, not ({count},)")
        chosen = np.flatnonzero(chosen)
    return _core.submesh(held(mesh), _arrays.ids(chosen, "faces"), progress=progress)


def concatenate(meshes: Iterable[MeshLike], *, progress: Progress = None) -> Mesh:
    """Vertices, faces and attributes of all meshes, one after the other; nothing is joined.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.concatenate([cube, cube])
    Mesh(16 vertices, 24 faces)
    """
    several = listed(meshes)
    if several is None:
        raise ValueError("meshes: several meshes are needed")
    points, faces, data = _core.concatenate([held(one) for one in several], progress=progress)
    return Mesh._of(points, faces, None, data)


def transformed(mesh: MeshLike, matrix: ArrayLike, *, progress: Progress = None) -> Mesh:
    """The mesh moved by a matrix (4, 4), with its attributes, normals turned. Where the matrix
    mirrors, faces are turned over, so that they look outward as before.

    >>> import numpy as np
    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> mirrored = treeform.transformed(cube, np.diag([-2, 1, 1, 1]))
    >>> mirrored.volume, mirrored.bounds.tolist()
    (2.0, [[-2.0, 0.0, 0.0], [0.0, 1.0, 1.0]])
    """
    own, move = held(mesh), _arrays.matrix(matrix, "matrix")
    faces, data = _core.turned(own, move)
    return Mesh._of(_core.moved_points(own, move, progress=progress), faces, None, data)


# made of results:
#   mass_properties
@dataclass(frozen=True, repr=False)
class MassProperties(Result):
    """Of a solid of density 1.

    volume: What the mesh encloses; negative where it is inside out.
    center: (3,) of mass.
    inertia: (3, 3) About the center, by axes x, y and z: the energy of turning by w is w . (inertia
        w) / 2.
    """

    volume: float
    center: Floats
    inertia: Floats
# end


def mass_properties(mesh: MeshLike, *, progress: Progress = None) -> MassProperties | None:
    """Volume, center of mass and inertia of what a closed mesh encloses, rounded once from twice
    the precision; None where the volume is 0, or noise beside what cancels in it.

    >>> import treeform
    >>> cube = treeform.mass_properties(treeform.read("data/cube.stl"))
    >>> cube.center.tolist(), round(cube.inertia[0, 0], 12)
    ([0.5, 0.5, 0.5], 0.166666666667)
    """
    return _core.mass_properties(held(mesh), progress=progress)
