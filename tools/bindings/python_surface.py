"""The C++ structs that are classes and options in Python, and where they differ. Everything else is
generated from the headers, as described in `python_language.py`."""

from __future__ import annotations

from python_language import Attribute, Result

#: Words of C++ in sentences, and those of Python.
WORDS = {"columns as in `las_header`": "columns are the fields of its records",
         "the dimensions listed at `las_header`": "the fields of their records",
         "each part (`file_parts`)": "each part",
         " (table in `libmesh/attributes/known_columns.cpp`)": "",
         "what it can of `file.attributes`": "what it can of `Attributes`",
         "`mesh_file::": "`Attributes.",
         "`attributes::": "`Attributes.", "`repair_options::": "`",
         "Precision of the coordinates returned. float32 values are stored as doubles.":
             "Precision of the returned coordinates; use 'float32' for STL and GLB.",
         "of the points returned": "Precision of the returned points",
         "above `plane`": "above a plane", "`relation`": "`measure`", "`difference`": "`difference`",
         "`point_count`": "the number of vertices", "a prepared mesh": "a `Mesh`",
         "meshes that are not prepared": "meshes that are not a `Mesh`",
         "Prepared meshes cache tight bounds of their surfaces":
             "A `Mesh` caches tight bounds of its surface",
         "for prepared meshes": "for a `Mesh`",
         "`signed_volume`": "`Mesh.volume`", "`surface_area`": "`Mesh.area`",
         "`boolean_statistics`": "`BooleanResult.statistics`",
         "`points` are moved by it": "Vertices are moved by it",
         "`points` differ from it": "Vertices differ from it",
         "`points` differ from `matrix`": "vertices differ from `matrix`",
         "rounded coordinates in `points`": "rounded coordinates",
         "Several meshes `b` count as one, with faces numbered mesh after mesh.": "",
         "pass prepared meshes": "pass a `Mesh`", "once for a prepared mesh": "once for a `Mesh`",
         "; none if one has no faces": "; None if one has no faces",
         "returns none": "returns None", "so none means": "so None means",
         "`penetration_depth_result`": "`Depth`", "`repair_statistics`": "`RepairResult.statistics`",
         "those of `repair_options`": "those of `steps`",
         "For `self_intersections`: which": "Which",
         "Check the certificate: its status says whether this was possible, and it lists where it "
         "was not.": "If this is not possible, an error is raised; with `check=False`, the "
                     "certificate of the result says why and lists where.",
         "Check the certificate: its status says whether this was possible.":
             "If this is not possible, an error is raised; with `check=False`, the certificate of "
             "the result says why.",
         "counted in `statistics`": "counted in `RepairResult.statistics`",
         "first in `sides`": "first in `LaidFlat.areas`", "first `overhang_sides` sides":
             "32 largest sides",
         "line \"unit ...\" of `obj_info`": "line \"obj_info unit ...\" of a PLY file",
         "bounding_box": "Mesh.bounds", "`written_as`": "`precision`"}

MESSAGE = Attribute("message", "str", "The outcome as a clause for people, without a full stop.",
                    "py::cast(from.message())")
MESH_OF_PLACE = Attribute(
    "mesh", "Mesh",
    "The moved mesh, in the checked coordinates; the unmoved mesh if there is no place.",
    "moved_mesh(std::move(from.points), moving, from.matrix, "
    "from.certificate ? certificate : py::none())")


def column(name: str, annotation: str, doc: str, rows: str, value: str) -> Attribute:
    "An array with one value for each row."
    return Attribute(name, annotation, doc,
                     f"column(from.{rows}, [](const auto& one) {{ return {value}; }})")


RESULTS = [
    # _results
    Result("certificate", "Certificate", "_results", leave="meeting_at",
           doc="The outcome of checking the coordinates of a result with exact predicates. True if "
               "all guarantees of the operation hold.",
           custom={
               "status": [Attribute("status", "str", "'ok', or why the result is not certified.",
                                    "py::cast(word_of(from.status))")],
               "meeting": [column("meeting", "Ids", "(n, 2) the first 100 pairs of faces that "
                                                    "meet.",
                                  "meeting", "one")],
               "open_edges": [
                   Attribute("open_edges", "Floats", "(n, 2, 3) the ends of the first 100 of these "
                             "edges.", "ends_of(from.open_edges)")],
               "open_faces": [
                   column("open_faces", "Ids", "(n, 2) the operand and its face at each of these "
                                               "edges; 2**32 - 1 for the only operand.",
                          "open_faces", "std::array{one.operand, one.index}")],
               "+": [MESSAGE]},
           docs={"boundary_edges": "Number of open edges with an odd number of faces.",
                 "misoriented_edges": "Number of open edges whose faces are inconsistently "
                                      "oriented.",
                 "meeting_count": "Number of pairs of faces that meet where they should not.",
                 "open_count": "Number of edges whose signed face count is not zero.",
                 "size_before": "For status `excessive_loss`: the volume before the operation, or "
                                "the area if there is no solid.",
                 "size_after": "The same after the operation.",
                 "size_is_volume": "Whether these are volumes, not areas."}),
    # _booleans
    Result("boolean_result", "BooleanResult", "_booleans", "MeshResult", context="attributes",
           doc="The surface of a solid, with its certificate. Every function that takes a "
               "mesh also takes a result; `vertices, faces = result.mesh`.",
           leave="face_of_cut_vertex vanished_at",
           docs={"mesh": "Faces are counter-clockwise from outside.",
                 "certificate": "The outcome of checking its coordinates.",
                 "face_source": "(F, 2) for each face, the lowest operand and operand face "
                                "that contain it.",
                 "vertex_source": "(V, 2) the lowest operand, and its vertex, equal to each "
                                  "vertex; `NONE` for new vertices."},
           custom={"volumes": [Attribute(
               "volumes", "tuple[float, float, float, float] | None",
               "With `volumes`: volumes of the first operand, the second, their union and "
               "their intersection.", "volumes_of(from)")],
               "vanished_components": [], "vanished_distance": [],
               "statistics": [Attribute("statistics", "dict[str, Any]",
                                        "Counts of the steps.",
                                        "with(with(counters(from.statistics), "
                                        '"vanished_components", from.vanished_components), '
                                        '"vanished_distance", from.vanished_distance)')]}),
    # _cuts
    Result("section_loop", "SectionLoop", "_cuts", context="whole",
           docs={"closed": "Whether the loop is a closed polygon.",
                 "oriented": "Whether the faces along it are consistently oriented; then the "
                             "inside is to the left, seen from above the plane.",
                             "length": "Length of the polyline."},
           custom={"first_point": [
               Attribute("points", "Floats", "(n, 2) in the plane of the section; the first is not "
                         "repeated.", "part_of(whole.points, from)"),
               Attribute("faces", "Ids", "(n,) the face in which the segment after each point "
                         "begins.", "part_of(whole.faces, from)")],
               "point_count": [],
               "parent": [Attribute("parent", "int | None", "Number of the innermost loop of the "
                                    "layer around this one; None if there is none.",
                                    "parent_of(whole, from)")]}),
    Result("section_result", "Section", "_cuts",
           doc="Sections by parallel planes: layers, in the order of the given heights. Layer i "
               "has the loops `loops(i)`.",
           docs={"axes": "(3, 3) the axes x and y of `points`, and the normal, each of length 1."},
           custom={
               "layers": [
                   column("heights", "Floats", "(K,) heights of the layers.", "layers",
                          "one.height"),
                   column("origins", "Floats", "(K, 3) a point of each plane.", "layers", "one.at"),
                   column("areas", "Floats", "(K,) area of each layer: the area inside a solid.",
                          "layers",
                          "one.area"),
                   column("lengths", "Floats", "(K,) total length of the loops of each layer.",
                          "layers", "one.length"),
                   column("open_counts", "Ids", "(K,) number of open polylines in each layer; 0 "
                          "for a solid.", "layers", "one.open_count")],
               "points": [Attribute("points", "Floats", "(P, 2) points of all loops, one after the "
                                    "other: (x . p, y . p) for p in space.",
                                    "as_array(std::vector(from.points))")],
               "faces": [Attribute("faces", "Ids", "(P,) the face in which the segment after each "
                                   "point begins.", "as_array(std::vector(from.faces))")],
               "loops": [],
               "+": [Attribute("_data", "_core.SectionData", "", "py::cast(std::move(from))")]}),
    Result("cut_piece", "CutPiece", "_cuts", "MadeMesh", context="attributes",
           inherited="mesh certificate"),
    Result("mesh_part", "MeshPart", "_cuts", "MeshResult", context="attributes",
           doc="A subset of the faces of a mesh, with the vertices that they use and their "
               "attributes.",
           docs={"mesh": "The part."}),
    Result("mass_properties", "MassProperties", "_cuts"),
    # _shapes
    Result("offset_result", "OffsetResult", "_shapes", "MadeMesh",
           doc="An offset, hollowed, thickened or wrapped solid.",
           inherited="mesh certificate"),
    Result("simplify_result", "SimplifyResult", "_shapes", "MadeMesh", context="attributes",
           doc="A mesh with fewer faces.", inherited="mesh certificate",
           docs={"fixed_vertices": "Number of vertices that cannot be removed, since they are at "
                                   "nonmanifold edges or vertices."}),
    Result("thickness_result", "Thickness", "_shapes"),
    Result("oriented_box", "OrientedBox", "_shapes"),
    Result("isoline", "Isoline", "_shapes"),
    Result("isolines_result", "Isolines", "_shapes",
           docs={"lines": "The lines; `points_of` returns the points of one."}),
    # _repair
    Result("repair_result", "RepairResult", "_repair", "MadeMesh", context="attributes",
           doc="A repaired mesh.", inherited="mesh certificate",
           docs={"statistics": "Counts of each step's changes. The volume of the input is its `Mesh.volume`."},
           custom={"is_kept": [Attribute(
               "is_kept", "NDArray[np.bool_]", "(faces of the input,) whether a part of each face "
                                               "is left, "
               "also if it was merged with others.",
               'as_python(std::move(from.is_kept)).attr("view")("bool")')],
               "+": [Attribute("message", "str", "What was changed, such as '40 faces flipped, 2 "
                               "holes filled (9 edges)'; empty if nothing was.",
                               "py::cast(from.statistics.message())")]}),
    Result("convex_hull_result", "ConvexHull", "_repair", context="cloud",
           doc="The convex hull of points: triangles, grouped by flat sides.",
           docs={"faces": "(F, 3) triangles, by point numbers, outward."},
           custom={"+": [Attribute("mesh", "Mesh", "The hull as a closed mesh, with only the points "
                                   "that it uses.",
                                   "mesh_object(from.mesh(cloud), py::none(), py::none())")],
                   "sides": [
               column("first_face", "Ids", "(S,) the first face of each flat side; its faces "
                      "are consecutive.", "sides", "one.first_face"),
               column("areas", "Floats", "(S,) the area of each side.", "sides", "one.area"),
               column("normals", "Floats", "(S, 3) the outward normal of each side, of length 1.",
                      "sides", "one.normal")]}),
    # _properties
    Result("solid_defects", "SolidDefects", "_properties", true='self.message != "no defects"',
           doc="The defects that keep a mesh from being a solid. True if there are any.",
           custom={"+": [Attribute("message", "str",
                                   "The defects in words, such as 'open at 37 edges, 2 pairs of "
                                   "faces meet', or 'no defects'.",
                                   "py::cast(from.message())")]}),
    Result("invalid_faces", "InvalidFaces", "_properties"),
    Result("topology_counts", "Topology", "_properties"),
    Result("mesh_feature", "Feature", "_properties", docs={"kind": "'plane' or 'axis'."}),
    # _intersections
    Result("face_pair_result", "FacePairs", "_intersections",
             leave="box_pairs exact_pairs predicates tree_seconds pair_seconds",
             custom={"pairs": [
                 column("pairs", "Ids", "(n, 2) uint32, ascending; for one mesh, the lower face "
                        "first.", "pairs", "std::array{one.a, one.b}"),
                 column("kinds", "NDArray[np.uint8]", "(n,) uint8: the kind of each pair, an "
                                                      "index into "
                        "`KINDS`.", "pairs", "one.kind")],
                 "counts": [Attribute("counts", "dict[str, int]",
                                      "Number of pairs of each kind, listed or not.",
                                      "counts_of<tf::pair_kind>(from.counts)")]}),
    Result("intersection_region", "Region", "_intersections", custom={
        "min": [Attribute("bounds", "Floats", "(2, 3) bounding box of the faces.",
                          "as_python(std::array{from.min, from.max})")], "max": []}),
    Result("file_search_result", "FilePairs", "_intersections", "FacePairs",
           inherited="pairs kinds counts",
           doc="Pairs of faces of a file that meet, as numbers of faces of `mesh`.",
           leave="triangles searched points bounds header finished_tiles started_anew",
           docs={"tiles": "Number of tiles into which space was cut."},
           custom={
               "part": [
                   Attribute("face_in_file", "Ids", "(F,) the number in the file of each face of "
                             "`mesh`.", "faces_in_file(from.part)"),
                   Attribute("mesh", "Mesh", "Only the faces in pairs, in the order of the "
                             "file.", "mesh_object(std::move(from.part.mesh), py::none(), "
                             "py::none())"),
                   Attribute("non_finite", "int", "Number of omitted triangles with a coordinate "
                                                  "that is "
                             "not finite.", "py::cast(from.part.non_finite)")],
               "found": [
                   column("pairs", "", "", "found.pairs", "std::array{one.a, one.b}"),
                   column("kinds", "", "", "found.pairs", "one.kind"),
                   Attribute("counts", "", "", "counts_of<tf::pair_kind>(from.found.counts)")]}),
    # _files
    Result("write_result", "Written", "_files", doc="The result of `write`.",
           names={"written_as": "precision"},
           docs={"format": "'stl-binary', 'ply-ascii', 'obj', ...",
                 "precision": "Precision of the written coordinates: 'float32' or 'float64'."},
           custom={"warnings": [Attribute("warnings", "list[str]", "Remarks about the file.",
                                          "list_of(from.warnings, &tf::io_warning::text)")]}),
    # _robots
    Result("urdf_joint", "Joint", "_robots", "NamedTuple", context="robot",
           leave="origin axis mimics mimic_multiplier mimic_offset", doc="A joint of two links.",
           docs={"name": "Name in the file.",
                 "kind": "'fixed', 'revolute', 'continuous' or 'prismatic'.",
                 "limits": "Least and greatest value, in radians or meters; None without limits."},
           custom={
               **{end: [Attribute(end, "str", f"Name of the {end} link.",
                                  f"py::cast(robot.links[from.{end}])")]
                  for end in ("parent", "child")}}),
    Result("urdf_robot", "Robot", "_robots", context="robot_parts",
           doc="Links and joints, with a mesh for each link that has any.\n\n"
               "`clash(robot.parts, ...)` and `check_poses(robot.parts, robot.poses(values), "
               "ignored=robot.adjacent)` take its parts.",
           docs={"name": "Name in the file.",
                 "approximated": "Cylinders and spheres replaced by triangles, a sentence each.",
                 "skipped": "Geometry that is not read, a sentence each."},
           custom={
               "links": [Attribute("links", "list[str]", "Names of the links, in the order of the"
                                                         " file.",
                                   "as_python(std::vector(from.links))")],
               "joints": [Attribute("joints", "list[Joint]", "Parents before their children.",
                                    "as_python(std::vector(from.joints), from)")],
               "meshes": [
                   Attribute("parts", "list[Mesh]", "One mesh for each link with faces, in the "
                                                    "frame "
                             "of the link.", "meshes_of(std::move(parts))"),
                   Attribute("link_of_part", "Ids", "(N,) the link of each part.",
                             "column(parts, &tf::urdf_mesh::link)"),
                   Attribute("adjacent", "Ids", "(n, 2) pairs of parts connected by a joint, "
                             "directly or through links without a mesh; the lower number first. "
                             "They usually touch, so pass them as `ignored`.",
                             "column(from.adjacent(parts), std::identity{})")],
               "+": [Attribute("_data", "_core.RobotData", "",
                               "py::cast(robot_data(from, parts))")]}),
    # _weld
    Result("weld_result", "WeldResult", "_weld", "MeshResult", context="data",
           doc="A welded mesh or cloud.", leave="attributes",
           docs={"vertex_source": "(m,) the input point whose properties each new point has.",
                 "face_source": "(F,) the input face of each face; empty for a cloud.",
                 "statistics": "Counts of what welding changed."},
           custom={"groups": [Attribute("group_of_point", "Ids",
                                        "(n,) the new number of each point.",
                                        "as_python(std::move(from.groups.group_of_point))")],
                   "mesh": [Attribute("mesh", "Mesh", "The welded mesh; without faces for a "
                                      "cloud.", "mesh_object(std::move(from.mesh), py::none(), "
                                      "with_attributes(data, std::move(from.attributes)))")]}),
    Result("weld_stream_result", "WeldStreamResult", "_weld", doc="The result of `weld_stream`.",
           leave="welded removed label_replaced las_moved mergeable",
           custom={"survey": [
               Attribute("points", "int", "Number of points in the inputs.",
                         "py::cast(from.survey.points)"),
               Attribute("tolerance", "float", "The tolerance as a length.",
                         "py::cast(from.survey.tolerance)"),
               Attribute("non_finite", "int", "Number of points that are not finite; all are kept.",
                         "py::cast(from.survey.non_finite)"),
               Attribute("tiles", "int", "Number of tiles into which space was cut.",
                         "py::cast(from.survey.tiles)"),
               Attribute("continued", "bool", "Whether this run resumed an earlier one.",
                         "py::cast(from.survey.continued)")],
               "+": [
                   Attribute("max_displacement", "float",
                             "Upper bound of the distance that a point "
                             "moved, rounding for LAS included.",
                             "py::cast(from.statistics.max_displacement + from.survey.las_moved)"),
                   Attribute("warnings", "list[str]", "Remarks about the files.",
                             "warnings_of(from)")]},
           docs={"kept": "Number of kept points.", "faces": "For a mesh, number of kept faces.",
                 "triangles": "Number of triangles of these faces.",
                 "statistics": "Counts of what welding changed, as in `WeldResult`."}),
    # _nearness
    Result("deviation_result", "Deviation", "_nearness", leave="winding_numbers",
           doc="Distances of points from a surface, and their statistics.",
           docs={"is_signed": "Whether distances have a sign."},
           custom={
               "histogram": [
                   Attribute("histogram", "NDArray[np.uint64]", "(bins,) number of signed "
                             "distances in intervals of equal length from `lowest` to `highest`.",
                             "as_python(std::move(from.histogram))")]}),
    Result("closest_pair_result", "ClosestPair", "_assembly", "NamedTuple"),
    Result("closest_point_result", "ClosestPoints", "_nearness", "NamedTuple",
           rows="std::optional<tf::{}>",
           doc="The nearest point of a mesh for each query, in the order of trimesh: "
               "`point, distance, face = closest_point(mesh, points)`.",
           docs={"point": "(n, 3) points on the mesh, rounded; NaN if none is within the "
                            "radius.",
                 "distance": "(n,) distances, not squared; infinite if there is no point.",
                 "face": "(n,) uint32 face numbers; 4294967295 if there is no point."}),
    Result("mesh_hit", "RayHits", "_nearness", "NamedTuple", rows="std::optional<tf::{}>",
           leave="coplanar t_end", doc="The first face that each ray hits.",
           docs={"t": "(n,) the point hit is origin + t direction; infinite without a hit.",
                 "face": "(n,) uint32 face numbers; 4294967295 without a hit."},
           custom={"at": [Attribute(
               "at", "NDArray[np.uint8]", "(n,) uint8: the corner (0, 1, 2), edge (3, 4, 5) or "
               "interior (6) of the face that was hit.",
               "column(from, [](const auto& one) { return one ? one->at : "
               "tf::triangle_feature::interior; })")]}),
    # _placement
    Result("placement_contact", "Contacts", "_placement", "NamedTuple", rows="tf::{}",
           doc="Pairs of faces that touch in the final position, or are at the clearance. On the "
               "bed, only the lowest point is listed, once. A tuple of arrays: the number of "
               "contacts is `len(contacts.point)`.",
           docs={"point": "(n, 3) a common point of each pair, rounded.",
                 "normal": "(n, 3) of length 1, from the fixed to the moving mesh; 0 if there "
                            "is none.",
                 "moving": "faces of the moving mesh.",
                 "fixed_face": "faces of the fixed mesh; 4294967295 for the bed."},
           custom={"fixed": [Attribute("fixed", "Ids", "(n,) number of the fixed mesh.",
                                       "column(from, "
                   "[](const auto& one) { return static_cast<std::uint32_t>(one.fixed); })")]}),
    Result("search_effort", "SearchEffort", "_placement", "NamedTuple"),
    Result("relation_result", "Measure", "_placement", leave="face_a face_b", custom={
        f"on_{x}": [
            Attribute(f"on_{x}", "Floats", f"(3,) the nearest point on the surface of `{x}`; a "
                      "common point if they meet.", f"as_python(from.on_{x}.point)"),
            Attribute(f"face_{x}", "int", f"The face of `{x}` that contains `on_{x}`.",
                      f"py::cast(from.on_{x}.face)")] for x in "ab"},
           docs={"relation": "'disjoint', 'touching' or 'penetrating'. Exact."}),
    Result("placement", "Placement", "_placement", "MeshResult", context="moving",
           true="bool(self.certificate)",
           doc="The result of a placement. True if the mesh has a place; else `message` has the "
               "reason.",
           leave="clearance bed below_bed max_travel statistics",
           docs={"outcome": "Why the placement ended where it did: 'contact', 'bed', 'unchanged', "
                        "'moved_apart', "
                        "'nothing_met', 'too_far', 'starts_penetrating', 'starts_too_near', "
                        "'starts_touching', 'starts_below_bed', 'not_representable', "
                        "'too_many_steps', 'out_of_range'.",
                 "certificate": "The outcome of checking the coordinates."},
           custom={
               "points": [MESH_OF_PLACE],
               "contacts": [Attribute(
                   "contacts", "Contacts", "Pairs of faces that touch in the final position, or "
                                           "are at the clearance.",
                   "as_python(std::move(from.contacts))")],
               "+": [Attribute("message", "str", "Why there is no place, as a clause; empty if "
                                                 "there is "
                               "a place.",
                               "py::cast(from.message())")]}),
    Result("impact", "Impact", "_placement", "NamedTuple",
           leave="contact_count pairs_tested predicates",
           doc="The first contact of a moving mesh with another.",
           docs={"outcome": "'nothing_met', 'contact' or 'starts_touching'."},
           custom={"contacts": [
               column("faces", "Ids", "(n, 2) the faces of `a` and `b` that touch at that time.",
                      "contacts", "std::array{one.face_a, one.face_b}"),
               column("points", "Floats", "(n, 3) a common point of each pair, rounded.",
                      "contacts", "one.point")]}),
    Result("penetration_depth_result", "Depth", "_placement", "NamedTuple"),
    Result("laid_flat", "LaidFlat", "_placement", "MeshResult", context="moving",
           leave="bed contact corrected", doc="A mesh on the bed.",
           docs={"certificate": "The outcome of checking the coordinates.",
                 "chosen": "The side that is on the bed, as an index into `areas`."},
           custom={
               "points": [Attribute("mesh", "Mesh", "The mesh on the bed.",
                                    "moved_mesh(std::move(from.points), moving, from.matrix, "
                                    "certificate)")],
               "sides": [column("areas", "Floats", "(S,) areas of the flat sides of the convex "
                                "hull, largest first.", "sides", "one.area"),
                         column("normals", "Floats", "(S, 3) outward normals, before the rotation.",
                                "sides",
                                "one.normal")],
               "+": [MESSAGE]}),
    Result("align_result", "Alignment", "_placement", "MeshResult", context="moving",
           leave="pivot pivot_moved freedoms", true="self.converged",
           doc="The motion that `align` found.",
           docs={"outcome": "'converged', 'out_of_iterations', 'doubtful' or 'nothing_to_align'.",
                 "matrix": "(4, 4) new = M * old, with `start` included.",
                 "converged": "Whether `outcome` is 'converged'."},
           custom={"points": [Attribute("mesh", "Mesh", "The moved mesh; without faces for a "
                                        "cloud.", "moved_mesh(std::move(from.points), moving, "
                                        "from.matrix, py::none())")],
                   "+": [Attribute("undetermined", "int",
                                   "Number of independent motions that the data "
                                   "do not determine, such as a plane sliding on a plane.",
                                   "py::cast(from.undetermined())"), MESSAGE]}),
    Result("packed_part", "PackedPart", "_placement", "NamedTuple", context="moving",
           docs={"plate": "Number of its plate, from 0."},
           custom={"points": [Attribute(
               "mesh", "Mesh", "The moved part; the unmoved part if it is not placed.",
               "moved_mesh(std::move(from.points), moving, from.matrix, py::none())")]}),
    Result("packing", "Packing", "_placement", context="parts",
           leave="pairs_measured bed certificate", true="len(self.not_placed) == 0",
           doc="Filled plates. True if every part was placed.",
           custom={"parts": [Attribute("parts", "list[PackedPart]", "In the order of the input.",
                                       "packed_parts(std::move(from.parts), parts)")],
                   "+": [MESSAGE]}),
    # _assembly
    Result("part_clash", "PartClash", "_assembly", docs={
        "relation": "'penetrating', 'touching' or 'closer_than_clearance'."},
           custom={"regions": [Attribute(
               "regions", "list[tuple[Floats, int, Ids, Ids]]", "Regions where they meet: (box "
               "(2, 3), number of pairs of faces, faces of a, faces of b).", "regions_of(from)")]}),
    Result("pose_result", "PoseClashes", "_assembly", leave="boxes_apart",
           doc="The clashes in each of many poses: n pairs of parts, pose after pose.",
           docs={"clashing": "Number of poses in collision."},
           custom={"in_collision": [Attribute(
               "in_collision", "NDArray[np.bool_]", "(P,) whether, in each pose, a pair penetrates "
               "or is too close; with a clearance, also whether a pair touches.",
               'as_python(std::move(from.in_collision)).attr("view")("bool")')],
               "poses": [
               Attribute("pose", "Ids", "(n,) the number of the pose, ascending.",
                         "column_of_poses(from, [](std::uint32_t pose, const tf::pose_clash&) "
                         "{ return pose; })"),
               *[Attribute(name, annotation, doc, "column_of_poses(from, [](std::uint32_t, const "
                           f"tf::pose_clash& one) {{ return {value}; }})")
                 for name, annotation, doc, value in (
                     ("parts", "Ids", "(n, 2) the two parts, the lower number first.",
                      "std::array{one.a, one.b}"),
                     ("relation", "NDArray[np.uint8]", "(n,) uint8: their relation, an index into "
                      "`RELATIONS`.", "one.relation"),
                     ("distance", "Floats", "(n,) for parts that are closer than the clearance; 0 if "
                      "they touch or penetrate.", "one.distance"))]]}),
    Result("clash_result", "ClashResult", "_assembly", leave="ignored parts_indexed",
           doc="The clashes of all parts of an assembly.",
           custom={"counts": [Attribute("counts", "dict[str, int]",
                                        "Number of tested pairs, by relation.",
                                        "counts_of<tf::mesh_relation>(from.counts)")]}),
]

#: Structs of counters that become dictionaries, and the fields that are left out.
COUNTERS = {"boolean_statistics": "", "repair_statistics": "",
            "weld_statistics": ""}

#: Structs that can be pickled, and the fields that are left out.
STATES = {"io_warning": "", "column": "", "element": "", "named_faces": "", "corner_values": "",
          "attributes": "", "las_record": "", "las_header": "", "value_range": "",
          "mesh_file": "mesh"}

#: Structs of options, and the fields that are left out or passed in another way.
OPTIONS = {
    "cloud_inputs": "format names", "read_options": "", "write_options": "keep_names",
    "boolean_options": "face_groups", "cut_options": "keep_cuts",
    "resolve_options": "removal_rounds", "repair_options": "as_one",
    "offset_options": "drains", "simplify_options": "face_groups corner_groups",
    "feature_options": "", "face_pair_options": "component_of_face between within",
    "file_search_options": "box communicator",
    "weld_options": "label may_merge", "weld_stream_options": "communicator shared "
                                                                     "las_scale las_offset",
    "placement_options": "max_steps close_in normals face_pairs limit vertices",
    "measure_options": "", "impact_options": "limit",
    "lay_flat_options": "overhang_sides", "align_options": "accelerate", "pack_options": "tighten",
    "deviation_options": "", "clash_options": "ignored effort",
}
