"""What is known of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

from . import _core
from ._arrays import Floats, Ids
from ._mesh import MeshLike, held
from ._progress import Progress
from ._results import Result


@dataclass(frozen=True, repr=False)
class SolidDefects(Result):
    """What keeps a mesh from being a solid; `bool()` says whether there is anything."""

    #: Tetrahedra that the faces are, as of a volume mesh.
    tetrahedra: int
    #: Faces without area.
    degenerate: int
    #: Faces with the corners of another one.
    repeated: int
    #: Edges of one face.
    open_edges: int
    #: Edges of more than two faces.
    nonmanifold_edges: int
    #: Edges of two faces that disagree.
    misoriented_edges: int
    #: Vertices with more than one fan of faces.
    nonmanifold_vertices: int
    #: Pairs of faces that meet beyond their common corners.
    meeting_pairs: int
    #: Closed components that are inside out, and in no other one.
    inverted: int
    #: Components do not lie in each other as a solid and its cavities do.
    wrongly_nested: bool
    #: 'open at 37 edges, 2 pairs of faces meet'; 'none'.
    message: str

    def __bool__(self) -> bool:
        return self.message != "none"


def find_solid_defects(mesh: MeshLike, *, progress: Progress = None) -> SolidDefects:
    """What `repair` would have to mend. Vertices with equal coordinates are one. Exact.

    >>> import treeform
    >>> bool(treeform.find_solid_defects(treeform.read("data/cube.stl")))
    False
    >>> treeform.find_solid_defects(treeform.read("data/two_spheres.stl")).meeting_pairs
    78
    """
    return SolidDefects(**_core.find_solid_defects(held(mesh), progress=progress))


@dataclass(frozen=True, repr=False)
class MeshDefects(Result):
    """Elements with defects, ascending. A face is in at most one list."""

    #: (n,) vertices with a NaN or infinite coordinate.
    nonfinite_points: Ids
    #: (n,) faces with such a corner.
    nonfinite_faces: Ids
    #: (n,) faces with exactly collinear corners.
    degenerate_faces: Ids
    #: (n,) faces with a corner that is no vertex.
    out_of_range_faces: Ids


def find_defects(mesh: MeshLike, *, progress: Progress = None) -> MeshDefects:
    """Vertices and faces that operations refuse or treat in a special way. Exact.

    >>> import treeform
    >>> mesh = ([[0, 0, 0], [1, 1, 1], [3, 3, 3], [0, float("nan"), 0]], [[0, 1, 2], [0, 1, 3]])
    >>> treeform.find_defects(mesh)
    MeshDefects(nonfinite_points=[3], nonfinite_faces=[1], degenerate_faces=[0], out_of_range_faces=[])
    """
    return MeshDefects(**_core.find_defects(held(mesh), progress=progress))


@dataclass(frozen=True, repr=False)
class Topology(Result):
    """Counts over the faces with three different corners. The Euler characteristic is points_used -
    edges + faces."""

    edges: int
    #: Used by one face.
    boundary_edges: int
    #: Used by three or more.
    nonmanifold_edges: int
    #: Used by two in the same direction.
    misoriented_edges: int
    #: Whose faces fall into more than one fan.
    nonmanifold_points: int
    #: Faces linked by a shared corner.
    components_by_point: int
    #: Faces linked by a shared edge.
    components_by_edge: int
    points_used: int
    #: With three different corners.
    faces: int
    #: The others.
    repeated_corner_faces: int
    #: Beyond the first with the same corners.
    duplicate_faces: int
    #: At least one face, no boundary edge, no non-manifold edge.
    closed: bool


def count_topology(mesh: MeshLike, *, progress: Progress = None) -> Topology:
    """Edges, components and defects, by numbers of vertices; coordinates do not matter.

    >>> import treeform
    >>> counts = treeform.count_topology(treeform.read("data/cube.stl"))
    >>> counts.closed, counts.points_used - counts.edges + counts.faces
    (True, 2)
    """
    return Topology(**_core.count_topology(held(mesh), progress=progress))


def count_inside_out(mesh: MeshLike, *, progress: Progress = None) -> int:
    """The components of a closed mesh that are inside out and in no other one; 0 for an open mesh.
    `clash`, `measure`, `contains` and booleans take them for the solids that they are when turned
    over, as `repair` does.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.count_inside_out(treeform.Mesh(cube.vertices, cube.faces[:, ::-1]))
    1
    """
    return _core.count_inside_out(held(mesh), progress=progress)


def face_components(mesh: MeshLike, *, progress: Progress = None) -> Ids:
    """(F,) the component of each face, numbered in the order of their lowest face. Faces that share
    a vertex are in one.

    >>> import treeform
    >>> treeform.face_components(treeform.read("data/two_spheres.stl")).max()
    1
    """
    return _core.face_components(held(mesh), progress=progress)


@dataclass(frozen=True, repr=False)
class Feature(Result):
    """A plane or an axis, fitted to faces by least squares."""

    #: 'plane' or 'axis'.
    kind: str
    #: (3,) on the plane or the axis: the center of the faces.
    origin: Floats
    #: (3,) of length 1: the normal, outward; along the axis, either way.
    direction: Floats
    #: Of the cylinder.
    radius: float
    #: Of a cylinder: its faces look at the axis, as those of a hole.
    hollow: bool
    #: Of the faces.
    area: float
    #: Largest distance of a corner from the plane or cylinder.
    deviation: float
    #: (n,) ascending.
    faces: Ids


def find_features(mesh: MeshLike, kind: str = "plane", *, tolerance: float | None = None,
                  plane_angle: float = 1.0, facet_angle: float = 46.0,
                  arc: float = 60.0, progress: Progress = None) -> list[Feature]:
    """The flat ('plane') or cylindrical ('axis') regions, largest area first.

    tolerance: largest distance of a corner, a length; None: 1e-4 of the diagonal.
    plane_angle, facet_angle, arc: in degrees; what faces of a plane may lean, the most between
    faces of a cylinder side by side, the least part of a circle that makes an axis.

    >>> import treeform
    >>> [side.area for side in treeform.find_features(treeform.read("data/cube.stl"))]
    [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    """
    return [Feature(**one) for one in
            _core.find_features(held(mesh), kind, tolerance, plane_angle, facet_angle, arc,
                                progress=progress)]
