"""Merging of nearby points: in meshes, clouds, and files larger than memory."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass
from typing import Any, Iterable, Mapping

from numpy.typing import ArrayLike

from . import _arrays, _core
from ._arrays import Floats, Ids, path_of
from ._errors import options
from ._files import Columns, Path
from ._mesh import MeshOrCloud, Mesh, MeshResult, held_body
from ._progress import Progress
from ._results import Result
from ._steps import Communicator, InSteps, in_communicator

__all__ = ["SharedWeld", "WeldResult", "WeldStreamResult", "count_nearly_equal", "weld",
           "weld_stream"]
# end


# made of headers:
#   WeldResult
@dataclass(frozen=True, repr=False)
class WeldResult(MeshResult):
    """A welded mesh or cloud.

    mesh: The welded mesh; without faces for a cloud.
    face_source: (F,) the input face of each face; empty for a cloud.
    statistics: Counts of what welding changed. Keys: 'groups' (Groups of two points or more);
        'non_finite' (Points with a NaN or infinite coordinate, left as they are); 'collapsed'
        (Faces that repeat a corner only after the weld); 'degenerate' (Faces that repeated a corner
        before); 'max_displacement' (The largest distance that a point moved, rounded up to a
        double); 'nonmanifold_before' (Edges of more than two faces); 'nonmanifold_after'; 'flipped'
        (Kept faces whose normal turned by more than a right angle); 'kept_apart' (Groups that
        `keep_manifold` did not merge completely).
    vertex_source: (m,) the input point whose properties each new point has.
    group_of_point: (n,) the new number of each point.
    """

    mesh: Mesh
    face_source: Ids
    statistics: dict[str, Any]
    vertex_source: Ids
    group_of_point: Ids
# end

    @property
    def points(self) -> Floats:
        """(m, 3) the points of the result."""
        return self.mesh.vertices


def inputs_of(files: Path | Iterable[Path], columns: Columns | None,
              mixed: bool) -> _core.CloudInputs:
    """Input files, treated as one."""
    paths = _arrays.paths(files, "files")
    if not paths:
        raise ValueError("files: there are none")
    return options(_core.CloudInputs, locals())


def streamed(inputs: _core.CloudInputs, how: _core.WeldStreamOptions, out: Path, removed: Path,
             label: str, withhold: bool, communicator: Communicator | None,
             progress: Progress) -> WeldStreamResult:
    """Implements `weld_stream`."""
    return in_communicator(communicator, lambda all: _core.weld_stream(
        inputs, how, path_of(out), path_of(removed), _arrays.word(label, "label"), withhold, all,
        progress=progress))


# made of headers:
#   SharedWeld
class SharedWeld(InSteps[_core.WeldInSteps]):
    """`weld_stream` in steps, for many processes on one machine or on several that share a folder,
    such as those of Dask, Slurm or `multiprocessing`.

    All processes create it with the same arguments. One process calls `scatter`; then each calls
    `weld_tile` for some of the tiles; when all tiles are finished, one calls `finish` and
    `remove_folder`. Tiles that are finished are not welded again.

    The folder is locked until `close`, the end of a `with` block, or the end of the object;
    `finish` requires that all others have unlocked it. Pickling stores only the arguments. Steps in
    the wrong order raise FileError, invalid tiles IndexError. After Cancelled, create a new object.

    files: one or several files of points, read as one cloud; or one file of a mesh.
    tolerance: as for `weld`.
    relative: Whether `tolerance` is a fraction of the diagonal of the bounding box.
    chain: merge all points that are connected by a chain of points, each within the tolerance of
        the next. By default, a point is dropped if it is within the tolerance of an earlier point
        that is kept.
    same: vertex properties that must agree for points to be merged, each with the largest
        difference allowed.
    keep: which point of a group is kept: 'first', 'last', 'mean', or the one with the 'lowest' or
        'highest' value of `keep_by`.
    keep_by: a vertex property.
    order_by: a vertex property: visit the points in ascending order of its values. Requires `keep`
        'first'. Empty: in the order of their numbers.
    highest_first: visit the points in descending order of `order_by`.
    keep_seams: merge only points with equal normals, texture coordinates and colors, except for
        those in `ignored_seams`.
    ignored_seams: properties that `keep_seams` ignores.
    keep_degenerate: keep faces that have the same vertex more than once.
    as_las: if `out` is a LAS file: round the coordinates, and means of coordinates, to the
        resolution of that file before they are compared.
    memory: memory limit of the process, in bytes; 0: three quarters of the memory of the machine.
    folder: the folder for the tiles; empty: the name of the first input with ".tiles".
    points_per_tile: Approximate limit; 0: as the memory allows.
    columns: as for `read`.
    mixed: allow LAS files with different coordinate reference systems or time types. The output has
        those of the first file.

    >>> import os, tempfile, treeform
    >>> with tempfile.TemporaryDirectory() as home:
    ...     cloud = os.path.join(home, "cloud.xyz")
    ...     _ = treeform.write(cloud, ([[x, 0, 0] for x in range(1000)], []))
    ...     options = dict(tolerance=1.5, points_per_tile=100)
    ...     with treeform.SharedWeld(cloud, **options) as first:
    ...         count = first.scatter()
    ...     for tile in range(count):  # in as many processes as there are
    ...         with treeform.SharedWeld(cloud, **options) as one:
    ...             one.weld_tile(tile)
    ...     with treeform.SharedWeld(cloud, **options) as last:
    ...         done = last.finish(os.path.join(home, "thin.xyz"))
    ...         last.remove_folder()
    >>> count > 1, done.kept
    (True, 500)
    """

    def __init__(self, files: Path | Iterable[Path], tolerance: float = 0.0, *,
                 relative: bool = False, chain: bool = False,
                 same: Mapping[str, float] | None = None, keep: str = "first", keep_by: str = "",
                 order_by: str = "", highest_first: bool = False, keep_seams: bool = False,
                 ignored_seams: Iterable[str] = (), keep_degenerate: bool = False,
                 as_las: bool = False, memory: int = 0, folder: Path = "", points_per_tile: int = 0,
                 columns: Columns | None = None, mixed: bool = False,
                 progress: Progress = None) -> None:
        super().__init__(locals())
# end

    def _begin(self, given: dict[str, Any], progress: Progress) -> _core.WeldInSteps:
        inputs = inputs_of(given["files"], given["columns"], given["mixed"])
        return _core.weld_of(inputs, options(_core.WeldStreamOptions, given), progress=progress)

    def weld_tile(self, tile: int, *, progress: Progress = None) -> None:
        """Welds a tile, numbered from 0, unless it is finished."""
        self._do_tile(tile, progress)

    def finish(self, out: Path, *, removed: Path = "", label: str = "", withhold: bool = False,
               progress: Progress = None) -> WeldStreamResult:
        """Welds across the borders of tiles, after all tiles have been welded, and writes the
        outputs. On an error, no incomplete file remains. Can be called once."""
        return self._work.finish(path_of(out), path_of(removed), _arrays.word(label, "label"),
                                 withhold, progress=progress)


# made of headers:
#   weld count_nearly_equal WeldStreamResult weld_stream
def weld(mesh_or_points: MeshOrCloud, tolerance: float = 0.0, *, chain: bool = False,
         same: Mapping[str, float] | None = None, keep_seams: bool = False,
         ignored_seams: Iterable[str] = (), keep: str = "first", keep_by: str = "",
         order_by: str = "", highest_first: bool = False, only_borders: bool = False,
         keep_manifold: bool = False, keep_degenerate: bool = False, label: ArrayLike | None = None,
         progress: Progress = None) -> WeldResult:
    """Merges the points of a mesh or point cloud that are within the tolerance of each other.

    Distances are compared exactly, on the coordinates as given. Points are in the order of the
    first points of their groups; faces keep their order. With 'first', kept points keep their
    coordinates bit for bit. A point with a NaN or infinite coordinate is never merged, not even
    with a copy of itself.

    Faces that repeat a corner are dropped unless `keep_degenerate` is set: those that repeated it
    before (`degenerate`) and those that do now (`collapsed`). So input faces = faces of the result
    + collapsed + degenerate. Faces that became equal to others are kept. Edges are counted over
    faces with three different corners.

    With `keep` other than `first`, kept points may be within the tolerance of each other again, and
    without `chain` a point may move by twice the tolerance.

    A mean is the first point's value plus the mean of the differences from it, added in the order
    of points and rounded at each step. For n values that differ by at most d, its error is at most
    n d 2^-52 plus one unit in the last place. It is between the least and the greatest value;
    float32 columns are rounded once more. Averaged normals are not scaled to length 1. A mean with
    a NaN or an infinity is NaN.

    With `keep_manifold`, points of a group are merged only where two edges become one edge of at
    most two faces, or where an edge shrinks to a point. All points of a group that are linked in
    this way become one point, with a first, last or mean of its own; the other points of the group
    stay separate. Points without faces join the lowest such set of points with faces. So a surface
    that was cut open closes along its seams, while solids that meet in an edge or a corner stay
    apart. If merging a group would still make an edge or a point nonmanifold, because a point was
    nonmanifold before or faces collapse, the group is not merged. Points with equal coordinates are
    merged first, and then the merged points. So coincident corners stay merged, even if the rest of
    their group is not. In the result, an edge has more than two faces only if it had before, and a
    point has several fans only if one of the points merged into it had. Points of one group may
    stay within the tolerance of each other, and without `chain` a point may move by twice the
    tolerance.

    mesh_or_points: a mesh, points (n, 3), or an object with `points` or `vertices` and no faces.
    tolerance: Euclidean, inclusive; 0: equal coordinates (-0 equals +0).
    chain: merge all points that are connected by a chain of points, each within the tolerance of
        the next. By default, a point is dropped if it is within the tolerance of an earlier point
        that is kept.
    same: vertex properties that must agree for points to be merged, each with the largest
        difference allowed.
    keep_seams: merge only points with equal normals, texture coordinates and colors, except for
        those in `ignored_seams`.
    ignored_seams: properties that `keep_seams` ignores.
    keep: which point of a group is kept: 'first', 'last', 'mean', or the one with the 'lowest' or
        'highest' value of `keep_by`.
    keep_by: a vertex property.
    order_by: a vertex property: visit the points in ascending order of its values. Requires `keep`
        'first'. Empty: in the order of their numbers.
    highest_first: visit the points in descending order of `order_by`.
    only_borders: Merge only points on edges of exactly one face.
    keep_manifold: Split groups that would make non-manifold edges or points.
    keep_degenerate: Keep faces that repeat a corner.
    label: (n,) a label for each point; points with different labels are never merged.

    Raises ValueError for a tolerance that is negative or not finite; unless there is one label for
    each point; for more than 2^32 - 2 points; for a corner out of range; for a property that is
    missing or is a list; for `order_by` with another `keep` than `first`; for more than 2^32 / 3
    faces with `keep_manifold`. The message names the lowest invalid element.

    Cost: Parallel. Exception: without `chain`, points with several others within the tolerance are
    processed serially if points are ordered row by row, or if few are kept. Memory besides the
    result: up to 36 bytes a point (50 for dense chains), 40 more with `order_by`; 24 bytes a face,
    100 with `keep_manifold`; 8 bytes a point for each property in a condition.

    >>> import treeform
    >>> thin = treeform.weld([[0, 0, 0], [0, 0, 0.5], [3, 0, 0]], 1.0)
    >>> thin.points.tolist(), thin.group_of_point.tolist()
    ([[0.0, 0.0, 0.0], [3.0, 0.0, 0.0]], [0, 0, 1])
    """
    how = options(_core.WeldOptions, locals())
    return _core.weld(held_body(mesh_or_points), how, _arrays.labels(label, "label"),
                      progress=progress)


def count_nearly_equal(points: ArrayLike, distance: float, *, progress: Progress = None) -> int:
    """The number of points that joining points within `distance` of each other would remove, beyond
    those that joining equal points removes.

    >>> import treeform
    >>> treeform.count_nearly_equal([[0, 0, 0], [0, 0, 0], [0, 0, 0.5]], 1.0)
    1
    """
    return _core.count_nearly_equal(_arrays.points(points, "points"),
                                    _arrays.number(distance, "distance"), progress=progress)


@dataclass(frozen=True, repr=False)
class WeldStreamResult(Result):
    """The result of `weld_stream`.

    points: Number of points in the inputs.
    kept: Number of kept points.
    max_displacement: Upper bound of the distance that a point moved, rounding for LAS included.
    tolerance: The tolerance as a length.
    non_finite: Number of points that are not finite; all are kept.
    tiles: Number of tiles into which space was cut.
    continued: Whether this run resumed an earlier one.
    faces: For a mesh, number of kept faces.
    statistics: Counts of what welding changed, as in `WeldResult`. Keys: 'groups' (Groups of two
        points or more); 'non_finite' (Points with a NaN or infinite coordinate, left as they are);
        'collapsed' (Faces that repeat a corner only after the weld); 'degenerate' (Faces that
        repeated a corner before); 'max_displacement' (The largest distance that a point moved,
        rounded up to a double); 'nonmanifold_before' (Edges of more than two faces);
        'nonmanifold_after'; 'flipped' (Kept faces whose normal turned by more than a right angle);
        'kept_apart' (Groups that `keep_manifold` did not merge completely).
    warnings: Remarks about the files.
    triangles: Number of triangles of these faces.
    """

    points: int
    kept: int
    max_displacement: float
    tolerance: float
    non_finite: int
    tiles: int
    continued: bool
    faces: int
    statistics: dict[str, Any]
    warnings: list[str]
    triangles: int


def weld_stream(files: Path | Iterable[Path], out: Path, tolerance: float = 0.0, *,
                relative: bool = False, chain: bool = False,
                same: Mapping[str, float] | None = None, keep: str = "first", keep_by: str = "",
                order_by: str = "", highest_first: bool = False, keep_seams: bool = False,
                ignored_seams: Iterable[str] = (), keep_degenerate: bool = False,
                as_las: bool = False, memory: int = 0, folder: Path = "", points_per_tile: int = 0,
                removed: Path = "", label: str = "", withhold: bool = False,
                columns: Columns | None = None, mixed: bool = False,
                communicator: Communicator | None = None,
                progress: Progress = None) -> WeldStreamResult:
    """Welds the cloud in the files `files` (PLY without faces, PCD, LAS, LAZ, PTS, XYZ, CSV), and
    writes the outputs. Each output file is written completely or not at all. A single PLY or binary
    STL may be a mesh: then faces get their new corners, and collapsed faces are dropped, as by
    `weld`. `out` must then be PLY or OBJ, and an STL needs tolerance 0 or `chain`. Of several
    ranks, each processes a share of the points and faces.

    The outputs are the same, byte for byte, as those of `weld` for the whole input.

    files: one or several files of points, read as one cloud; or one file of a mesh.
    tolerance: as for `weld`.
    relative: Whether `tolerance` is a fraction of the diagonal of the bounding box.
    chain: merge all points that are connected by a chain of points, each within the tolerance of
        the next. By default, a point is dropped if it is within the tolerance of an earlier point
        that is kept.
    same: vertex properties that must agree for points to be merged, each with the largest
        difference allowed.
    keep: which point of a group is kept: 'first', 'last', 'mean', or the one with the 'lowest' or
        'highest' value of `keep_by`.
    keep_by: a vertex property.
    order_by: a vertex property: visit the points in ascending order of its values. Requires `keep`
        'first'. Empty: in the order of their numbers.
    highest_first: visit the points in descending order of `order_by`.
    keep_seams: merge only points with equal normals, texture coordinates and colors, except for
        those in `ignored_seams`.
    ignored_seams: properties that `keep_seams` ignores.
    keep_degenerate: keep faces that have the same vertex more than once.
    as_las: if `out` is a LAS file: round the coordinates, and means of coordinates, to the
        resolution of that file before they are compared.
    memory: memory limit of the process, in bytes; 0: three quarters of the memory of the machine.
    folder: the folder for temporary tiles; empty: a folder next to the first input. If a run was
        interrupted, the same call resumes it.
    points_per_tile: Approximate limit; 0: as the memory allows.
    removed: a file for the dropped points.
    label: write all points, with the number of their group as a property of this name.
    withhold: write all points, and set the LAS flag "withheld" for those dropped.
    columns: as for `read`.
    mixed: allow LAS files with different coordinate reference systems or time types. The output has
        those of the first file.
    communicator: processes that share the work, in a folder that all can access: an object with
        `rank`, `size` and `allgather`, such as `mpi4py.MPI.COMM_WORLD`. All processes make the same
        call. If one fails or is interrupted, all others raise an error at their next collective
        call.

    Raises FileError if an input cannot be read, an output cannot be written, or the folder cannot
    be used; ValueError for a tolerance that is negative or not finite, and as `weld`.

    Cost: O(V log V) time; memory as in the options; on the disk 34 bytes a point, 8 more for each
    condition, 48 for `order_by`, and the size of the points in memory for a `keep` other than
    `first`; for a mesh up to 56 more, and 48 a triangle; for a compressed PCD also its unpacked
    points.

    >>> import os, tempfile, treeform
    >>> with tempfile.TemporaryDirectory() as home:
    ...     cloud = os.path.join(home, "cloud.xyz")
    ...     _ = treeform.write(cloud, ([[0, 0, 0], [0, 0, 0.5], [3, 0, 0]], []))
    ...     done = treeform.weld_stream(cloud, os.path.join(home, "thin.xyz"), 1.0)
    >>> done.points, done.kept
    (3, 2)
    """
    how = options(_core.WeldStreamOptions, locals())
    return streamed(inputs_of(files, columns, mixed), how, out, removed, label, withhold,
                    communicator, progress)
# end
