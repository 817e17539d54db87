"""Reading and writing of files."""

from __future__ import annotations

# made of uses:
import os
import shutil
import tempfile
from dataclasses import dataclass
from functools import partial
from typing import IO, Any, Iterable, Mapping, Sequence, Union
from warnings import warn

from . import _arrays, _core
from ._arrays import path_of
from ._errors import FileError, file_error, options, require
from ._mesh import MeshOrCloud, Mesh, MeshLike, as_mesh, held, listed
from ._progress import Progress
from ._results import Result

__all__ = ["Written", "file_parts", "read", "write"]
# end

Path = Union[str, "os.PathLike[str]"]
Columns = Mapping[str, Union[str, int]]


def read_from(path: Path | IO[bytes], format: str, join: bool, how: _core.ReadOptions,
              progress: Progress) -> Mesh:
    """Reads a path or a file object."""
    format, join = _arrays.word(format, "format"), _arrays.flag(join, "join")
    if isinstance(path, (str, os.PathLike)):
        made = _core.read(name := path_of(path), format, join, how, progress=progress)
    else:
        made = _core.read_bytes(_content(path), name := _name_of(path), format, join, how,
                                progress=progress)
    for _, text in made.attributes.warnings:
        warn(f"{name}: {text}", stacklevel=3)
    return made


def _content(file: Any) -> bytes:
    """The rest of a file object."""
    content = file.read() if hasattr(file, "read") else None
    if isinstance(content, (bytes, bytearray, memoryview)):
        return bytes(content)
    if content is None:
        raise ValueError(f"path: expected a path or a file, not {file!r}")
    raise ValueError(f"path: the file is open for text, not in binary mode: {file!r}")


def _name_of(file: Any) -> str:
    """A name for messages; its extension may tell the format."""
    name = getattr(file, "name", "")
    return name if isinstance(name, str) and name else "bytes"


#: What `write` takes: a mesh or cloud, several meshes as parts, or a dict of parts by name.
PartsLike = Union[MeshOrCloud, Iterable[MeshLike], Mapping[str, MeshLike]]


def written(path: Path | IO[bytes], mesh: PartsLike, format: str, how: _core.WriteOptions,
            progress: Progress) -> Written:
    """Writes to a path or a file object."""
    put = partial(_write, mesh, how, progress)
    if isinstance(path, (str, os.PathLike)):
        return put(path_of(path), path_of(path))
    if not hasattr(path, "write"):
        raise ValueError(f"path: expected a path or a file, not {path!r}")
    name = _name_of(path)
    if not format and "." not in name:
        raise ValueError("format: required for a file object without a name")
    with tempfile.TemporaryDirectory() as folder:
        beside = os.path.join(folder, os.path.basename(name))
        try:
            written = put(beside, name)
        except FileError as error:
            raise file_error(str(error).replace(beside, name), error.errno or 0, name) from None
        with open(beside, "rb") as whole:
            shutil.copyfileobj(whole, path)
    return written


def _write(mesh: Any, how: _core.WriteOptions, progress: Progress, path: str, name: str) -> Written:
    parts = mesh if isinstance(mesh, Mapping) else listed(mesh)
    for one in parts.values() if isinstance(parts, Mapping) else parts or (mesh,):
        if not isinstance(one, Mesh) and getattr(one, "certificate", None) is not None:
            require(one.certificate, of="")
    if parts is None:
        made = Mesh(mesh) if hasattr(mesh, "dtype") else as_mesh(mesh)
        certified = bool(made._certificate)
    else:
        made, certified = _scene_of(parts if isinstance(parts, Mapping) else {
            str(number): part for number, part in enumerate(parts, 1)})
    written = _core.write(path, made._held, certified, how, path if name == path else "-",
                          progress=progress)
    if parts is not None and not written.format.startswith(("3mf", "obj")):
        written.warnings.append(f"parts were merged: {written.format} cannot store parts")
    for text in written.warnings:
        warn(f"{name}: {text}", stacklevel=4)
    return written


def _scene_of(parts: Mapping[str, Any]) -> tuple[Mesh, bool]:
    """All parts as one scene, and whether the coordinates of any part are certified."""
    if not parts:
        raise ValueError("mesh: the list is empty")
    meshes = [as_mesh(part) for part in parts.values()]
    made = _core.scene([one._held for one in meshes],
                       [_arrays.word(name, "mesh") for name in parts])
    return made, any(one._certificate for one in meshes)


# made of headers:
#   file_parts
def file_parts(mesh: MeshLike, *, combine_patches: bool = False,
               progress: Progress = None) -> dict[str, Mesh]:
    """The parts of a mesh that was read from a file, by name: the objects, groups or nodes of the
    file. Each has its own vertices and faces, and their attributes. Parts without a name are "1",
    "2", ... For the connected parts of any mesh, see `components`.

    combine_patches: combine parts with a common vertex, or whose open edges coincide: the patches
        of one surface.

    Raises ValueError naming the lowest face with a corner out of range.

    Cost: O(V log V + F log F), and O(V + F) for each part and column.

    >>> import io, treeform
    >>> cube, file = treeform.read("data/cube.stl"), io.BytesIO()
    >>> _ = treeform.write(file, {"lid": cube, "box": (cube.vertices - 3, cube.faces)}, "3mf")
    >>> treeform.file_parts(treeform.read(io.BytesIO(file.getvalue())))
    {'lid': Mesh(8 vertices, 12 faces), 'box': Mesh(8 vertices, 12 faces)}
    """
    return _core.file_parts(held(mesh), _arrays.flag(combine_patches, "combine_patches"),
                            progress=progress)
# end


# made of headers:
#   read Written write
def read(path: Path | IO[bytes], format: str = "", *, join: bool = True,
         columns: Columns | None = None, drop_non_finite: bool = False,
         progress: Progress = None) -> Mesh:
    """Reads the file at `path`; "-" is standard input. `format` is an extension without its dot
    ("stl", "obj", "ply", "off", "pcd", "xyz", "csv", "3mf", "glb", ...). If empty, the format is
    detected by content first, then by extension.

    Coordinates are as stored: float32 widened to double, decimal text rounded once to the nearest
    double. NaN and infinity are kept, so that the caller can report them (`find_invalid_faces`).

    - OBJ: `vt` and `vn` are in `Attributes.corners`. Material files are read if they exist and the
      OBJ has a path: the diffuse colors of its materials become columns red, green, blue and, where
      one is not opaque (`d`), alpha of faces; faces without a material are white.
    - STL: if a binary file has the size of whole triangles, a wrong count in its header is ignored.
      Otherwise, bytes after the counted triangles are ignored. ASCII may have zero bytes between
      words, and words after `endloop` and `endfacet`. `Attributes.warnings` reports all of these.
    - PLY: triangle strips, the element "tristrips", become faces, also those that repeat a vertex.
    - PLY: the list "texcoord" of faces is in `Attributes.corners` if each of these lists is empty
      or has two numbers for each corner.
    - Text without a header (XYZ, CSV): the first line may name the columns. Then x, y and z may be
      any columns; names such as easting, northing and elevation are accepted with a warning,
      latitude and longitude are refused. `columns` assigns columns explicitly. An empty cell, or
      one with text, is NaN. A column with an integer beyond 2^53 gets a 64-bit integer type.
      Columns of colors have 8 or 16 bits if all values are integers in that range.
    - PTS: as XYZ. If the first line is the number of points, 4 columns are x y z intensity, 6 are x
      y z red green blue, and 7 have both. More points than announced are read with a warning; fewer
      are an error. The format is reported as "xyz".
    - PCD: a field of several values becomes columns "name[0]", "name[1]", ...
    - LAS and LAZ: columns are the fields of its records. LAZ of LASzip 1 to 3, COPC included; extra
      bytes as described in the file.
    - 3MF: the items of the build. Each mesh of an item, directly or through components, is a part
      with a unique name ("gear", "gear (2)"), transformed; faces of mirrored parts are flipped, so
      that they are not inside out. Supports and surfaces are read like models; objects of type
      "other" and objects outside the build are not read. Items and components may be in other model
      parts of the package. Base materials are materials of parts, and their colors and those of
      color groups become columns red, green, blue and alpha of faces, or of points where corners
      have colors of their own. Texture coordinates are in `Attributes.corners`; images are not
      read. Extensions that a file requires and that would change its shape are refused.
    - glTF 2.0 and GLB: the default scene. Draco compression is supported if treeform was built with
      it. Each mesh of a node, also as an instance of EXT_mesh_gpu_instancing, is a part with a
      unique name, from the node or the mesh, transformed by matrices composed in double; faces of
      mirrored parts are flipped. Strips and fans are triangles. COLOR_0 becomes columns red, green,
      blue and alpha of points, in the type and with the numbers of the file; NORMAL becomes nx, ny
      and nz, rotated with the node. The texture coordinates of the material's base color, with
      KHR_texture_transform applied, become s and t = 1 - v, since other formats count t from the
      lower edge. Colors of materials become columns red, green, blue and alpha of faces, of 8 bits.
      Textures, other attributes and lines are not read; morph targets and skins are not applied.
      Files that a glTF refers to are read only from its folder and subfolders. Extensions that a
      file requires are refused by name, except for KHR_mesh_quantization and those that only change
      how a surface looks. glTF 1.0 is read by assimp.

    Each of `Attributes.warnings` is also a warning of Python (`warnings.warn`). Polygons are
    triangulated (`Attributes.face_of_triangle`). A point cloud has no faces. DAE and some other
    formats require a build with assimp. If the file does not exist, the FileError is also a
    FileNotFoundError, and likewise for other system errors.

    path: the path of the file, or a binary file object, such as BytesIO.
    format: a file extension without its dot; empty: determined by the content, then by the
        extension.
    join: for formats that have no vertex numbers (STL) or repeat vertices (GLB), merge corners with
        equal coordinates into one vertex, which has the attributes of the first of them. Faces keep
        their numbers in the file; in other formats, so do vertices.
    columns: for XYZ, PTS and CSV, which column of the file to use for which property: {'x': 'E',
        'y': 'N', 'z': 'H'}; columns can also be given by number, from 1.
    drop_non_finite: drop points with a NaN or infinite coordinate, and their faces.

    Raises FileError naming path, line or byte, and reason.

    >>> import io, treeform
    >>> treeform.read("data/cube.stl")
    Mesh(8 vertices, 12 faces)
    >>> treeform.read(io.BytesIO(b"v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n"), format="obj")
    Mesh(3 vertices, 1 faces)
    """
    how = options(_core.ReadOptions, locals())
    return read_from(path, format, join, how, progress)


@dataclass(frozen=True, repr=False)
class Written(Result):
    """The result of `write`.

    format: 'stl-binary', 'ply-ascii', 'obj', ...
    precision: Precision of the written coordinates: 'float32' or 'float64'.
    max_displacement: Largest change of a coordinate by rounding to `precision`.
    warnings: Remarks about the file.
    """

    format: str
    precision: str
    max_displacement: float
    warnings: list[str]


def write(path: Path | IO[bytes], mesh: PartsLike, format: str = "", *, ascii: bool = False,
          precision: str | None = None, drop: Iterable[str] = (), rename: Columns | None = None,
          las_scale: Sequence[float] | None = None, las_offset: Sequence[float] | None = None,
          round: bool = False, progress: Progress = None) -> Written:
    """Writes `mesh` to `path`; "-" is standard output, which needs `format`.

    A file is written completely or not at all: it is written under another name and then renamed.
    Numbers in text are the shortest that read back as the same double, float32 values included.
    Polygons are written as polygons if the format has polygons. Newlines in names become blanks.

    Each format stores what it can of `Attributes`:
    - PLY: all elements in their order; texture coordinates of corners, as the list "texcoord" of
      faces with two numbers a corner, in float32 unless the file has that list as double (NaN where
      a corner has none); names of texture files, after the comments.
    - OBJ: parts, material files, texture coordinates and normals of corners (else those of points),
      colors of vertices.
    - OFF: normals, colors and texture coordinates of points.
    - STL: the header, without a leading "solid"; if it has no NUL byte, its last byte becomes NUL;
      the names of solids; the column "stl_attribute".
    - XYZ and CSV: the other columns of points.
    - LAS and LAZ: the fields of their records; other columns as extra bytes. Columns red, green and
      blue of 8 bits are multiplied by 256. Without columns for them, return_number and
      number_of_returns are 1. Intensities that are not integers are rounded, or multiplied by 65535
      if all are from 0 to 1. scan_angle_rank becomes scan_angle in point formats 6 to 10.
      Coordinates that are not multiples of the file's scale are rounded (`max_displacement`). A
      file that was not LAS gets the smallest format that holds its columns, and for each axis the
      coarsest scale of 1, 0.1, 0.01, ... that gives all coordinates back within two units in their
      last place, else the finest that 32 bits allow.
    - GLB: one node and mesh for each run of faces of the same object and group, with its name and
      the points that it uses. Each mesh has one primitive, with a material, for each color of its
      faces (columns red, green, blue and, if present, alpha of the element "face"). Of the columns
      of points, red, green, blue and alpha become COLOR_0 (8 and 16 bits unchanged, other types as
      floats from 0 to 1); nx, ny and nz become NORMAL, scaled to length 1; s and t, u and v, or
      texture_u and texture_v become TEXCOORD_0 (u = s, v = 1-t). Normals and texture coordinates of
      corners take precedence over those of points; a point with several of them is repeated.
    - 3MF: one object and one item of the build for each part, with its name; materials of parts
      with the colors of their faces; else colors of faces, else of points; the unit in the line
      "obj_info unit ..." of a PLY file, else millimeters. Polygons are written as triangles.
      Numbers are written as the shortest text of the double, so that readers of floats and of
      doubles get the same value.

    Columns of points that several formats have get the name and type of the written format: colors
    are red, green and blue of 8 bits, but in LAS of 16, in PCD the packed `rgb`, in OBJ numbers
    from 0 to 1; normals are nx, ny, nz, in PCD normal_x, ..., in OBJ `vn`. If a file was read from
    the format that is written, its columns are unchanged.

    `Written.warnings` lists what is scaled, rounded or omitted.

    An empty mesh can be written in every mesh format, and read again.

    A result that is not certified is refused (NotCertifiedError, NotClosedError): pass its `mesh`
    to write that. Names of material and texture files are relative to the folder of `path`; in a
    file object, as in the input. Each of `Written.warnings` is also a warning of Python
    (`warnings.warn`).

    path: the path of the file, or a binary file object, such as BytesIO, with `format`.
    mesh: a mesh, or a cloud (n, 3); or several meshes, which become parts of the file, named "1",
        "2", ...; or a dict of names and meshes. 3MF and OBJ can store parts; in other formats they
        become one mesh, with a warning. With several meshes, columns of vertices and faces are not
        written.
    format: Extension without its dot: stl, obj, ply, off, xyz, csv, pcd, las, laz, glb, 3mf. Empty:
        the extension of the path.
    ascii: Write text if the format has text and binary. Binary PLY is little endian, unless the
        file was read from a big-endian file. PCD is compressed only if it was read from a
        compressed file.
    precision: 'float32' or 'float64'. Precision of the coordinates; None: the stored precision, but
        float32 in 3MF, since most of its readers convert to float. Binary STL and GLB only hold
        float32.
    drop: Columns of points to omit; "normal", "uv" or "color" for all columns of that kind, also of
        corners.
    rename: new names for columns of points: {'old': 'new'}.
    las_scale: For LAS and LAZ: coordinates are multiples of this, plus the offset. By default those
        of the file that was read, else chosen by `write`.
    las_offset: likewise.
    round: allow rounding certified coordinates (`Mesh.certificate`) to the precision of the file.
        The rounded mesh may no longer have the certified properties, so this is an error by
        default: compute the result with `precision='float32'` instead.

    Raises FileError if the format cannot hold the file, or the file cannot be written; ValueError
    for a corner out of range; unless the elements "vertex" and "face" have one row for each point
    and stored face; for an index in `Attributes.corners` out of range.

    >>> import tempfile, treeform
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     treeform.write(folder + "/cube.ply", treeform.read("data/cube.stl"))
    Written(format='ply-binary-le', precision='float32', max_displacement=0, warnings=[])
    """
    how = options(_core.WriteOptions, locals())
    return written(path, mesh, format, how, progress)
# end
