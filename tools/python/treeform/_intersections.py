"""Intersecting faces of a mesh, of two meshes, or of a file larger than memory."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Any, Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _core
from ._arrays import Floats, Ids, path_of
from ._errors import need, options
from ._files import Path
from ._mesh import Mesh, MeshLike, held
from ._progress import Progress
from ._results import Result
from ._steps import Communicator, InSteps, in_communicator

__all__ = ["FacePairs", "FilePairs", "KINDS", "Region", "SharedSearch", "faces_in_box",
           "intersection_curves", "intersection_regions", "mesh_intersections",
           "self_intersections", "self_intersections_of_file", "write_curves"]
# end

#: The kinds of intersecting pairs; numbers in `kinds` are indexes of this list.
KINDS = tuple(_core.KINDS)


# made of headers:
#   FacePairs
@dataclass(frozen=True, repr=False)
class FacePairs(Result):
    """Pairs of faces that meet.

    pairs: (n, 2) uint32, ascending; for one mesh, the lower face first.
    kinds: (n,) uint8: the kind of each pair, an index into `KINDS`.
    counts: Number of pairs of each kind, listed or not.
    """

    pairs: Ids
    kinds: NDArray[np.uint8]
    counts: dict[str, int]
# end

    def __len__(self) -> int:
        return len(self.pairs)

    def of_kind(self, *kinds: str) -> Ids:
        """(n, 2) the pairs of these kinds.

        >>> import treeform
        >>> found = treeform.self_intersections(treeform.read("data/two_spheres.stl"))
        >>> len(found.of_kind("crossing")), len(found.of_kind("touching"))
        (78, 0)
        """
        return self.pairs[np.isin(self.kinds, [KINDS.index(kind) for kind in kinds])]


# made of headers:
#   FilePairs
@dataclass(frozen=True, repr=False)
class FilePairs(FacePairs):
    """Pairs of faces of a file that meet, as numbers of faces of `mesh`.

    mesh: Only the faces in pairs, in the order of the file.
    face_in_file: (F,) the number in the file of each face of `mesh`.
    stored_faces: Faces of the file.
    tiles: Number of tiles into which space was cut.
    non_finite: Number of omitted triangles with a coordinate that is not finite.
    """

    mesh: Mesh
    face_in_file: Ids
    stored_faces: int
    tiles: int
    non_finite: int
# end

    @property
    def pairs_in_file(self) -> Ids:
        """(n, 2) the pairs, as face numbers of the file."""
        return self.face_in_file[self.pairs]


# made of headers:
#   SharedSearch
class SharedSearch(InSteps[_core.SearchInSteps]):
    """`self_intersections_of_file` in steps, for many processes on one machine or on several that
    share a folder, such as those of Dask, Slurm or `multiprocessing`.

    All processes create it with the same arguments. One process calls `scatter`; then each calls
    `search_tile` for some of the tiles; when all tiles are finished, one calls `finish` and
    `remove_folder`. Tiles that are finished are not searched again.

    The folder is locked until `close`, the end of a `with` block, or the end of the object.
    Pickling stores only the arguments. Steps in the wrong order raise FileError, invalid tiles
    IndexError.

    path: the path of the file.
    vertices: None: 'by_coordinates' for STL, otherwise 'by_index'.
    kinds: as for `self_intersections`.
    format: Format of the input, as for `read`.
    memory: Limit in bytes; 0: three quarters of the machine's memory.
    folder: the folder for the tiles; empty: the name of the input with ".search-tiles".
    faces_per_tile: Approximate limit; 0: as the memory allows.

    >>> import tempfile, treeform
    >>> with tempfile.TemporaryDirectory() as home:
    ...     options = dict(folder=home + "/tiles", faces_per_tile=100)
    ...     with treeform.SharedSearch("data/two_spheres.stl", **options) as first:
    ...         count = first.scatter()
    ...     for tile in range(count):  # in as many processes as there are
    ...         with treeform.SharedSearch("data/two_spheres.stl", **options) as one:
    ...             one.search_tile(tile)
    ...     with treeform.SharedSearch("data/two_spheres.stl", **options) as last:
    ...         found = last.finish()
    ...         last.remove_folder()
    >>> count > 1, len(found)
    (True, 78)
    """

    def __init__(self, path: Path, *, vertices: str | None = None,
                 kinds: Iterable[str] | None = None, format: str = "", memory: int = 0,
                 folder: Path = "", faces_per_tile: int = 0,
                 progress: Progress = None) -> None:
        super().__init__(locals())
# end

    def _begin(self, given: dict[str, Any], progress: Progress) -> _core.SearchInSteps:
        how = options(_core.FileSearchOptions, given)
        return _core.search_of(path_of(given["path"]), how, progress=progress)

    def search_tile(self, tile: int, *, progress: Progress = None) -> None:
        """Searches a tile, numbered from 0, unless it is finished."""
        self._do_tile(tile, progress)

    def finish(self, *, progress: Progress = None) -> FilePairs:
        """Merges the results, after all tiles have been searched."""
        return self._work.finish(progress=progress)


def pairs_of(found: FacePairs) -> tuple[Ids, NDArray[np.uint8]]:
    """The pairs and their kinds."""
    need(found, "found", FacePairs)
    return found.pairs, found.kinds


def curves(points: Floats, paths: list[tuple[Ids, bool]]) -> list[Floats]:
    """Curves from paths of point numbers; closed curves repeat their first point."""
    return [points[np.append(path, path[:1]) if closed else path] for path, closed in paths]


# made of headers:
#   self_intersections mesh_intersections self_intersections_of_file Region intersection_regions
#   intersection_curves write_curves faces_in_box
def self_intersections(mesh: MeshLike, *, vertices: str = "by_coordinates",
                       first_only: bool = False, kinds: Iterable[str] | None = None,
                       limit: int | None = None, progress: Progress = None) -> FacePairs:
    """All pairs of faces that meet where they should not: in a point that is neither a shared
    corner nor on a shared edge. A mesh that repeats its vertices, as an STL does, gives the same
    pairs as one that does not (`vertices`).

    Exact on the coordinates as given. A degenerate face (collinear corners) is treated as the
    segment or point that it is; its pairs have a kind of their own.

    The defaults differ from those of the tool tf-selfintersect. Here, touching and degenerate pairs
    are included, and corners with equal coordinates are one vertex; the tool leaves out such pairs,
    and uses the vertex numbers of the file, if it has any. `kinds` and `vertices` change this.

    vertices: 'by_coordinates' or 'by_index'. Which corners count as shared.
    first_only: Only the first pair; the same on any number of threads.
    kinds: the kinds to search for, from `KINDS`; None: all. 'crossing': the faces pass through each
        other and share no vertex; 'pierce': likewise, with one shared vertex; 'overlap': coplanar,
        with a common area; 'fold': coplanar, on the same side of a shared edge; 'duplicate': the
        same three vertices; 'touching': contact without crossing; 'degenerate': a face has no area.
    limit: List at most this many pairs, the lowest; all are counted.

    Raises ValueError naming a face with a corner out of range, or a point that is not finite.

    Cost: O(F log F + B) time for the B pairs whose boxes overlap, about 100 bytes a face.

    >>> import treeform
    >>> m = treeform.read("data/two_spheres.stl")
    >>> treeform.self_intersections(m)
    FacePairs(pairs=uint32[78, 2], kinds=uint8[78], counts={'crossing': 78})
    """
    how = options(_core.FacePairOptions, locals())
    return _core.self_intersections(held(mesh), how, progress=progress)


def mesh_intersections(a: MeshLike, b: MeshLike, *, transform_a: ArrayLike | None = None,
                       transform_b: ArrayLike | None = None, first_only: bool = False,
                       kinds: Iterable[str] | None = None, limit: int | None = None,
                       progress: Progress = None) -> FacePairs:
    """All pairs of a face of `a` and a face of `b` that have a common point.

    Exact on the coordinates as given, or as moved. The kinds are crossing, overlap, touching and
    degenerate: two meshes share no corners, so faces that meet in equal corners are `touching`, and
    equal faces `overlap`. Surfaces count, not solids: a mesh inside the other that does not touch
    it gives no pair. `a` and `b` may be the same mesh. For meshes that are not a `Mesh`, only the
    faces that reach into the intersection of both bounding boxes (after the transforms) are
    indexed.

    transform_a: (4, 4) an affine transform applied to `a` first.
    transform_b: (4, 4) an affine transform applied to `b` first.
    first_only: Only the first pair; the same on any number of threads.
    kinds: the kinds to search for, from `KINDS`; None: all.
    limit: List at most this many pairs, the lowest; all are counted.

    Raises ValueError if a transform is not finite; naming the mesh and its face with a corner that
    is out of range or, after the transform, not finite.

    Cost: O(F log F) for indexes that are not built yet; O(B) time for the B pairs whose boxes
    overlap and the nodes above them. Up to twice as fast for a `Mesh`.

    >>> import treeform
    >>> a = treeform.read("data/cube.stl")
    >>> b = (a.vertices + 0.5, a.faces)
    >>> treeform.mesh_intersections(a, b).counts["crossing"]
    6
    """
    how = options(_core.FacePairOptions, locals())
    return _core.mesh_intersections(held(a), held(b), how, progress=progress)


def self_intersections_of_file(path: Path, *, vertices: str | None = None,
                               kinds: Iterable[str] | None = None, format: str = "",
                               memory: int = 0, folder: Path = "", faces_per_tile: int = 0,
                               communicator: Communicator | None = None,
                               progress: Progress = None) -> FilePairs:
    """The pairs that `self_intersections` finds in the usable part of a file, for files larger than
    memory: binary STL, and PLY with vertices before faces. Space is cut into tiles. Each tile gets
    a copy, on the disk, of the faces that reach into it; they must fit into memory. A pair counts
    once: in the tile that contains the lowest corner of the intersection of its faces' boxes.

    If the process is killed, the folder stays, and the same call resumes there. With several ranks,
    rank 0 makes the tiles, all ranks search them, and rank 0 gets the result.

    vertices: None: 'by_coordinates' for STL, otherwise 'by_index'.
    kinds: as for `self_intersections`.
    format: Format of the input, as for `read`.
    memory: Limit in bytes; 0: three quarters of the machine's memory.
    folder: the folder for temporary tiles; empty: a folder next to the input. If a run was
        interrupted, the same call resumes it.
    faces_per_tile: Approximate limit; 0: as the memory allows.
    communicator: processes that share the work, as for `weld_stream`. Rank 0 gets the result, all
        others an empty one.

    Raises FileError if the file cannot be read or has another format, or if the folder cannot be
    used; ValueError for more than 2^32 - 1 triangles.

    Cost: time as `self_intersections`; memory as in the options, plus the result; on the disk 60 to
    100 bytes for each tile that a face reaches into, and 24 bytes for each vertex of a PLY.

    >>> import treeform
    >>> found = treeform.self_intersections_of_file("data/two_spheres.stl")
    >>> found.counts["crossing"], found.pairs_in_file.shape
    (78, (78, 2))
    """
    how = options(_core.FileSearchOptions, locals())
    return in_communicator(communicator, lambda all: _core.self_intersections_of_file(
        path_of(path), how, all, progress=progress))


@dataclass(frozen=True, repr=False)
class Region(Result):
    """A connected set of faces that meet.

    faces: (n,) ascending.
    bounds: (2, 3) bounding box of the faces.
    pairs: (n,) numbers of its pairs in the list of pairs, ascending.
    """

    faces: Ids
    bounds: Floats
    pairs: Ids


def intersection_regions(mesh: MeshLike, found: FacePairs, *,
                         progress: Progress = None) -> list[Region]:
    """Groups the faces in `found` into regions, in the order of their lowest faces. Two of these
    faces are in one region if a pair or a shared corner links them, directly or through other faces
    of `found`.

    Raises ValueError naming a pair with a face out of range, or the lowest face with a corner out
    of range.

    Cost: O(V + F + pairs) time, up to an inverse Ackermann factor; about 8 bytes a face and 4 a
    point.

    >>> import treeform
    >>> m = treeform.read("data/two_spheres.stl")
    >>> regions = treeform.intersection_regions(m, treeform.self_intersections(m))
    >>> len(regions), len(regions[0].pairs)
    (1, 78)
    """
    return _core.group_pairs(held(mesh), *pairs_of(found), progress=progress)


def intersection_curves(mesh: MeshLike, found: FacePairs, *,
                        progress: Progress = None) -> list[Floats]:
    """The curves along which pairs of faces intersect, each (n, 3); a closed curve repeats its
    first point at the end. Segments are found exactly; their points are rounded to nearest. A
    segment common to several pairs appears only once. Degenerate pairs have no curve.

    found: pairs of faces of `mesh`.

    Raises ValueError naming the pair with a face or a corner that is out of range or not finite;
    for a face without area in a pair of another kind.

    Cost: O(P log P) for P pairs.

    >>> import treeform
    >>> m = treeform.read("data/two_spheres.stl")
    >>> curves = treeform.intersection_curves(m, treeform.self_intersections(m))
    >>> [len(curve) for curve in curves]
    [79]
    """
    return curves(*_core.intersection_paths(held(mesh), *pairs_of(found), progress=progress))


def write_curves(path: Path, mesh: MeshLike, found: FacePairs, format: str = "", *,
                 progress: Progress = None) -> None:
    """Writes the curves along which pairs of faces intersect as polylines, joined as in
    `intersection_curves`. Degenerate pairs have single segments.

    path: the path of the file; "-" is standard output.
    found: pairs of faces of `mesh`.
    format: 'obj' (`v` and `l`) or 'ply' (text, with an element `edge`); empty: the extension of
        `path`.

    Raises FileError for another format, or if the file cannot be written: then a previous file is
    unchanged.

    >>> import tempfile, treeform
    >>> m = treeform.read("data/two_spheres.stl")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     treeform.write_curves(folder + "/curves.obj", m, treeform.self_intersections(m))
    """
    return _core.write_curve_file(path_of(path), held(mesh), *pairs_of(found),
                           _arrays.word(format, "format"), progress=progress)


def faces_in_box(mesh: MeshLike, min: ArrayLike, max: ArrayLike, *,
                 progress: Progress = None) -> Ids:
    """The faces, ascending, that have a point in the closed box from `min` to `max`.

    Exact: faces are tested, not their boxes. A face that only touches the box is included. The box
    may be flat, a line or a point.

    min: (3,) the lower corner of the box.
    max: (3,) the upper corner of the box.

    Raises ValueError when a coordinate of the box is not finite or min exceeds max, or naming the
    lowest face with a corner out of range.

    Cost: O(F) time.

    >>> import treeform
    >>> treeform.faces_in_box(treeform.read("data/cube.stl"), [0, 0, 0], [0, 0, 0]).size
    3
    """
    return _core.faces_in_box(held(mesh), _arrays.vector(min, "min"), _arrays.vector(max, "max"),
                              progress=progress)
# end
