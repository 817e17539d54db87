"""Meshes of trimesh, Open3D, PyVista, VTK and meshio: taken, and made by name. Where a library is
not installed, what stands in for it has the same names."""

import sys
import types

import numpy as np
import pytest

import treeform as tf
from support import CUBE, same_mesh

QUADS = np.array([[0, 1, 2, 3], [3, 2, 1, 0]])
CLOUD = tf.Mesh(CUBE.vertices)


def flat(faces):
    return np.concatenate([[len(face), *face] for face in faces])


class Tensor:
    """As open3d.core.Tensor."""

    def __init__(self, numbers):
        self.numbers = np.asarray(numbers)

    def cpu(self):
        return self

    def numpy(self):
        return self.numbers


class VtkCells:
    def __init__(self):
        self.offsets, self.corners = np.zeros(1, np.int64), np.zeros(0, np.int64)

    def SetData(self, offsets, corners):
        self.offsets, self.corners = offsets, corners

    def GetNumberOfCells(self):
        return len(self.offsets) - 1

    def GetOffsetsArray(self):
        return self.offsets

    def GetConnectivityArray(self):
        return self.corners


class VtkPoints:
    data = None

    def SetData(self, data):
        self.data = data

    def GetData(self):
        return self.data


class VtkPolyData:
    def __init__(self):
        self._points, self.polys, self.verts = None, VtkCells(), VtkCells()
        self.strips = VtkCells()

    def GetPoints(self):
        return self._points

    def SetPoints(self, points):
        self._points = points

    def GetPolys(self):
        return self.polys

    def SetPolys(self, cells):
        self.polys = cells

    def SetVerts(self, cells):
        self.verts = cells

    def GetStrips(self):
        return self.strips


def module(monkeypatch, name, **content):
    one = types.ModuleType(name)
    vars(one).update(content)
    monkeypatch.setitem(sys.modules, name, one)
    return one


def vtk_there(monkeypatch):
    module(monkeypatch, "vtkmodules")
    module(monkeypatch, "vtkmodules.util")
    module(monkeypatch, "vtkmodules.vtkCommonCore", vtkPoints=VtkPoints)
    module(monkeypatch, "vtkmodules.vtkCommonDataModel", vtkCellArray=VtkCells,
           vtkPolyData=VtkPolyData)
    module(monkeypatch, "vtkmodules.util.numpy_support", vtk_to_numpy=np.asarray,
           numpy_to_vtk=lambda a, deep: a.copy(), numpy_to_vtkIdTypeArray=lambda a, deep: a.copy())


def test_polygons_of_three_and_four_corners_are_taken():
    class PolyData:
        points = CUBE.vertices

        def __init__(self, faces):
            self.faces = faces

    assert tf.from_pyvista(PolyData(flat(QUADS))).faces.tolist() == [
        [0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0]]
    mixed = [[4, 5, 6], *QUADS.tolist(), [0, 1, 7]]
    assert tf.from_pyvista(PolyData(flat(mixed))).faces.tolist() == [
        [4, 5, 6], [0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0], [0, 1, 7]]
    # Numbers that could also be of triangles: all are read in their turn.
    assert tf.from_pyvista(PolyData(flat([[3, 0, 1, 2], [5, 6, 7]]))).faces.tolist() == [
        [3, 0, 1], [3, 1, 2], [5, 6, 7]]
    with pytest.raises(ValueError, match="face 1 has 5 corners, but only triangles and quads"):
        tf.from_pyvista(PolyData(flat([[0, 1, 2], [0, 1, 2, 3, 4]])))
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    PolyData.points = corners
    assert tf.union(PolyData(flat(sides))).mesh.volume == 1


def test_trimesh(monkeypatch):
    module(monkeypatch, "trimesh", PointCloud=lambda v: ("cloud", v),
           Trimesh=lambda vertices, faces, process: types.SimpleNamespace(
               vertices=vertices, faces=faces))
    made = CUBE.to_trimesh()
    assert made.vertices.flags.writeable and same_mesh(tf.from_trimesh(made), CUBE)
    assert CLOUD.to_trimesh()[0] == "cloud"


def test_open3d(monkeypatch):
    def legacy(vertices, triangles):
        return types.SimpleNamespace(vertices=vertices, triangles=triangles)

    def tensors(vertices, triangles):
        return types.SimpleNamespace(vertex={"positions": vertices},
                                     triangle={"indices": triangles})

    utility = types.SimpleNamespace(Vector3dVector=np.array, Vector3iVector=np.array)
    module(monkeypatch, "open3d", utility=utility, core=types.SimpleNamespace(Tensor=Tensor),
           geometry=types.SimpleNamespace(TriangleMesh=legacy, PointCloud=lambda p: ("cloud", p)),
           t=types.SimpleNamespace(geometry=types.SimpleNamespace(
               TriangleMesh=tensors,
               PointCloud=lambda p: types.SimpleNamespace(point={"positions": p}))))
    assert CUBE.to_open3d().triangles.dtype == np.int32
    assert CUBE.to_open3d(tensor=True).triangle["indices"].numpy().dtype == np.int64
    for tensor in (False, True):
        assert same_mesh(tf.from_open3d(CUBE.to_open3d(tensor=tensor)), CUBE)
        assert tf.union(CUBE.to_open3d(tensor=tensor)).mesh.volume == 1
    assert CLOUD.to_open3d()[0] == "cloud"
    assert len(tf.weld(CLOUD.to_open3d(tensor=True), 0.1).points) == 8


def test_pyvista(monkeypatch):
    module(monkeypatch, "pyvista", PolyData=lambda points, faces=(): types.SimpleNamespace(
        points=points, faces=faces))
    assert same_mesh(tf.from_pyvista(CUBE.to_pyvista()), CUBE)
    assert CUBE.to_pyvista().faces[:4].tolist() == [3, *CUBE.faces[0].tolist()]
    assert len(CLOUD.to_pyvista().points) == 8


def test_vtk(monkeypatch):
    vtk_there(monkeypatch)
    made = CUBE.to_vtk()
    assert same_mesh(tf.from_vtk(made), CUBE) and tf.check_operand(made)
    made.polys.SetData(np.array([0, 4, 7]), np.array([0, 1, 2, 3, 4, 5, 6]))
    assert tf.from_vtk(made).faces.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6]]
    made.polys.SetData(np.array([0, 5]), np.arange(5))
    with pytest.raises(ValueError, match="face 0 has 5 corners"):
        tf.from_vtk(made)
    made.strips.SetData(np.array([0, 4]), np.arange(4))
    with pytest.raises(ValueError, match="strips"):
        tf.from_vtk(made)
    assert tf.from_vtk(VtkPolyData()).vertices.shape == (0, 3)
    assert CLOUD.to_vtk().verts.GetNumberOfCells() == 8


def test_meshio(monkeypatch):
    module(monkeypatch, "meshio", Mesh=lambda points, cells: types.SimpleNamespace(
        points=points, cells_dict=dict(cells)))
    assert same_mesh(tf.from_meshio(CUBE.to_meshio()), CUBE)
    assert list(CLOUD.to_meshio().cells_dict) == ["vertex"]


# ---- the libraries themselves ----

@pytest.mark.parametrize("tensor", [False, True])
def test_open3d_itself(tensor):
    o3d = pytest.importorskip("open3d")
    assert same_mesh(tf.from_open3d(CUBE.to_open3d(tensor=tensor)), CUBE)
    assert len(tf.weld(CLOUD.to_open3d(tensor=tensor), 0.1).points) == 8
    box = o3d.geometry.TriangleMesh.create_box()
    assert tf.union(box, CUBE.to_open3d(tensor=tensor)).mesh.volume == 1


def test_vtk_itself():
    pytest.importorskip("vtkmodules")
    from vtkmodules.vtkFiltersSources import vtkCubeSource
    assert same_mesh(tf.from_vtk(CUBE.to_vtk()), CUBE)
    assert CLOUD.to_vtk().GetNumberOfVerts() == 8
    source = vtkCubeSource()
    source.Update()
    assert len(tf.from_vtk(source.GetOutput()).faces) == 12  # of quads
    assert tf.find_solid_defects(tf.from_vtk(source.GetOutput())).message == "no defects"


def test_meshio_itself():
    pytest.importorskip("meshio")
    assert same_mesh(tf.from_meshio(CUBE.to_meshio()), CUBE)


def test_pyvista_itself():
    pyvista = pytest.importorskip("pyvista")
    assert same_mesh(tf.from_pyvista(CUBE.to_pyvista()), CUBE)
    assert tf.union(pyvista.Cube()).mesh.volume == 1


def test_trimesh_itself():
    trimesh = pytest.importorskip("trimesh")
    assert same_mesh(tf.from_trimesh(CUBE.to_trimesh()), CUBE)
    assert tf.union(trimesh.creation.box()).mesh.volume == 1
