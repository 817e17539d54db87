"""Meshes of other libraries as a Mesh. Whatever takes a mesh takes these, too; a Mesh keeps its
indexes."""

from __future__ import annotations

from ._mesh import HasCells, HasFaces, HasPolys, HasTensors, HasTriangles, Mesh, as_mesh

__all__ = ["from_meshio", "from_open3d", "from_pyvista", "from_trimesh", "from_vtk"]


def from_trimesh(mesh: HasFaces) -> Mesh:
    """A Mesh of the arrays of a `trimesh.Trimesh`, or of whatever else is taken for a mesh.

    >>> import treeform
    >>> class Trimesh:
    ...     vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    ...     faces = [[0, 1, 2]]
    >>> treeform.from_trimesh(Trimesh())
    Mesh(3 vertices, 1 faces)
    """
    return as_mesh(mesh)


def from_open3d(mesh: HasTriangles | HasTensors) -> Mesh:
    """A Mesh of a TriangleMesh of `open3d.geometry` or `open3d.t.geometry`.

    >>> import treeform
    >>> class TriangleMesh:
    ...     vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    ...     triangles = [[0, 1, 2]]
    >>> treeform.from_open3d(TriangleMesh())
    Mesh(3 vertices, 1 faces)
    """
    return as_mesh(mesh)


def from_pyvista(mesh: HasFaces | HasCells) -> Mesh:
    """A Mesh of a `pyvista.PolyData` or grid: triangles, and quads, each cut in two.

    >>> import treeform
    >>> class PolyData:
    ...     points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    ...     faces = [4, 0, 1, 2, 3]
    >>> treeform.from_pyvista(PolyData())
    Mesh(4 vertices, 2 faces)
    """
    return as_mesh(mesh)


def from_vtk(mesh: HasPolys) -> Mesh:
    """A Mesh of a `vtkPolyData`: triangles, and quads, each cut in two.

    >>> import treeform
    >>> def mesh_of(reader):  # a vtkSTLReader
    ...     reader.Update()
    ...     return treeform.from_vtk(reader.GetOutput())
    """
    return as_mesh(mesh)


def from_meshio(mesh: HasCells) -> Mesh:
    """A Mesh of a `meshio.Mesh`: triangles, and quads, each cut in two.

    >>> import treeform
    >>> class Meshio:
    ...     points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    ...     cells_dict = {"quad": [[0, 1, 2, 3]]}
    >>> treeform.from_meshio(Meshio())
    Mesh(4 vertices, 2 faces)
    """
    return as_mesh(mesh)
