"""Files, and work on files that are larger than memory."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Sequence, Union

from . import _core
from ._mesh import Attributes, Mesh, MeshLike, as_mesh
from ._progress import Progress
from ._results import Result

Path = Union[str, "os.PathLike[str]"]


def path_of(path: Path) -> str:
    """`path` as the library takes it."""
    text = os.fspath(path)
    if "\0" in text:
        raise ValueError(f"path: {text!r} has a zero in it")
    return text


def read(path: Path, format: str = "", *, join: bool = True,
         columns: Mapping[str, str | int] | None = None, drop_nan: bool = False,
         progress: Progress = None) -> Mesh:
    """The mesh or cloud in a file: STL, OBJ, PLY, OFF, 3MF, GLB, glTF, PCD, LAS, LAZ, XYZ, CSV, PTS;
    DAE and others where treeform was built with assimp.

    format: an extension without its dot; empty: the content decides, then the extension.
    join: in a format that does not number its vertices (STL) or repeats them (GLB), corners with
    equal coordinates become one vertex, with the attributes of the first of them. Faces keep the order and the numbers that they have in the file, and
    vertices, too, in other formats.
    columns: of XYZ, PTS and CSV, what columns are: {'x': 'E', 'y': 'N', 'z': 'H'}; a number counts
    them from 1.
    drop_nan: drop points with a NaN or infinite coordinate, and their faces.

    Coordinates are float64: those of the file, decimal text rounded once. NaN and infinities are
    kept. Polygons are cut into triangles (`Attributes.stored_face`). A cloud has no faces.

    Raises FileError, an OSError, naming the path, the line or byte, and the reason.

    >>> import treeform
    >>> treeform.read("data/cube.stl")
    Mesh(8 vertices, 12 faces)
    """
    points, faces, data = _core.read(path_of(path), format, join,
                                      [(a, str(b)) for a, b in (columns or {}).items()], drop_nan,
                                      progress=progress)
    return Mesh._of(points, faces, None, Attributes(data))


@dataclass(frozen=True, repr=False)
class Written(Result):
    """What `write` wrote."""

    #: 'stl-binary', 'ply-ascii', 'obj', ...
    format: str
    #: Of the coordinates written: 'float32' or 'float64'.
    precision: str
    #: Largest change of a coordinate by rounding.
    max_displacement: float
    #: What a person should know.
    warnings: list[str]


def write(path: Path, mesh: MeshLike, format: str = "", *, ascii: bool = False,
          precision: str | None = None, round: bool = False, drop: Iterable[str] = (),
          rename: Mapping[str, str] | None = None, las_scale: Sequence[float] | None = None,
          las_offset: Sequence[float] | None = None, progress: Progress = None) -> Written:
    """Writes a mesh or a result, with its attributes as far as the format holds them.

    format: stl, obj, ply, off, 3mf, glb, pcd, las, laz, xyz, csv; empty: that of the path.
    ascii: text where the format has text and binary.
    precision: 'float32' or 'float64'; None: as in the file that was read, else 'float64'. Binary
    STL and GLB hold float32 only.
    round: a mesh whose coordinates were certified (`Mesh.certificate`) may be rounded further, which
    can undo what was certified. Otherwise that is an error: ask the operation for `precision=
    'float32'` instead.
    drop, rename: columns of points that are not written, or under another name: {'old': 'new'}.
    las_scale, las_offset: three numbers for LAS and LAZ; None: those of the file, else chosen.

    The file appears whole or not at all. Raises FileError.

    >>> import tempfile, treeform
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     treeform.write(folder + "/cube.ply", treeform.read("data/cube.stl"))
    Written(format='ply-binary-le', precision='float32', max_displacement=0, warnings=[])
    """
    made = as_mesh(mesh)
    certified = made._certificate is not None and bool(made._certificate)
    data = None if made._attributes is None else made._attributes._data
    return Written(**_core.write(path_of(path), made._held, data, certified, format, ascii, precision,
                                 round, list(drop), [(b, a) for a, b in (rename or {}).items()],
                                 None if las_scale is None else list(las_scale),
                                 None if las_offset is None else list(las_offset),
                                 progress=progress))
