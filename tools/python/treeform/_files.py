"""Files, and work on files that are larger than memory."""

from __future__ import annotations

import os
import shutil
import tempfile
from dataclasses import dataclass
from functools import partial
from typing import IO, Any, Iterable, Mapping, Sequence, Union

from . import _arrays, _core
from ._arrays import path_of
from ._errors import FileError, file_error
from ._mesh import Mesh, MeshLike, as_mesh, listed
from ._progress import Progress
from ._results import Result

__all__ = ["Written", "read", "write"]

Path = Union[str, "os.PathLike[str]"]
Columns = Mapping[str, Union[str, int]]


def named_columns(columns: Columns | None) -> list[tuple[str, str]]:
    return [(a, str(b)) for a, b in (columns or {}).items()]


def read(path: Union[Path, IO[bytes]], format: str = "", *, join: bool = True,
         columns: Columns | None = None, drop_nan: bool = False,
         progress: Progress = None) -> Mesh:
    """The mesh or cloud in a file, or in what is open for reading bytes, such as BytesIO: STL, OBJ,
    PLY, OFF, 3MF, GLB, glTF, PCD, LAS, LAZ, XYZ, CSV, PTS; DAE and others where treeform was built
    with assimp.

    format: an extension without its dot; empty: the content decides, then the extension.
    join: in a format that does not number its vertices (STL) or repeats them (GLB), corners with
    equal coordinates become one vertex, with the attributes of the first of them. Faces keep the
    order and the numbers that they have in the file, and vertices, too, in other formats.
    columns: of XYZ, PTS and CSV, what columns are: {'x': 'E', 'y': 'N', 'z': 'H'}; a number counts
    them from 1.
    drop_nan: drop points with a NaN or infinite coordinate, and their faces.

    Coordinates are float64: those of the file, decimal text rounded once. NaN and infinities are
    kept. Polygons are cut into triangles (`Attributes.stored_face`). A cloud has no faces.

    Raises FileError, an OSError, naming the path, the line or byte, and the reason; where there is
    no such file, it is a FileNotFoundError, too, and so on.

    >>> import io, treeform
    >>> treeform.read("data/cube.stl")
    Mesh(8 vertices, 12 faces)
    >>> treeform.read(io.BytesIO(b"v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n"), format="obj")
    Mesh(3 vertices, 1 faces)
    """
    named = named_columns(columns)
    if isinstance(path, (str, os.PathLike)):
        return Mesh._of(*_core.read(path_of(path), format, join, named, drop_nan,
                                    progress=progress))
    return Mesh._of(*_core.read_bytes(_content(path), _name_of(path), format, join, named, drop_nan,
                                      progress=progress))


def _content(file: Any) -> bytes:
    """All that is left in it."""
    content = file.read() if hasattr(file, "read") else None
    if isinstance(content, (bytes, bytearray, memoryview)):
        return bytes(content)
    if content is None:
        raise ValueError(f"path: a path or a file is needed, not {file!r}")
    raise ValueError(f"path: the file is open for text, not for bytes: {file!r}")


def _name_of(file: Any) -> str:
    """For messages; its extension counts."""
    name = getattr(file, "name", "")
    return name if isinstance(name, str) and name else "bytes"


# made of results:
#   write_result
@dataclass(frozen=True, repr=False)
class Written(Result):
    """What `write` wrote.

    format: 'stl-binary', 'ply-ascii', 'obj', ...
    precision: Of the coordinates written: 'float32' or 'float64'.
    max_displacement: Largest change of a coordinate by rounding to `precision`.
    warnings: What a person should know.
    """

    format: str
    precision: str
    max_displacement: float
    warnings: list[str]
# end


#: What `write` takes: a mesh, or several as parts, with names or without.
PartsLike = Union[MeshLike, Iterable[MeshLike], Mapping[str, MeshLike]]


def write(path: Union[Path, IO[bytes]], mesh: PartsLike, format: str = "", *, ascii: bool = False,
          precision: str | None = None, round: bool = False, drop: Iterable[str] = (),
          rename: Mapping[str, str] | None = None, las_scale: Sequence[float] | None = None,
          las_offset: Sequence[float] | None = None, progress: Progress = None) -> Written:
    """Writes a mesh or a result, with its attributes as far as the format holds them.

    path: of the file; or what is open for writing bytes, such as BytesIO, with `format`.
    mesh: one; or several, which become the parts of the file, named "1", "2", ...; or a dict of
    names and meshes. 3MF and OBJ hold parts; in other formats they are one mesh, and a warning says
    so. Of several, columns of vertices and faces are left out.
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
    put = partial(_write, mesh, format, (ascii, precision, round, list(drop),
                                         [(b, a) for a, b in (rename or {}).items()],
                                         None if las_scale is None else list(las_scale),
                                         None if las_offset is None else list(las_offset)), progress)
    if isinstance(path, (str, os.PathLike)):
        return put(path_of(path))
    if not hasattr(path, "write"):
        raise ValueError(f"path: a path or a file is needed, not {path!r}")
    name = _name_of(path)
    if not format and "." not in name:
        raise ValueError("format: it has to be said for a file without a name")
    with tempfile.TemporaryDirectory() as folder:
        beside = os.path.join(folder, os.path.basename(name))
        try:
            written = put(beside)
        except FileError as error:
            raise file_error(str(error).replace(beside, name), error.errno or 0, name) from None
        with open(beside, "rb") as whole:
            shutil.copyfileobj(whole, path)
    return written


def _write(mesh: PartsLike, format: str, options: tuple[Any, ...], progress: Progress,
           path: str) -> Written:
    parts = mesh if isinstance(mesh, Mapping) else listed(mesh)
    if parts is None:
        made = as_mesh(mesh)
        certified = bool(made._certificate)
    else:
        made, certified = _scene_of(parts if isinstance(parts, Mapping) else {
            str(number): part for number, part in enumerate(parts, 1)})
    put: Any = _core.write
    written: Written = put(path, made._held, made._attributes, certified, format, *options, progress=progress)
    if parts is not None and not written.format.startswith(("3mf", "obj")):
        written.warnings.append(f"parts are one mesh now: {written.format} does not hold them")
    return written


def _scene_of(parts: Mapping[str, Any]) -> tuple[Mesh, bool]:
    """All as one, and whether the coordinates of one are certified."""
    if not parts:
        raise ValueError("mesh: there is none in the list")
    meshes = [as_mesh(part) for part in parts.values()]
    data = [one._attributes for one in meshes]
    made = Mesh._of(*_core.scene([one._held for one in meshes], data,
                                 [_arrays.word(name, "mesh") for name in parts]))
    return made, any(one._certificate for one in meshes)
