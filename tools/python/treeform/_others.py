"""Conversion from and to meshes of other libraries: trimesh, Open3D, PyVista, VTK, meshio. A
library is imported only when it is needed."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays
from ._arrays import Floats, Ids


def arrays_of(mesh: Any) -> tuple[ArrayLike, ArrayLike]:
    """Vertices and faces of any object that is accepted as a mesh."""
    if isinstance(mesh, (tuple, list)):
        if len(mesh) != 2:
            raise ValueError(f"mesh: expected (vertices, faces), not {len(mesh)} elements")
        return mesh[0], mesh[1]
    if hasattr(mesh, "vertices"):
        for name in ("faces", "triangles"):
            if hasattr(mesh, name):
                return np.asarray(mesh.vertices), np.asarray(getattr(mesh, name))
    if hasattr(mesh, "points"):
        if hasattr(mesh, "cells_dict"):
            return np.asarray(mesh.points), _faces_of_cells(mesh.cells_dict)
        if hasattr(mesh, "faces"):
            return np.asarray(mesh.points), np.asarray(mesh.faces)
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):
        return _numbers_of(mesh.vertex["positions"]), _numbers_of(mesh.triangle["indices"])
    if hasattr(mesh, "GetPolys"):
        return _arrays_of_vtk(mesh)
    hint = ": read the file by treeform.read" if isinstance(mesh, str) else (
        ": pass a list of its values" if isinstance(mesh, dict) else
        ": pass its `parts`" if type(mesh).__name__ == "Packing" else
        ": a mesh is (vertices, faces)" if hasattr(mesh, "dtype") else "")
    raise ValueError(f"mesh: {type(mesh).__name__} has no vertices and faces{hint}")


#: Kinds of cells, by their names in meshio and their numbers in VTK.
_NO_FACES = ("vertex", "line", 1, 3)
_TRIANGLES = ("triangle", 5)
_QUADS = ("quad", 9)


def _faces_of_cells(cells: Any) -> NDArray[Any]:
    """Triangles, and two triangles for each quad, in the order of `cells`."""
    faces = [np.empty((0, 3), np.uint32)]
    for kind, corners in cells.items():
        if kind in _TRIANGLES:
            faces.append(np.asarray(corners))
        elif kind in _QUADS:
            faces.append(np.asarray(corners)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3))
        elif kind not in _NO_FACES and len(corners):
            raise ValueError(f"mesh: {len(corners)} cells of the kind {kind!r}, but only triangles "
                             "and quads are supported")
    return np.concatenate([_arrays.faces(part) for part in faces])


def _numbers_of(tensor: Any) -> NDArray[Any]:
    """The array of an Open3D tensor, which may be in the memory of a graphics card."""
    return np.asarray(tensor.cpu().numpy())


def _arrays_of_vtk(mesh: Any) -> tuple[Floats, Ids]:
    """Vertices and faces of a vtkPolyData."""
    if mesh.GetStrips() is not None and mesh.GetStrips().GetNumberOfCells():
        raise ValueError("mesh: triangle strips are not supported: use vtkTriangleFilter first")
    numbers = importlib.import_module("vtkmodules.util.numpy_support").vtk_to_numpy
    points = mesh.GetPoints()
    vertices = np.empty((0, 3)) if points is None else numbers(points.GetData())
    if not mesh.GetPolys().GetNumberOfCells():
        return vertices, np.empty((0, 3), np.uint32)
    begin = numbers(mesh.GetPolys().GetOffsetsArray())
    corners = _arrays.ids(numbers(mesh.GetPolys().GetConnectivityArray()), "faces")
    return vertices, _arrays.triangles_of(corners, begin[:-1], np.diff(begin), "faces")


def _copies(mesh: Any) -> tuple[Floats, Any]:
    """Copies of vertices and faces, the latter as int64; None instead of faces for a cloud."""
    vertices, faces = mesh
    is_cloud = len(faces) == 0 and len(vertices) != 0
    return vertices.copy(), None if is_cloud else faces.astype(np.int64)


def to_trimesh(mesh: Any) -> Any:
    """A `trimesh.Trimesh` with copies of the arrays; a cloud becomes a `trimesh.PointCloud`.
    Requires trimesh to be installed."""
    vertices, faces = _copies(mesh)
    trimesh = importlib.import_module("trimesh")
    if faces is None:
        return trimesh.PointCloud(vertices)
    return trimesh.Trimesh(vertices=vertices, faces=faces, process=False)


def to_open3d(mesh: Any, *, tensor: bool = False) -> Any:
    """An `open3d.geometry.TriangleMesh` or PointCloud; with `tensor`, of `open3d.t.geometry`."""
    vertices, faces = _copies(mesh)
    open3d = importlib.import_module("open3d")
    if tensor:
        geometry, points = open3d.t.geometry, open3d.core.Tensor(vertices)
        corners = None if faces is None else open3d.core.Tensor(faces)
    else:
        geometry, points = open3d.geometry, open3d.utility.Vector3dVector(vertices)
        corners = None if faces is None else open3d.utility.Vector3iVector(faces.astype(np.int32))
    return geometry.PointCloud(points) if faces is None else geometry.TriangleMesh(points, corners)


def to_pyvista(mesh: Any) -> Any:
    """A `pyvista.PolyData`."""
    vertices, faces = _copies(mesh)
    pyvista = importlib.import_module("pyvista")
    if faces is None:
        return pyvista.PolyData(vertices)
    return pyvista.PolyData(vertices, np.insert(faces, 0, 3, axis=1).ravel())


def to_vtk(mesh: Any) -> Any:
    """A `vtkPolyData`."""
    vertices, faces = _copies(mesh)
    core = importlib.import_module("vtkmodules.vtkCommonCore")
    model = importlib.import_module("vtkmodules.vtkCommonDataModel")
    support = importlib.import_module("vtkmodules.util.numpy_support")
    points = core.vtkPoints()
    points.SetData(support.numpy_to_vtk(vertices, deep=True))
    corners = np.arange(len(vertices))[:, None] if faces is None else faces
    begin = np.arange(len(corners) + 1, dtype=np.int64) * corners.shape[1]
    cells = model.vtkCellArray()
    cells.SetData(support.numpy_to_vtkIdTypeArray(begin, deep=True),
                  support.numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    made = model.vtkPolyData()
    made.SetPoints(points)
    (made.SetVerts if faces is None else made.SetPolys)(cells)
    return made


def to_meshio(mesh: Any) -> Any:
    """A `meshio.Mesh`."""
    vertices, faces = _copies(mesh)
    cells = [("vertex", np.arange(len(vertices))[:, None]) if faces is None else
             ("triangle", faces)]
    return importlib.import_module("meshio").Mesh(vertices, cells)
