"""The C++ structs that are classes and options in Python, and where they differ. Everything else is
generated from the headers, as described in `python_language.py`."""

from __future__ import annotations

from python_language import Attribute, Result

#: Phrases of C++ docstrings, and those of Python.
WORDS = {"columns as `las_header` says": "columns are the fields of its records",
         "what `las_header` says": "what their records hold",
         "each part, as `split_parts` has them": "each part",
         " (`libmesh/attributes/known_columns.cpp` is the table)": "",
         "Of `file.attributes`, each": "Of `Attributes`, each", "`mesh_file::": "`Attributes.",
         "`attributes::": "`Attributes.",
         "Precision of the coordinates returned. float32 values are stored as doubles.":
             "Precision of the returned coordinates; use 'float32' for STL and GLB.",
         "of the points returned": "Precision of the returned points",
         "above `plane`": "above a plane", "`relation`": "`measure`", "`subtract`": "`difference`",
         "`point_count`": "the number of vertices", "a prepared mesh": "a `Mesh`",
         "meshes that are not prepared": "objects other than a `Mesh`",
         "Prepared meshes keep": "A `Mesh` keeps", "Of prepared meshes": "Of a `Mesh`",
         "`unite`": "`union`", "`transform_mesh`": "`transformed`",
         "`find_oriented_box`": "`oriented_box`", "`find_mass_properties`": "`mass_properties`",
         "`signed_volume`": "`Mesh.volume`", "`surface_area`": "`Mesh.area`",
         "`boolean_statistics`": "`BooleanResult.statistics`",
         "bounding_box": "Mesh.bounds", "`written_as`": "`precision`"}

MESSAGE = Attribute("message", "str", "The result in words, without a full stop.",
                    "py::cast(from.message())")
MESH_OF_PLACE = Attribute(
    "mesh", "Mesh",
    "The moved mesh, in checked coordinates; unmoved if no position was found.",
    "moved_mesh(std::move(from.points), moving, from.matrix, "
    "from.certificate ? certificate : py::none())")


def column(name: str, annotation: str, doc: str, rows: str, value: str) -> Attribute:
    "An array with one value for each row."
    return Attribute(name, annotation, doc,
                     f"column(from.{rows}, [](const auto& one) {{ return {value}; }})")


RESULTS = [
    # _results
    Result("certificate", "Certificate", "_results", leave="meeting_at",
           doc="What was verified about the coordinates of a result, with exact predicates. True "
               "if the result has all properties that the operation guarantees.",
           custom={
               "status": [Attribute("status", "str", "'ok', or why the result is not certified.",
                                    "py::cast(word_of(from.status))")],
               "meeting": [column("meeting", "Ids", "(n, 2) the first 100 of these pairs.",
                                  "meeting", "one")],
               "open_edges": [
                   Attribute("open_edges", "Floats", "(n, 2, 3) the ends of the first 100 of these "
                             "edges.", "ends_of(from.open_edges)")],
               "open_faces": [
                   column("open_faces", "Ids", "(n, 2) the operand and the face at each of these "
                                               "edges.",
                          "open_faces", "std::array{one.operand, one.index}")],
               "+": [MESSAGE]},
           docs={"boundary_edges": "Open edges with an odd number of faces.",
                 "misoriented_edges": "Open edges between faces that are oriented inconsistently.",
                 "meeting_count": "Number of pairs of faces that intersect although they should "
                                  "not.",
                 "open_count": "Number of edges where the surface is not closed: the faces on "
                               "both sides do not cancel out.",
                 "size_after": "The volume (or area) after.",
                 "size_is_volume": "Whether these are volumes, not areas."}),
    # _booleans
    Result("boolean_result", "BooleanResult", "_booleans", "MeshResult", context="attributes",
           doc="The surface of a solid, and what was verified about it. A result can be passed to"
               " any function that takes a mesh; `vertices, faces = result.mesh`.",
           leave="face_of_cut_vertex vanished_at",
           docs={"mesh": "Faces are counter-clockwise from outside.",
                 "certificate": "What was verified about the coordinates.",
                 "face_source": "(F, 2) for each face, the operand and the operand's face that "
                                "contains it; the lowest operand if there are several.",
                 "vertex_source": "(V, 2) for each vertex, the operand and the operand's vertex "
                                  "that it comes from; the lowest operand if there are several, "
                                  "`NONE` for new vertices."},
           custom={"volumes": [Attribute(
               "volumes", "tuple[float, float, float, float] | None",
               "If `volumes` was set: the volumes of the first operand, the second, their union "
               "and their intersection.", "volumes_of(from)")],
               "vanished_components": [], "vanished_reach": [],
               "statistics": [Attribute("statistics", "dict[str, Any]",
                                        "Counters of the operation.",
                                        "with(with(counters(from.statistics), "
                                        '"vanished_components", from.vanished_components), '
                                        '"vanished_reach", from.vanished_reach)')]}),
    # _cuts
    Result("section_loop", "SectionLoop", "_cuts", context="whole",
           docs={"closed": "Whether the loop is a closed polygon.",
                 "oriented": "Whether the faces along it are oriented consistently: the inside is"
                             " to the left, seen from above the plane.",
                 "length": "Sum of the lengths of its sides."},
           custom={"first_point": [
               Attribute("points", "Floats", "(n, 2) in the plane of the section; the first point"
                                             " is not repeated at the end.",
                         "part_of(whole.points, from)"),
               Attribute("faces", "Ids", "(n,) for each point, the face that contains the side to"
                                         " the next point.",
                         "part_of(whole.faces, from)")],
               "point_count": [],
               "parent": [Attribute("parent", "int | None", "The number of the innermost loop of "
                                                            "the layer that encloses it, or None.",
                                    "parent_of(whole, from)")]}),
    Result("section_result", "Section", "_cuts",
           doc="Sections by parallel planes: one layer for each height, in the given order. "
               "`loops(i)` returns the loops of layer i.",
           docs={"axes": "(3, 3) the x and y axes of `points` and the normal of the plane, each "
                         "of length 1."},
           custom={
               "layers": [
                   column("heights", "Floats", "(K,) the height of each layer.", "layers",
                          "one.height"),
                   column("origins", "Floats", "(K, 3) a point on each plane.", "layers", "one.at"),
                   column("areas", "Floats", "(K,) the area inside the loops of each layer; "
                                             "meaningful for solids.", "layers",
                          "one.area"),
                   column("lengths", "Floats", "(K,) the total length of the loops of each layer.",
                          "layers", "one.length"),
                   column("open_counts", "Ids", "(K,) the number of open polylines of each layer;"
                                                " 0 for a solid.", "layers", "one.open_count")],
               "points": [Attribute("points", "Floats", "(P, 2) the points of all loops, one loop"
                                                        " after the other: (x . p, y . p) for a "
                                                        "point p in space.",
                                    "as_array(std::vector(from.points))")],
               "faces": [Attribute("faces", "Ids", "(P,) for each point, the face that contains "
                                                   "the side starting at it.",
                                   "as_array(std::vector(from.faces))")],
               "loops": [],
               "+": [Attribute("_data", "_core.SectionData", "", "py::cast(std::move(from))")]}),
    Result("cut_piece", "CutPiece", "_cuts", "MadeMesh", context="attributes",
           inherited="mesh certificate"),
    Result("mesh_part", "MeshPart", "_cuts", "MeshResult", context="attributes",
           doc="Some faces of a mesh as a mesh of their own, with their vertices and attributes.",
           docs={"mesh": "The part."}),
    Result("mass_properties", "MassProperties", "_cuts"),
    # _shapes
    Result("offset_result", "OffsetResult", "_shapes", "MadeMesh",
           doc="The result of `offset`, `hollow`, `thicken` or `wrap`.",
           inherited="mesh certificate"),
    Result("simplify_result", "SimplifyResult", "_shapes", "MadeMesh", context="attributes",
           doc="A mesh with fewer faces.", inherited="mesh certificate"),
    Result("thickness_result", "Thickness", "_shapes"),
    Result("oriented_box", "OrientedBox", "_shapes"),
    Result("isoline", "Isoline", "_shapes"),
    Result("isolines_result", "Isolines", "_shapes"),
    # _repair
    Result("repair_result", "RepairResult", "_repair", "MadeMesh", context="attributes",
           doc="A repaired mesh.", inherited="mesh certificate", names={"statistics": "steps"},
           docs={"steps": "Counters of each step: faces flipped, holes filled, ..."},
           custom={"is_left": [Attribute(
               "is_left", "NDArray[np.bool_]", "(F,) for each input face, whether any part of it "
                                               "is in the result, possibly merged with other "
                                               "faces.",
               'as_python(std::move(from.is_left)).attr("view")("bool")')]}),
    Result("convex_hull_result", "ConvexHull", "_repair",
           doc="The convex hull of points: triangles, grouped into planar sides.",
           docs={"faces": "(F, 3) the numbers of the points at the corners of each triangle, "
                          "counter-clockwise from outside."},
           custom={"sides": [
               column("first_face", "Ids", "(S,) the first face of each planar side; the faces of"
                                           " a side are consecutive.", "sides", "one.first_face"),
               column("areas", "Floats", "(S,) the area of each side.", "sides", "one.area"),
               column("normals", "Floats", "(S, 3) the outward normal of each side, of length 1.",
                      "sides", "one.normal")]}),
    # _properties
    Result("solid_defects", "SolidDefects", "_properties", true='self.message != "none"',
           doc="The defects that keep a mesh from being a solid. True if there are any.",
           custom={"+": [Attribute("message", "str",
                                   "The defects in words, such as 'open at 37 edges, 2 pairs of "
                                   "faces meet', or 'none'.",
                                   "py::cast(from.message())")]}),
    Result("mesh_defects", "MeshDefects", "_properties"),
    Result("topology_counts", "Topology", "_properties"),
    Result("mesh_feature", "Feature", "_properties"),
    # _intersections
    Result("intersection_result", "FacePairs", "_intersections",
             leave="box_pairs exact_pairs predicates tree_seconds pair_seconds",
             custom={"pairs": [
                 column("pairs", "Ids", "(n, 2) uint32, ascending; for a single mesh, the lower "
                                        "face number first.", "pairs", "std::array{one.a, one.b}"),
                 column("kinds", "NDArray[np.uint8]", "(n,) uint8 the kind of each pair, an index"
                                                      " into `KINDS`.", "pairs", "one.kind")],
                 "counts": [Attribute("counts", "dict[str, int]",
                                      "The number of pairs of each kind, including those not "
                                      "listed.",
                                      "counts_of<tf::pair_kind>(from.counts)")]}),
    Result("intersection_region", "Region", "_intersections", custom={
        "min": [Attribute("bounds", "Floats", "(2, 3) the bounding box of the pairs.",
                          "as_python(std::array{from.min, from.max})")], "max": []}),
    Result("stream_search_result", "FilePairs", "_intersections", "FacePairs",
           inherited="pairs kinds counts",
           doc="Pairs of intersecting faces of a file, as face numbers of `mesh`.",
           leave="triangles searched points bounds header finished_tiles started_anew",
           docs={"tiles": "Number of tiles that space was divided into."},
           custom={
               "part": [
                   Attribute("face_in_file", "Ids", "(F,) for each face of `mesh`, its number in "
                                                    "the file.", "faces_in_file(from.part)"),
                   Attribute("mesh", "Mesh", "Only the intersecting faces, in the order of the "
                                             "file.",
                             "mesh_object(std::move(from.part.mesh), py::none(), "
                             "py::none())"),
                   Attribute("non_finite", "int", "Number of triangles skipped because a coordinate "
                                               "is not finite.", "py::cast(from.part.non_finite)")],
               "found": [
                   column("pairs", "", "", "found.pairs", "std::array{one.a, one.b}"),
                   column("kinds", "", "", "found.pairs", "one.kind"),
                   Attribute("counts", "", "", "counts_of<tf::pair_kind>(from.found.counts)")]}),
    # _files
    Result("write_result", "Written", "_files", doc="What `write` wrote.",
           names={"written_as": "precision"},
           docs={"format": "'stl-binary', 'ply-ascii', 'obj', ...",
                 "precision": "Precision of the written coordinates: 'float32' or 'float64'."},
           custom={"warnings": [Attribute("warnings", "list[str]", "Warnings for the user.",
                                          "list_of(from.warnings, &tf::io_warning::text)")]}),
    # _robots
    Result("urdf_joint", "Joint", "_robots", "NamedTuple", context="robot",
           leave="origin axis mimics mimic_line", doc="A joint, which connects two links.",
           docs={"name": "As in the file.",
                 "kind": "'fixed', 'revolute', 'continuous' or 'prismatic'.",
                 "limits": "Lowest and highest value, in radians or meters; None if unlimited."},
           custom={
               **{end: [Attribute(end, "str", f"Name of the {end} link.",
                                  f"py::cast(robot.links[from.{end}])")]
                  for end in ("parent", "child")}}),
    Result("urdf_robot", "Robot", "_robots", context="robot_parts",
           doc="The links and joints of a robot, with a mesh for each link that has geometry.\n\n"
               "Check it with `clash(robot.parts, ...)` or `check_poses(robot.parts, "
               "robot.poses(values), ignored=robot.adjacent)`.",
           docs={"name": "As in the file.",
                 "approximated": "The cylinders and spheres that were approximated by triangles, "
                                 "a sentence each.",
                 "skipped": "Other geometry that is not a mesh and was skipped, a sentence each."},
           custom={
               "links": [Attribute("links", "list[str]", "Names of the links, in the order of the"
                                                         " file.",
                                   "as_python(std::vector(from.links))")],
               "joints": [Attribute("joints", "list[Joint]", "The joints, parents before their "
                                                             "children.",
                                    "as_python(std::vector(from.joints), from)")],
               "meshes": [
                   Attribute("parts", "list[Mesh]", "One mesh for each link that has geometry, in"
                                                    " the frame of the link.",
                             "meshes_of(std::move(parts))"),
                   Attribute("link_of_part", "Ids", "(N,) the link of each part.",
                             "column(parts, &tf::urdf_mesh::link)"),
                   Attribute("adjacent", "Ids", "(n, 2) parts that are connected by a joint, the "
                                                "lower number first. These always touch.",
                             "column(from.adjacent(parts), std::identity{})")],
               "+": [Attribute("_data", "_core.RobotData", "",
                               "py::cast(robot_data(from, parts))")]}),
    # _weld
    Result("weld_result", "WeldResult", "_weld", "MeshResult", context="data",
           doc="A welded mesh or cloud.", leave="attributes",
           names={"point_of_group": "source", "face_of_new": "face_source"},
           docs={"source": "(m,) for each point of the result, the input point that its "
                           "properties come from.",
                 "face_source": "(F,) for each face of the result, its number in the input; empty"
                                " for a cloud.",
                 "statistics": "Counters of the operation."},
           custom={"groups": [Attribute("index", "Ids", "(n,) for each input point, its number in"
                                                        " the result.",
                                        "as_python(std::move(from.groups.group_of_point))")],
                   "mesh": [Attribute("mesh", "Mesh", "The welded mesh; without faces for a "
                                                      "cloud.",
                                      "mesh_object(std::move(from.mesh), py::none(), "
                                      "with_attributes(data, std::move(from.attributes)))")]}),
    Result("weld_stream_result", "WeldStreamResult", "_weld", doc="The result of `weld_stream`.",
           leave="welded removed label_replaced las_moved mergeable",
           custom={"survey": [
               Attribute("points", "int", "Number of input points.",
                         "py::cast(from.survey.points)"),
               Attribute("tolerance", "float", "The tolerance as a length.",
                         "py::cast(from.survey.tolerance)"),
               Attribute("non_finite", "int", "Number of points that are not finite; all are "
                                              "kept.",
                         "py::cast(from.survey.non_finite)"),
               Attribute("tiles", "int", "Number of tiles that space was divided into.",
                         "py::cast(from.survey.tiles)"),
               Attribute("continued", "bool", "Whether the run resumed an earlier one.",
                         "py::cast(from.survey.continued)")],
               "+": [
                   Attribute("max_displacement", "float", "Upper bound of how far points moved, "
                                                          "including rounding to the resolution "
                                                          "of LAS.",
                             "py::cast(from.statistics.max_displacement + from.survey.las_moved)"),
                   Attribute("warnings", "list[str]", "Warnings for the user.",
                             "warnings_of(from)")]},
           docs={"kept": "Number of points in the output.",
                 "faces": "For a mesh, the number of faces in the output.",
                 "triangles": "The same, with polygons cut into triangles.",
                 "statistics": "Counters of the operation, as in `WeldResult`."}),
    # _nearness
    Result("deviation_result", "Deviation", "_nearness", leave="winding_numbers",
           doc="Distances of points from a surface.",
           docs={"is_signed": "Whether the distances are signed."},
           custom={
               "histogram": [
                   Attribute("histogram", "NDArray[np.uint64]", "(bins,) the number of signed "
                                                                "distances in each of `bins` "
                                                                "intervals of equal length from "
                                                                "`lowest` to `highest`.",
                             "as_python(std::move(from.histogram))")]}),
    Result("closest_points_result", "NearestPoints", "_assembly", "NamedTuple"),
    Result("closest_point_result", "ClosestPoints", "_nearness", "NamedTuple",
           rows="std::optional<tf::{}>", names={"point": "closest", "face": "triangle_id"},
           doc="The nearest point on a mesh for each query, in the order of trimesh: `closest, "
               "distance, triangle_id = closest_point(mesh, points)`.",
           docs={"closest": "(n, 3) points on the mesh, rounded; NaN if there is none within the "
                            "radius.",
                 "distance": "(n,) distances, not squared; infinite if there is none.",
                 "triangle_id": "(n,) uint32 the face; 4294967295 if there is none."}),
    Result("mesh_hit", "RayHits", "_nearness", "NamedTuple", rows="std::optional<tf::{}>",
           leave="coplanar t_end", doc="The first face that each ray hits.",
           docs={"t": "(n,) the hit is at origin + t * direction; infinite if nothing is hit.",
                 "face": "(n,) uint32 the face; 4294967295 if nothing is hit."},
           custom={"at": [Attribute(
               "at", "NDArray[np.uint8]", "(n,) uint8 where the face is hit: at corner 0, 1 or 2,"
                                          " on edge 3, 4 or 5, or in the interior (6).",
               "column(from, [](const auto& one) { return one ? one->at : "
               "tf::feature::interior; })")]}),
    # _placement
    Result("placement_contact", "Contacts", "_placement", "NamedTuple", rows="tf::{}",
           doc="Pairs of faces that touch in the final position, or are at the clearance.",
           names={"point": "points", "normal": "normals"},
           docs={"normals": "(n, 3) unit normals from the fixed to the moving mesh; 0 if "
                            "undefined.",
                 "moving": "(n,) faces of the moving mesh.",
                 "fixed_face": "(n,) faces of the fixed mesh; 4294967295 for the bed."},
           custom={"fixed": [Attribute("fixed", "Ids", "(n,) the number of the fixed mesh.",
                                       "column(from, "
                   "[](const auto& one) { return static_cast<std::uint32_t>(one.fixed); })")]}),
    Result("search_effort", "SearchEffort", "_placement", "NamedTuple"),
    Result("mesh_measure", "Measure", "_placement", leave="face_a face_b", custom={
        f"on_{x}": [
            Attribute(f"on_{x}", "Floats", f"(3,) the nearest point on the surface of `{x}`; a "
                      "common point if the bodies meet.", f"as_python(from.on_{x}.point)"),
            Attribute(f"face_{x}", "int", f"The face of `{x}` that contains `on_{x}`.",
                      f"py::cast(from.on_{x}.face)")] for x in "ab"},
           docs={"relation": "'separate', 'touching' or 'penetrating'. Exact."}),
    Result("placement", "Placement", "_placement", "MeshResult", context="moving",
           true="bool(self.certificate)",
           doc="The new position of a mesh. True if one was found; otherwise `message` says why "
               "not.",
           leave="clearance bed below_bed max_travel statistics",
           docs={"end": "Why it ended there: 'contact', 'bed', 'unchanged', 'moved_apart', "
                        "'nothing_met', 'too_far', 'starts_penetrating', 'starts_too_near', "
                        "'starts_touching', 'starts_below_bed', 'not_representable', "
                        "'too_many_steps', 'out_of_range'.",
                 "certificate": "What was verified about the coordinates."},
           custom={
               "points": [MESH_OF_PLACE],
               "contacts": [Attribute(
                   "contacts", "Contacts", "Pairs of faces that touch in the final position, or "
                                           "are at the clearance.",
                   "as_python(std::move(from.contacts))")],
               "+": [Attribute("message", "str", "Why no position was found, in words; otherwise "
                                                 "empty.",
                               "py::cast(from.message())")]}),
    Result("impact", "Impact", "_placement", "NamedTuple",
           leave="contact_count pairs_tested predicates",
           doc="The first contact of a moving mesh with another.",
           docs={"end": "'nothing_met', 'contact' or 'starts_touching'."},
           custom={"contacts": [
               column("faces", "Ids", "(n, 2) the faces of `a` and `b` that touch at that time.",
                      "contacts", "std::array{one.face_a, one.face_b}"),
               column("points", "Floats", "(n, 3) a common point of each pair, rounded.",
                      "contacts", "one.point")]}),
    Result("penetration_depth_result", "Depth", "_placement", "NamedTuple"),
    Result("laid_flat", "LaidFlat", "_placement", "MeshResult", context="moving",
           leave="bed contact corrected", doc="A mesh laid flat on the bed.",
           docs={"certificate": "What was verified about the coordinates."},
           custom={
               "points": [Attribute("mesh", "Mesh", "The mesh on the bed.",
                                    "moved_mesh(std::move(from.points), moving, from.matrix, "
                                    "certificate)")],
               "sides": [column("areas", "Floats", "(S,) the areas of the planar sides of the "
                                                   "convex hull, largest first.", "sides",
                                "one.area"),
                         column("normals", "Floats", "(S, 3) the outward normals of these sides, "
                                                     "before the rotation.", "sides",
                                "one.normal")],
               "+": [MESSAGE]}),
    Result("align_result", "Alignment", "_placement", "MeshResult", context="moving",
           leave="pivot pivot_moved freedoms", true="self.converged",
           doc="The motion found by `align`.",
           docs={"end": "'converged', 'out_of_iterations', 'doubtful' or 'nothing_to_align'."},
           custom={"points": [Attribute("mesh", "Mesh", "The moved mesh; without faces for a "
                                                        "cloud.",
                                        "moved_mesh(std::move(from.points), moving, "
                                        "from.matrix, py::none())")],
                   "+": [Attribute("undetermined", "int", "Number of independent motions that the"
                                                          " data does not determine, such as "
                                                          "sliding a plane along a plane.",
                                   "py::cast(from.undetermined())"), MESSAGE]}),
    Result("packed_part", "PackedPart", "_placement", "NamedTuple", context="moving",
           docs={"plate": "Number of its plate, from 0."},
           custom={"points": [Attribute(
               "mesh", "Mesh", "The part in its position on the plate; unmoved if it is not "
                               "placed.",
               "moved_mesh(std::move(from.points), moving, from.matrix, py::none())")]}),
    Result("packing", "Packing", "_placement", context="parts",
           leave="pairs_measured bed certificate", true="len(self.not_placed) == 0",
           doc="Parts arranged on plates. True if every part was placed.",
           custom={"parts": [Attribute("parts", "list[PackedPart]", "The parts, in the order of "
                                                                    "the input.",
                                       "packed_parts(std::move(from.parts), parts)")],
                   "+": [MESSAGE]}),
    # _assembly
    Result("part_clash", "PartClash", "_assembly", docs={
        "how": "'penetrating', 'touching' or 'closer_than_clearance'."},
           custom={"regions": [Attribute(
               "regions", "list[tuple[Floats, int, Ids, Ids]]", "Where the parts meet: (bounding "
                                                                "box (2, 3), number of pairs of "
                                                                "faces, faces of a, faces of b).",
                                         "regions_of(from)")]}),
    Result("pose_result", "PoseClashes", "_assembly", leave="boxes_apart",
           doc="The pairs of parts that clash or touch in each of many poses: n pairs, pose after"
               " pose.",
           docs={"clashing": "Number of poses in which a pair penetrates or is too close."},
           custom={"poses": [
               Attribute("pose", "Ids", "(n,) the number of the pose, ascending.",
                         "column_of_poses(from, [](std::uint32_t pose, const tf::pose_clash&) "
                         "{ return pose; })"),
               *[Attribute(name, annotation, doc, "column_of_poses(from, [](std::uint32_t, const "
                           f"tf::pose_clash& one) {{ return {value}; }})")
                 for name, annotation, doc, value in (
                     ("parts", "Ids", "(n, 2) the two parts, the lower number first.",
                      "std::array{one.a, one.b}"),
                     ("how", "NDArray[np.uint8]", "(n,) uint8 the relation of the two parts, an "
                                                  "index into `RELATIONS`.", "one.how"),
                     ("distance", "Floats", "(n,) the distance of parts that are closer than the "
                                            "clearance, otherwise 0.", "one.distance"))]]}),
    Result("clash_result", "ClashResult", "_assembly", leave="ignored parts_indexed",
           doc="The relations of all pairs of parts.",
           custom={"counts": [Attribute("counts", "dict[str, int]",
                                        "The number of pairs with each relation.",
                                        "counts_of<tf::mesh_relation>(from.counts)")]}),
]

#: Structs of counters that become dictionaries, and the fields that are left out.
COUNTERS = {"boolean_statistics": "", "repair_statistics": "",
            "weld_statistics": ""}

#: Structs that can be pickled, and the fields that are left out.
STATES = {"io_warning": "", "column": "", "element": "", "part": "", "corner_values": "",
          "attributes": "", "las_record": "", "las_header": "", "value_range": "",
          "mesh_file": "mesh"}

#: Structs of options, and the fields that are left out or passed in another way.
OPTIONS = {
    "cloud_inputs": "format names", "read_options": "", "write_options": "keep_names",
    "boolean_options": "face_groups", "cut_options": "keep_cuts",
    "resolve_options": "removal_rounds", "repair_options": "as_one",
    "offset_options": "", "simplify_options": "face_groups corner_groups",
    "feature_options": "", "intersection_options": "component_of_face between within",
    "stream_search_options": "box communicator",
    "weld_options": "label may_merge", "weld_stream_options": "communicator shared "
                                                                     "las_scale las_offset",
    "placement_options": "max_steps close_in normals face_pairs limit vertices",
    "measure_options": "", "impact_options": "limit",
    "lay_flat_options": "overhang_sides", "align_options": "accelerate", "pack_options": "tighten",
    "deviation_options": "", "clash_options": "ignored effort",
}
