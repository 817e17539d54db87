"""Exact, fast mesh processing.

Functions take and return NumPy arrays. A mesh is a `Mesh`, a pair (vertices, faces), or a mesh of
trimesh, PyVista, Open3D, VTK or meshio. All decisions are exact for the given coordinates, and
results of operations are verified in the returned coordinates. The lowest of several faces or
points is the one with the lowest number.

>>> import treeform
>>> m = treeform.read("data/two_spheres.stl")
>>> len(treeform.self_intersections(m))
78
"""

from . import _core, _exit

# made of names:
from ._core import Attributes
from ._arrays import NONE
from ._assembly import (ClashResult, ClosestPair, PartClash, PoseClashes, RELATIONS, check_poses,
                        clash, closest_pair, distance, intersects)
from ._booleans import (BooleanResult, boolean, check_operand, clip, difference, intersection,
                        split, symmetric_difference, union)
from ._cuts import (CutPiece, CutPieces, MassProperties, MeshPart, Section, SectionLoop, components,
                    concatenate, cut, cut_along, cut_to_fit, layer_heights, mass_properties,
                    section, submesh, transformed)
from ._errors import (Cancelled, CertificateError, Error, FileError, NotCertifiedError,
                      NotClosedError)
from ._files import Written, file_parts, read, write
from ._from_others import from_meshio, from_open3d, from_pyvista, from_trimesh, from_vtk
from ._intersections import (FacePairs, FilePairs, KINDS, Region, SharedSearch, faces_in_box,
                             intersection_curves, intersection_regions, mesh_intersections,
                             self_intersections, self_intersections_of_file, write_curves)
from ._mesh import Mesh, MeshLike
from ._nearness import (AllRayHits, ClosestPoints, Deviation, RayHits, closest_point, contains,
                        deviation, locate, raycast, raycast_all, raycast_any, signed_distance,
                        winding_number)
from ._placement import (Alignment, Contacts, Depth, Impact, LaidFlat, Measure, PackedPart, Packing,
                         Placement, SearchEffort, align, drop, lay_flat, mate, mate_features,
                         measure, pack, penetration_depth, separate, slide, time_of_impact, turn)
from ._properties import (Feature, InvalidFaces, SolidDefects, Topology, count_inside_out,
                          count_topology, face_components, find_features, find_invalid_faces,
                          find_solid_defects)
from ._repair import (ConvexHull, MadeMesh, RepairResult, convex_hull, find_rounding_defects,
                      join_equal_points, repair, resolve_self_intersections, rounded)
from ._results import Certificate
from ._robots import Joint, Robot, read_urdf
from ._shapes import (Isoline, Isolines, OffsetResult, OrientedBox, SimplifyResult, Thickness,
                      hollow, isolines, offset, oriented_box, simplify, thicken, wall_thickness,
                      wrap)
from ._show import Picture, View, plot, show
from ._threads import thread_count, threads
from ._trees import BoxTree, Neighbors, PointTree
from ._weld import SharedWeld, WeldResult, WeldStreamResult, count_nearly_equal, weld, weld_stream

__all__ = ["Alignment", "AllRayHits", "Attributes", "BooleanResult", "BoxTree", "Cancelled",
           "Certificate", "CertificateError", "ClashResult", "ClosestPair", "ClosestPoints",
           "Contacts", "ConvexHull", "CutPiece", "CutPieces", "Depth", "Deviation", "Error",
           "FacePairs", "Feature", "FileError", "FilePairs", "Impact", "InvalidFaces", "Isoline",
           "Isolines", "Joint", "KINDS", "LaidFlat", "MadeMesh", "MassProperties", "Measure",
           "Mesh", "MeshLike", "MeshPart", "NONE", "Neighbors", "NotCertifiedError",
           "NotClosedError", "OffsetResult", "OrientedBox", "PackedPart", "Packing", "PartClash",
           "Picture", "Placement", "PointTree", "PoseClashes", "RELATIONS", "RayHits", "Region",
           "RepairResult", "Robot", "SearchEffort", "Section", "SectionLoop", "SharedSearch",
           "SharedWeld", "SimplifyResult", "SolidDefects", "Thickness", "Topology", "View",
           "WeldResult", "WeldStreamResult", "Written", "__version__", "align", "boolean",
           "check_operand", "check_poses", "clash", "clip", "closest_pair", "closest_point",
           "components", "concatenate", "contains", "convex_hull", "count_inside_out",
           "count_nearly_equal", "count_topology", "cut", "cut_along", "cut_to_fit", "deviation",
           "difference", "distance", "drop", "face_components", "faces_in_box", "file_parts",
           "find_features", "find_invalid_faces", "find_rounding_defects", "find_solid_defects",
           "from_meshio", "from_open3d", "from_pyvista", "from_trimesh", "from_vtk", "hollow",
           "intersection", "intersection_curves", "intersection_regions", "intersects", "isolines",
           "join_equal_points", "lay_flat", "layer_heights", "locate", "mass_properties", "mate",
           "mate_features", "measure", "mesh_intersections", "offset", "oriented_box", "pack",
           "penetration_depth", "plot", "raycast", "raycast_all", "raycast_any", "read",
           "read_urdf", "repair", "resolve_self_intersections", "rounded", "section",
           "self_intersections", "self_intersections_of_file", "separate", "show",
           "signed_distance", "simplify", "slide", "split", "submesh", "symmetric_difference",
           "thicken", "thread_count", "threads", "time_of_impact", "transformed", "turn", "union",
           "wall_thickness", "weld", "weld_stream", "winding_number", "wrap", "write",
           "write_curves"]
# end

__version__: str = _core.version()
