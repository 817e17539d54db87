"""Set operations on solids."""

from __future__ import annotations

# made of uses:
import re
from dataclasses import dataclass, replace
from typing import Any, Iterable, Union

import numpy as np

from . import _arrays, _core
from ._arrays import Ids
from ._errors import checked, options
from ._mesh import Mesh, MeshLike, MeshResult, each, held, listed
from ._progress import Progress
from ._results import Certificate

__all__ = ["BooleanResult", "boolean", "check_operand", "clip", "difference", "intersection",
           "split", "symmetric_difference", "union"]
# end


#: Operands of set operations: a mesh, or an iterable of meshes.
MeshesLike = Union[MeshLike, Iterable[MeshLike]]


def operands_of(meshes: Iterable[Any]) -> list[_core.HeldMesh]:
    """The operands of `union(a, b, c)`, `union([a, b, c])` or `difference(a, [b, c])`."""
    several = [(one,) if (many := listed(one)) is None else many for one in meshes]
    return each([one for many in several for one in many], "meshes", held)


def combined(operation: str, meshes: tuple[Any, ...], how: _core.BooleanOptions,
             progress: Progress) -> BooleanResult:
    """The set operation. Except in a union, a single mesh stands for the objects in it."""
    operands = operands_of(meshes)
    if not operands:
        raise ValueError("meshes: expected at least one mesh, not an empty list")
    if len(operands) == 1 and operation != "union":
        parts = _core.file_parts(operands[0], True).values()
        operands = [held(one) for one in parts] if len(parts) > 1 else operands
    return _core.boolean_of(operands, operation, "", [], how, progress=progress)


def by_formula(expression: str, operands: tuple[Any, ...], meshes: dict[str, Any],
               how: _core.BooleanOptions, progress: Progress) -> BooleanResult:
    """Implements `boolean`: operands without a name are called a, b, c, ..."""
    unnamed = operands_of(operands)
    names = [*(chr(ord("a") + i) for i in range(len(unnamed))), *meshes]
    made = _core.boolean_of([*unnamed, *(held(mesh) for mesh in meshes.values())], "",
                            _arrays.word(expression, "expression"), names, how, progress=progress)
    opened = made.certificate.open_faces
    if len(opened) == 0:
        return made
    said = re.sub(r"operand [^,]*$", names[opened[0, 0]], made.certificate.message)
    return replace(made, certificate=replace(made.certificate, message=said))


def clipped(sheet: MeshLike, solids: tuple[Any, ...], keep: str, how: _core.BooleanOptions,
            progress: Progress) -> BooleanResult:
    """Implements `clip`."""
    keep = _arrays.one_of(keep, "keep", ("outside", "inside"))
    operation = "difference" if keep == "outside" else "intersection"
    return _core.clip_by([held(sheet), *operands_of(solids)], operation, how, progress=progress)


# made of headers:
#   BooleanResult union intersection difference symmetric_difference boolean clip split
#   check_operand
@dataclass(frozen=True, repr=False)
class BooleanResult(MeshResult):
    """The surface of a solid, with its certificate. Every function that takes a mesh also takes a
    result; `vertices, faces = result.mesh`.

    mesh: Faces are counter-clockwise from outside.
    certificate: The outcome of checking its coordinates.
    face_source: (F, 2) for each face, the lowest operand and operand face that contain it.
    vertex_source: (V, 2) the lowest operand, and its vertex, equal to each vertex; `NONE` for new
        vertices.
    volumes: With `volumes`: volumes of the first operand, the second, their union and their
        intersection.
    statistics: Counts of the steps.
    """

    mesh: Mesh
    certificate: Certificate
    face_source: Ids
    vertex_source: Ids
    volumes: tuple[float, float, float, float] | None
    statistics: dict[str, Any]


def union(*meshes: MeshesLike, fill_rule: str = "nonzero", precision: str = "float64",
          max_displacement: float = np.inf, keep_cuts: bool = False, merge_coplanar: bool = False,
          volumes: bool = False, min_volume: float = 0.0, gap: float = 0.0, check: bool = True,
          progress: Progress = None) -> BooleanResult:
    """The union of solids: `union(a, b, ...)`, or `union([a, b, ...])` as in trimesh. The union of
    a single mesh is the solid that it encloses, without self-intersections. See `boolean`.

    meshes: each argument is a mesh or a list of meshes.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    merge_coplanar: merge all coplanar faces of the result, also those not cut; but never faces with
        different materials or values, nor those whose corners differ in texture coordinates or
        normals.
    volumes: compute the volumes of the two operands, of their union and of their intersection.
    min_volume: Parts of the result with a smaller volume, in cubic units, are removed: small solids
        are dropped, and small voids are filled, with all that is in them. A part is connected by
        edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    gap: fill gaps of at most this width between faces of different solids that face each other. The
        faces that bound a filled gap come last; their `face_source` is the face at the end of the
        gap, or the one opposite. `filled_faces` of `statistics` counts the faces at filled gaps.
        Not together with `volumes`.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError naming a face with a corner out of range, or a corner with a coordinate
    that is not finite or beyond 2^1000; for a `gap` if the expression is not a union of all
    operands.

    Cost: O(F log F) for the F faces where the result's surface may be. For one or two closed
    manifolds that meet in few places: a search for these places (only once for a `Mesh`), and a
    copy. A `gap` adds O(P) for the P pairs of faces whose boxes are that near.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> both = treeform.union(a, (a.vertices + 0.5, a.faces))
    >>> both.mesh.volume, both.certificate
    (1.875, Certificate(ok))
    """
    how = options(_core.BooleanOptions, locals())
    return checked(combined("union", meshes, how, progress), check)


def intersection(*meshes: MeshesLike, fill_rule: str = "nonzero", precision: str = "float64",
                 max_displacement: float = np.inf, keep_cuts: bool = False,
                 merge_coplanar: bool = False, volumes: bool = False, min_volume: float = 0.0,
                 check: bool = True, progress: Progress = None) -> BooleanResult:
    """The intersection of solids: the region that all of them share. If a single mesh was read from
    a file with several objects, these are the operands, as in `difference`. See `boolean`.

    meshes: each argument is a mesh or a list of meshes.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    merge_coplanar: merge all coplanar faces of the result, also those not cut; but never faces with
        different materials or values, nor those whose corners differ in texture coordinates or
        normals.
    volumes: compute the volumes of the two operands, of their union and of their intersection.
    min_volume: Parts of the result with a smaller volume, in cubic units, are removed: small solids
        are dropped, and small voids are filled, with all that is in them. A part is connected by
        edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError naming a face with a corner out of range, or a corner with a coordinate
    that is not finite or beyond 2^1000.

    Cost: O(F log F) for the F faces where the result's surface may be. For one or two closed
    manifolds that meet in few places: a search for these places (only once for a `Mesh`), and a
    copy.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.intersection(a, (a.vertices + 0.5, a.faces)).mesh.volume
    0.125
    """
    how = options(_core.BooleanOptions, locals())
    return checked(combined("intersection", meshes, how, progress), check)


def difference(*meshes: MeshesLike, fill_rule: str = "nonzero", precision: str = "float64",
               max_displacement: float = np.inf, keep_cuts: bool = False,
               merge_coplanar: bool = False, volumes: bool = False, min_volume: float = 0.0,
               check: bool = True, progress: Progress = None) -> BooleanResult:
    """The first solid minus all others: `difference(a, b, c)`, or `difference(a, [b, c])`. If a
    single mesh was read from a file with several objects (`attributes.parts`), the other objects
    are subtracted from the first, as in tf-boolean; `face_source` and `vertex_source` then have the
    number of the object and the number within it. From a single mesh without such objects, nothing
    is subtracted. See `boolean`.

    meshes: each argument is a mesh or a list of meshes.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    merge_coplanar: merge all coplanar faces of the result, also those not cut; but never faces with
        different materials or values, nor those whose corners differ in texture coordinates or
        normals.
    volumes: compute the volumes of the two operands, of their union and of their intersection.
    min_volume: Parts of the result with a smaller volume, in cubic units, are removed: small solids
        are dropped, and small voids are filled, with all that is in them. A part is connected by
        edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError naming a face with a corner out of range, or a corner with a coordinate
    that is not finite or beyond 2^1000.

    Cost: O(F log F) for the F faces where the result's surface may be. For one or two closed
    manifolds that meet in few places: a search for these places (only once for a `Mesh`), and a
    copy.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> cutters = [(a.vertices + 0.5, a.faces), (a.vertices - 0.5, a.faces)]
    >>> treeform.difference(a, cutters).mesh.volume
    0.75
    """
    how = options(_core.BooleanOptions, locals())
    return checked(combined("difference", meshes, how, progress), check)


def symmetric_difference(*meshes: MeshesLike, fill_rule: str = "nonzero",
                         precision: str = "float64", max_displacement: float = np.inf,
                         keep_cuts: bool = False, merge_coplanar: bool = False,
                         volumes: bool = False, min_volume: float = 0.0, check: bool = True,
                         progress: Progress = None) -> BooleanResult:
    """The symmetric difference (exclusive or) of solids: the region inside an odd number of them.
    If a single mesh was read from a file with several objects, these are the operands, as in
    `difference`. See `boolean`.

    meshes: each argument is a mesh or a list of meshes.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    merge_coplanar: merge all coplanar faces of the result, also those not cut; but never faces with
        different materials or values, nor those whose corners differ in texture coordinates or
        normals.
    volumes: compute the volumes of the two operands, of their union and of their intersection.
    min_volume: Parts of the result with a smaller volume, in cubic units, are removed: small solids
        are dropped, and small voids are filled, with all that is in them. A part is connected by
        edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError naming a face with a corner out of range, or a corner with a coordinate
    that is not finite or beyond 2^1000.

    Cost: O(F log F) for the F faces where the result's surface may be. For one or two closed
    manifolds that meet in few places: a search for these places (only once for a `Mesh`), and a
    copy.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.symmetric_difference(a, (a.vertices + 0.5, a.faces)).mesh.volume
    1.75
    """
    how = options(_core.BooleanOptions, locals())
    return checked(combined("symmetric_difference", meshes, how, progress), check)


def boolean(expression: str, *operands: MeshesLike, fill_rule: str = "nonzero",
            precision: str = "float64", max_displacement: float = np.inf, keep_cuts: bool = False,
            merge_coplanar: bool = False, volumes: bool = False, min_volume: float = 0.0,
            check: bool = True, progress: Progress = None, **meshes: MeshLike) -> BooleanResult:
    """The solid that `expression` defines. All operands are cut along each other in one
    arrangement.

    The surface is decided exactly, on the coordinates as given. Then points on cuts are rounded,
    and the rounded surface is checked. Where rounding makes faces meet, thin faces are removed, and
    faces that still meet are cut and rounded again, in rounds. Vertices of operands stay bit for
    bit, except next to such a place, or if float32 is requested.

    Each operand must bound a solid: after cutting, the signed face count of every edge is zero.
    Operands may overlap themselves, touch, be nested, be equal, consist of parts, be inside out or
    empty. Their corners with equal coordinates are one vertex. Where parts of the result touch,
    each has its own vertices, with equal coordinates, so that every edge has two faces.

    Attributes of the operands are carried over. A face gets the values of the operand face that it
    lies in; a new vertex on a cut gets interpolated values. The value is 0 or NaN if an operand
    does not have the attribute. Coplanar faces are merged only if their values are equal; faces
    whose corners differ in texture coordinates or normals are never merged, and if vertices have
    values, faces are merged only with `merge_coplanar`.

    expression: a formula of `operands`, named `a`, `b`, `c`, ..., and of `meshes` by their names:
        `+` or `|` for union, `*` or `&` for intersection, `-` for difference, `^` for exclusive or,
        and parentheses. `*` and `&` are evaluated first, the others from left to right.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    merge_coplanar: merge all coplanar faces of the result, also those not cut; but never faces with
        different materials or values, nor those whose corners differ in texture coordinates or
        normals.
    volumes: compute the volumes of the two operands, of their union and of their intersection.
    min_volume: Parts of the result with a smaller volume, in cubic units, are removed: small solids
        are dropped, and small voids are filled, with all that is in them. A part is connected by
        edges; its volume is the volume that it encloses. For solids only. Finite and not negative.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError naming a face with a corner out of range, or a corner with a coordinate
    that is not finite or beyond 2^1000.

    Cost: O(F log F) for the F faces where the result's surface may be. For one or two closed
    manifolds that meet in few places: a search for these places (only once for a `Mesh`), and a
    copy.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> b, c = (a.vertices + 0.5, a.faces), (a.vertices + [0.5, 0, 0], a.faces)
    >>> treeform.boolean("(a - b) * c", a=a, b=b, c=c).mesh.volume
    0.375
    """
    how = options(_core.BooleanOptions, locals())
    return checked(by_formula(expression, operands, meshes, how, progress), check)


def clip(sheet: MeshLike, *solids: MeshesLike, keep: str = "outside", fill_rule: str = "nonzero",
         precision: str = "float64", max_displacement: float = np.inf, keep_cuts: bool = False,
         check: bool = True, progress: Progress = None) -> BooleanResult:
    """Trims an open surface with solids, given one by one or as a list: returns the parts of
    `sheet` outside all of them, or inside all of them. The sheet may have any border, may intersect
    itself, and may even be closed. The result is an open surface, so its edges are not checked.

    keep: 'outside' or 'inside'. Parts on the surface of a solid count as inside it. So for one
        solid, the two results together are the whole sheet.
    fill_rule: 'nonzero', 'even_odd' or 'positive': the winding numbers that count as inside.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    keep_cuts: Do not merge coplanar faces that were cut, or that overlap. By default they are
        merged before rounding, which removes vertices inside a flat region and on straight edges
        between two regions. Uncut faces are not changed.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotClosedError if an operand is open, NotCertifiedError if the result could not be
    certified; ValueError as `boolean`; if `sheet` is not the number of an operand.

    Cost: as `boolean`; faces of solids whose boxes overlap no face of the sheet are skipped.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> sheet = ([[-1, -1, 0.5], [2, -1, 0.5], [2, 2, 0.5]], [[0, 1, 2]])
    >>> round(treeform.clip(sheet, cube, keep="inside").mesh.area, 12)
    0.5
    """
    how = options(_core.BooleanOptions, locals())
    return checked(clipped(sheet, solids, keep, how, progress), check)


def split(*meshes: MeshesLike, precision: str = "float64", max_displacement: float = np.inf,
          check: bool = True, progress: Progress = None) -> BooleanResult:
    """All faces of the operands, cut along each other and along themselves, each piece once. Any
    two pieces share a corner, an edge or nothing. Operands need not bound solids, and the
    certificate does not check edges. Where faces overlap, one piece stands for all; its source is
    the lowest of them. Coplanar pieces are not merged.

    meshes: each argument is a mesh or a list of meshes.
    precision: 'float32' or 'float64'. Precision of the returned coordinates; use 'float32' for STL
        and GLB.
    max_displacement: Where rounding makes faces meet, points are joined, but only if they are at
        most this far apart, in the mesh's length unit, and at most 2^-10 of the largest coordinate.
        Not negative.
    check: if False, also return results that could not be certified; see their `certificate`.

    Raises NotCertifiedError if the result could not be certified.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> treeform.split(a, (a.vertices + 0.5, a.faces)).certificate
    Certificate(ok)
    """
    how = options(_core.BooleanOptions, locals())
    return checked(_core.split(operands_of(meshes), how, progress=progress), check)


def check_operand(mesh: MeshLike, *, progress: Progress = None) -> Certificate:
    """Whether a mesh can be an operand of `boolean`: it must be closed, as given or after it is cut
    along itself. If not, the certificate lists open edges. `find_solid_defects` is stricter.

    Raises ValueError as `boolean`.

    >>> import treeform
    >>> bool(treeform.check_operand(treeform.read("data/cube.stl")))
    True
    >>> treeform.check_operand(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])).open_count
    3
    """
    return _core.check_operand(held(mesh), progress=progress)
# end
