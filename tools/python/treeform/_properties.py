"""Properties and defects of meshes."""

from __future__ import annotations

# made of uses:
from dataclasses import dataclass

from . import _arrays, _core
from ._arrays import Floats, Ids
from ._errors import options
from ._mesh import MeshLike, held
from ._progress import Progress
from ._results import Result

__all__ = ["Feature", "InvalidFaces", "SolidDefects", "Topology", "count_inside_out",
           "count_topology", "face_components", "find_features", "find_invalid_faces",
           "find_solid_defects"]
# end


# made of headers:
#   SolidDefects find_solid_defects InvalidFaces find_invalid_faces Topology count_topology
#   count_inside_out face_components Feature find_features
@dataclass(frozen=True, repr=False)
class SolidDefects(Result):
    """The defects that keep a mesh from being a solid. True if there are any.

    nonfinite_vertices: With a NaN or infinite coordinate, used or not.
    unusable_faces: With an invalid corner; ignored by the counts below.
    without_faces: The mesh has points, but no usable face.
    tetrahedra: Tetrahedra whose sides are faces, as in a volume mesh.
    degenerate: Faces without area.
    repeated: Faces with the same corners as another.
    nonmanifold_edges: Edges of more than two faces.
    misoriented_edges: Edges of two inconsistently oriented faces.
    nonmanifold_vertices: With more than one fan of faces.
    meeting_pairs: Pairs of faces that meet beyond common corners.
    inverted: Closed components that are inside out, without being inside another.
    wrongly_nested: Disjoint closed components are nested, but not as a solid and its cavities.
    message: The defects in words, such as 'open at 37 edges, 2 pairs of faces meet', or 'no
        defects'.
    boundary_edges: Edges of one face.
    """

    nonfinite_vertices: int
    unusable_faces: int
    without_faces: bool
    tetrahedra: int
    degenerate: int
    repeated: int
    nonmanifold_edges: int
    misoriented_edges: int
    nonmanifold_vertices: int
    meeting_pairs: int
    inverted: int
    wrongly_nested: bool
    message: str
    boundary_edges: int

    def __bool__(self) -> bool:
        return self.message != "no defects"


def find_solid_defects(mesh: MeshLike, *, progress: Progress = None) -> SolidDefects:
    """The defects that `repair` would mend or refuse. A mesh without points is a solid.

    Raises ValueError as `self_intersections`, except that invalid corners are counted.

    Cost: O(V log V + F log F), plus `self_intersections`.

    >>> import treeform
    >>> bool(treeform.find_solid_defects(treeform.read("data/cube.stl")))
    False
    >>> treeform.find_solid_defects(treeform.read("data/two_spheres.stl")).meeting_pairs
    78
    >>> treeform.find_solid_defects(([[0, 0, float("nan")]], [])).message
    '1 vertex that is not finite, there are points, but no faces'
    """
    return _core.find_solid_defects(held(mesh), progress=progress)


@dataclass(frozen=True, repr=False)
class InvalidFaces(Result):
    """Faces and points that are invalid, or have no area, ascending. A face is in at most one list.

    nonfinite_points: (n,) with a NaN or infinite coordinate.
    nonfinite_faces: (n,) with a corner that is not finite.
    degenerate_faces: (n,) finite, with exactly collinear corners.
    out_of_range_faces: (n,) with a corner out of range.
    """

    nonfinite_points: Ids
    nonfinite_faces: Ids
    degenerate_faces: Ids
    out_of_range_faces: Ids


def find_invalid_faces(mesh: MeshLike, *, progress: Progress = None) -> InvalidFaces:
    """Finds faces and points that most operations refuse or ignore. Other defects, such as open
    edges: `find_solid_defects`.

    Collinearity is exact: a face with a repeated corner or two equal corners is degenerate, a
    sliver is not, however thin. A face is first tested for corners out of range, then for corners
    that are not finite.

    Raises ValueError for more than 2^32 - 1 points or faces.

    Cost: O(V + F) time; memory for the result.

    >>> import treeform
    >>> mesh = ([[0, 0, 0], [1, 1, 1], [3, 3, 3], [0, float("nan"), 0]], [[0, 1, 2], [0, 1, 3]])
    >>> found = treeform.find_invalid_faces(mesh)
    >>> found.nonfinite_points.tolist(), found.degenerate_faces.tolist()
    ([3], [0])
    """
    return _core.find_invalid_faces(held(mesh), progress=progress)


@dataclass(frozen=True, repr=False)
class Topology(Result):
    """Counts over the faces with three different corner numbers. Faces that repeat a corner have no
    edges here and are counted separately. Faces with collinear corners, and duplicates, are counted
    like all others. The Euler characteristic is points_used - edges + faces.

    edges: Undirected.
    boundary_edges: Used by one face.
    nonmanifold_edges: Used by three or more faces.
    misoriented_edges: Used by two faces in the same direction.
    nonmanifold_points: Points with more than one fan of faces.
    components_by_point: Faces linked by a shared corner.
    components_by_edge: Faces linked by a shared edge.
    points_used: Points that are a corner of a counted face.
    faces: Faces with three different corners.
    repeated_corner_faces: Faces that repeat a corner.
    duplicate_faces: Faces with the same three corners as an earlier one.
    closed_manifold: Whether there are faces, and every edge has exactly two. Orientation and fans
        of points do not matter.
    """

    edges: int
    boundary_edges: int
    nonmanifold_edges: int
    misoriented_edges: int
    nonmanifold_points: int
    components_by_point: int
    components_by_edge: int
    points_used: int
    faces: int
    repeated_corner_faces: int
    duplicate_faces: int
    closed_manifold: bool


def count_topology(mesh: MeshLike, *, progress: Progress = None) -> Topology:
    """Counts edges, components and defects of a mesh. Only corner numbers matter, so corners with
    equal coordinates should be joined first (`join_equal_points`).

    A fan of a point is a set of its faces that are linked by edges at that point, even by edges of
    three or more faces. Fans and components do not depend on the orientation of faces.

    Raises ValueError naming the lowest face with a corner that is not less than the number of
    vertices, or for more than 2^32 - 1 faces.

    Cost: O(V + F log d) time for at most d faces at a point, about 16 bytes a face and 8 a point.

    >>> import treeform
    >>> counts = treeform.count_topology(treeform.read("data/cube.stl"))
    >>> counts.closed_manifold, counts.points_used - counts.edges + counts.faces
    (True, 2)
    """
    return _core.count_topology(held(mesh), progress=progress)


def count_inside_out(mesh: MeshLike, *, progress: Progress = None) -> int:
    """The number of components of a closed mesh that are inside out (of negative volume) without
    being cavities, that is, inside no other component. Components are faces linked by edges, with
    corners of equal coordinates joined. 0 for an open mesh and for a cloud. `measure`, `clash` and
    `locate` treat such a component as the solid that it bounds; `repair` flips it.

    Raises ValueError naming the lowest face with a corner out of range or not finite.

    Cost: O(F log F) for the indexes, which a `Mesh` keeps; a ray for each component, if there are
    several.

    >>> import treeform
    >>> cube = treeform.read("data/cube.stl")
    >>> treeform.count_inside_out(treeform.Mesh(cube.vertices, cube.faces[:, ::-1]))
    1
    """
    return _core.count_inside_out(held(mesh), progress=progress)


def face_components(mesh: MeshLike, *, progress: Progress = None) -> Ids:
    """(F,) the component of each face; components are numbered in the order of their lowest face.
    Faces that share a corner are in one component, even faces that repeat a corner.

    Raises ValueError as `count_topology`.

    Cost: O(V + F) time, up to an inverse Ackermann factor; about 8 bytes a point.

    >>> import treeform
    >>> treeform.face_components(treeform.read("data/two_spheres.stl")).max()
    1
    """
    return _core.face_components(held(mesh), progress=progress)


@dataclass(frozen=True, repr=False)
class Feature(Result):
    """A plane or an axis, fitted to faces by least squares.

    kind: 'plane' or 'axis'.
    origin: (3,) center of the faces, on the plane or the axis.
    direction: (3,) of length 1: the outward normal of a plane; along an axis, in either sense.
    radius: Of the cylinder; 0 for a plane.
    hollow: For a cylinder: the faces point toward the axis, as in a hole.
    area: Total area of the faces.
    deviation: Largest distance of a corner from the plane or cylinder.
    faces: (n,) the faces that it was fitted to, ascending.
    """

    kind: str
    origin: Floats
    direction: Floats
    radius: float
    hollow: bool
    area: float
    deviation: float
    faces: Ids


def find_features(mesh: MeshLike, kind: str = "plane", *, tolerance: float | None = None,
                  plane_angle: float = 1.0, facet_angle: float = 46.0, arc: float = 60.0,
                  progress: Progress = None) -> list[Feature]:
    """The flat or cylindrical regions of `mesh`, largest area first. Regions grow across edges,
    each from the largest face (for an axis, the largest pair of faces with an angle between them)
    that is not yet in a region. Join points with equal coordinates first (`join_equal_points`).
    Cones are not found.

    kind: 'plane' for flat regions, 'axis' for cylindrical ones.
    tolerance: Largest distance of a corner from the plane or cylinder. None: 1e-4 of the diagonal.
    plane_angle: In degrees: largest angle between a face and the plane.
    facet_angle: In degrees: largest angle between neighboring faces of a cylinder.
    arc: In degrees: the least arc of a cylinder.

    Raises ValueError naming a point that is not finite or a face with a corner out of range; for
    options that are negative or NaN.

    Cost: O(F log F) if each face is tried for one region only; else more, in proportion.

    >>> import treeform
    >>> [side.area for side in treeform.find_features(treeform.read("data/cube.stl"))]
    [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    """
    how = options(_core.FeatureOptions, locals())
    return _core.find_features(held(mesh), _arrays.word(kind, "kind"), how, progress=progress)
# end
