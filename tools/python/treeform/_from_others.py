"""Meshes of other libraries as a Mesh. All functions that take a mesh also take these, but only a
Mesh keeps its indexes."""

from __future__ import annotations

# made of uses:
from ._mesh import HasCells, HasFaces, HasPolys, HasTensors, HasTriangles, Mesh, as_mesh

__all__ = ["from_meshio", "from_open3d", "from_pyvista", "from_trimesh", "from_vtk"]
# end


# made of headers:
#   from_trimesh from_open3d from_pyvista from_vtk from_meshio
def from_trimesh(mesh: HasFaces) -> Mesh:
    """A Mesh with the arrays of a `trimesh.Trimesh`, or of any other object that is accepted as a
    mesh.

    >>> import treeform
    >>> class Trimesh:
    ...     vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    ...     faces = [[0, 1, 2]]
    >>> treeform.from_trimesh(Trimesh())
    Mesh(3 vertices, 1 faces)
    """
    return as_mesh(mesh)


def from_open3d(mesh: HasTriangles | HasTensors) -> Mesh:
    """A Mesh with the arrays of a TriangleMesh of `open3d.geometry` or `open3d.t.geometry`.

    >>> import treeform
    >>> class TriangleMesh:
    ...     vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    ...     triangles = [[0, 1, 2]]
    >>> treeform.from_open3d(TriangleMesh())
    Mesh(3 vertices, 1 faces)
    """
    return as_mesh(mesh)


def from_pyvista(mesh: HasFaces | HasCells) -> Mesh:
    """A Mesh with the triangles of a `pyvista.PolyData` or grid; each quad is cut into two
    triangles.

    >>> import treeform
    >>> class PolyData:
    ...     points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    ...     faces = [4, 0, 1, 2, 3]
    >>> treeform.from_pyvista(PolyData())
    Mesh(4 vertices, 2 faces)
    """
    return as_mesh(mesh)


def from_vtk(mesh: HasPolys) -> Mesh:
    """A Mesh with the triangles of a `vtkPolyData`; each quad is cut into two triangles.

    >>> import treeform
    >>> def mesh_of(reader):  # a vtkSTLReader
    ...     reader.Update()
    ...     return treeform.from_vtk(reader.GetOutput())
    """
    return as_mesh(mesh)


def from_meshio(mesh: HasCells) -> Mesh:
    """A Mesh with the triangles of a `meshio.Mesh`; each quad is cut into two triangles.

    >>> import treeform
    >>> class Meshio:
    ...     points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    ...     cells_dict = {"quad": [[0, 1, 2, 3]]}
    >>> treeform.from_meshio(Meshio())
    Mesh(4 vertices, 2 faces)
    """
    return as_mesh(mesh)
# end
