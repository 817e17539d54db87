"""The C++ structs and enumerations that are in C, and where names differ. Everything else is
generated from the headers, as described in `c_language.py`."""

from __future__ import annotations

from c_language import Bound, List, Member

#: Names of enumerations in C, and the prefix of their constants; "": as in C++, after TREEFORM_.
ENUMS = {
    "precision": ("treeform_precision", ""),
    "vertex_identity": ("treeform_vertex_identity", ""),
    "status": ("treeform_status", "STATUS_"),
    "fill_rule": ("treeform_fill_rule", ""),
    "resolve_mode": ("treeform_resolve_mode", "RESOLVE_"),
    "pair_kind": ("treeform_pair_kind", ""),
    "location": ("treeform_location", ""),
    "mesh_relation": ("treeform_mesh_relation", "RELATION_"),
    "triangle_feature": ("treeform_triangle_feature", "AT_"),
    "feature_kind": ("treeform_feature_kind", ""),
    "placement_outcome": ("treeform_placement_outcome", "OUTCOME_"),
    "urdf_joint_kind": ("int32_t", ""),
    "align_method": ("treeform_align_method", {"automatic": "ALIGN_AUTOMATIC"}),
    "align_outcome": ("treeform_align_outcome", {"converged": "ALIGN_CONVERGED",
                                         "out_of_iterations": "ALIGN_OUT_OF_ITERATIONS",
                                         "doubtful": "ALIGN_DOUBTFUL",
                                         "nothing_to_align": "ALIGN_NOTHING"}),
    "thickness_by": ("treeform_thickness_by", "THICKNESS_BY_"),
    "weld_keep": ("treeform_weld_keep", "KEEP_"),
    "scalar_type": ("treeform_scalar", {"float32": "SCALAR_FLOAT32", "float64": "SCALAR_FLOAT64"}),
}

MESSAGE = Member("const char* message", "the outcome as a clause for people, without a full stop",
                 "to.message = kept.keep(from.message()).c_str();")
FILE = Member("const treeform_file* file", "for a file: the result with its attributes; else null")


BOUND = [
    # base.h
    Bound("operand_element", kind="same"),
    Bound("search_effort", kind="same"),
    Bound("certificate", names={"status": "status"},
          counts={"meeting": "meeting_listed", "meeting_at": "", "open_edges": "open_listed",
                  "open_faces": ""},
          custom={"+": [MESSAGE]}),
    # mesh.h
    Bound("rounding_effects"),
    # properties.h
    Bound("mass_properties", kind="part"),
    Bound("topology_counts"),
    Bound("invalid_faces"),
    Bound("mesh_feature", kind="part"),
    Bound("feature_options"),
    Bound("hull_side", kind="same"),
    # intersections.h
    Bound("face_pair", kind="same"),
    Bound("face_pair_result", counts={"pairs": "count"},
          leave="exact_pairs predicates tree_seconds pair_seconds"),
    Bound("face_pair_options", custom={
        "component_of_face": [Member("const uint32_t* component_of_face",
                                     "[F] for `between` and `within`; or null")]}),
    Bound("intersection_region", kind="part"),
    Bound("curve_path", kind="part", leave="pairs", counts={"points": "count"}),
    Bound("curve_network", custom={"points": [
        Member("const double* points", "[point_count][3]",
               "to.points = positions_of(kept, from.points);"),
        Member("size_t point_count", "", "to.point_count = from.points.size();")]}),
    Bound("file_search_options", leave="step_done"),
    Bound("file_search_result", leave="bounds header started_anew", custom={
        "part": [
            Member("treeform_arrays mesh", "only the intersecting faces",
                   "to.mesh = arrays(from.part.mesh);"),
            Member("const uint32_t* face_in_file", "[F] number of each face in the file",
                   "to.face_in_file = faces_in_file(kept, from.part).data();"),
            Member("uint64_t degenerate", "number of triangles without area",
                   "to.degenerate = from.part.degenerate;"),
            Member("uint64_t non_finite", "number of triangles that are not finite",
                   "to.non_finite = from.part.non_finite;")]}),
    # solids.h
    Bound("boolean_options"),
    Bound("operand_volumes", kind="part"),
    Bound("boolean_result", counts={"vanished_at": "vanished_listed"}),
    Bound("resolve_options"),
    Bound("repair_options"),
    Bound("repair_statistics", kind="part", custom={"+": [Member(
        MESSAGE.decl, "what was changed, in words; empty if nothing was", MESSAGE.fill)]}),
    Bound("repair_result", custom={"+": [FILE]}),
    Bound("repaired_file", "repair_result", leave="file parts"),
    Bound("solid_defects", custom={"+": [
        Member("int32_t any", "whether there is any defect", "to.any = from.any();"), MESSAGE]}),
    # cuts.h
    Bound("section_loop", kind="same"),
    Bound("section_layer", kind="same"),
    Bound("section_result"),
    Bound("cut_options"),
    Bound("cut_piece", kind="part"),
    Bound("cut_result", counts={"pieces": "count"}),
    Bound("mesh_part", kind="part"),
    # shapes.h
    Bound("offset_options", leave="drains"),
    Bound("offset_result"),
    Bound("simplify_options"),
    Bound("simplify_result"),
    Bound("thickness_result"),
    Bound("oriented_box"),
    Bound("isoline", kind="same"),
    Bound("isolines_result"),
    # nearness.h
    Bound("mesh_hit", kind="same"),
    Bound("measure_options"),
    Bound("relation_result", custom={
        f"on_{x}": [
            Member(f"uint32_t nearest_{x}", f"the face of `{x}` that contains `on_{x}`",
                   f"to.nearest_{x} = from.on_{x}.face;"),
            Member(f"double on_{x}[3]", f"the nearest point on the surface of `{x}`",
                   f"copy(from.on_{x}.point, to.on_{x});"),
            Member(f"double barycentric_{x}[3]", f"barycentric coordinates of `on_{x}` in that "
                                                 f"face",
                   f"std::copy(from.on_{x}.barycentric.begin(), from.on_{x}.barycentric.end(), "
                   f"to.barycentric_{x});")] for x in "ab"}),
    Bound("deviation_options", custom={"band": [
        Member("double band_low", "lower end of the tolerance band of signed distances; NaN: no "
                                  "band", "",
               "if (!std::isnan(o.band_low) || !std::isnan(o.band_high))"
               " how.band = {o.band_low, o.band_high};", "to.band_low = not_known;"),
        Member("double band_high", "its upper end", "", "", "to.band_high = not_known;")]}),
    Bound("deviation_result", leave="winding_numbers",
          counts={"distances": "count", "faces": "", "histogram": "bins"}),
    # weld.h
    Bound("weld_condition", kind="part"),
    Bound("weld_options", custom={"may_merge": [
        Member("int (*may_merge)(uint32_t a, uint32_t b, void* data)",
               "whether two points may be merged; or null. Symmetric; called from several threads "
               "at once", "",
               "if (o.may_merge) how.may_merge = [call = o.may_merge, data = o.may_merge_data]("
               "std::uint32_t a, std::uint32_t b) { return call(a, b, data) != 0; };"),
        Member("void* may_merge_data")]}),
    Bound("weld_result", leave="attributes", names={"groups": "merged_groups"},
          counts={"group_of_point": "point_count", "first_of_group": "group_count"},
          custom={"+": [FILE]}),
    Bound("file_weld_result", "weld_result", leave="file", names={"groups": "merged_groups"},
          counts={"group_of_point": "point_count", "first_of_group": "group_count"}),
    # streams.h
    Bound("weld_stream_options", leave="las_scale las_offset shared step_done", custom={"+": [
        Member("const char* format", "format of the inputs; null: by content"),
        Member("const char* removed", "write the dropped points to this file; or null"),
        Member("const char* label", "write all points, with their group in this property; or null"),
        Member("int32_t withhold", 'write all points, with the flag "withheld" of LAS'),
        Member("void (*map)(const uint64_t* numbers, size_t count, void* data)",
               "Called with the new numbers of consecutive input points, from the first point to "
               "the last; or null."),
        Member("void* map_data"),
        Member("const treeform_write_options* write", "how to write the output; or null"),
        Member("const treeform_named_column* columns",
               "[column_count] as in `treeform_read_options`"),
        Member("size_t column_count"),
        Member("int32_t mixed", "join LAS files of different coordinate systems or time types; "
               "the output then has the system and type of the first")]}),
    Bound("weld_stream_result", leave="kept_apart removed label_replaced las_moved", custom={
        "survey": [Member(f"{type} {name}", doc, f"to.{name} = from.survey.{name};")
                   for type, name, doc in (
                       ("uint64_t", "points", ""),
                       ("double", "tolerance", "the tolerance as a length"), ("uint64_t", "tiles",
                                                                              ""),
                       ("uint64_t", "finished_tiles", "tiles finished by an earlier run"))],
        "max_displacement": [Member(
            "double max_displacement", "upper bound of the distance that a point moved",
            "to.max_displacement = from.statistics.max_displacement + from.survey.las_moved;")],
        "welded": [Member("const char* format", "format of the output",
                          'to.format = from.welded ? from.welded->format.c_str() : "";')],
        "mergeable": [
            Member("uint64_t mergeable", "number of points that welding the output again would "
                                         "merge",
                   "to.mergeable = from.mergeable.value_or(0);"),
            Member("int32_t mergeable_known", "",
                   "to.mergeable_known = from.mergeable.has_value();")]}),
    # placement.h
    Bound("placement_options"),
    Bound("placement_contact", kind="part", custom={"fixed": [
        Member("uint32_t fixed", "number of the fixed mesh",
               "to.fixed = static_cast<std::uint32_t>(from.fixed);")]}),
    Bound("placement", leave="max_travel predicates", counts={"contacts": "contact_listed",
                                                                "points": "point_count"}, custom={
        "+": [Member(MESSAGE.decl, f"{MESSAGE.doc}; empty if the placement succeeded",
                     MESSAGE.fill)]}),
    Bound("impact", leave="predicates", counts={"contacts": "contact_listed"}),
    Bound("face_contact", kind="same", custom={"at": [
        Member("uint8_t on_a", "corner, edge or interior of the face "
                              "(a `treeform_triangle_feature`)"),
        Member("uint8_t on_b")]}),
    Bound("impact_options"),
    Bound("lay_flat_options"),
    Bound("laid_flat", leave="contact", counts={"points": "point_count"},
          custom={"+": [MESSAGE]}),
    Bound("pack_options"),
    Bound("packed_part", kind="part", counts={"points": "point_count"}),
    Bound("packing", counts={"parts": "part_count"}, custom={"+": [MESSAGE]}),
    Bound("align_options"),
    Bound("align_freedom", kind="same"),
    Bound("align_result", leave="converged", counts={"points": "point_count"},
          custom={"+": [MESSAGE, Member(
              "size_t undetermined", "number of `freedoms` that the data do not determine",
              "to.undetermined = from.undetermined();")]}),
    # assembly.h
    Bound("clash_options"),
    Bound("contact_region", kind="part",
          counts={"faces_a": "face_count_a", "faces_b": "face_count_b"}),
    Bound("part_clash", kind="part", custom={
        "relation": [Member("treeform_mesh_relation relation", "touching, penetrating or too close",
                            "to.relation = static_cast<treeform_mesh_relation>(from.relation);")],
        "nearest": [
            Member("double on_a[3]",
                   "for parts that are too close: the nearest point on a; else NaN",
                   "copy(from.nearest ? (*from.nearest)[0] : nowhere, to.on_a);"),
            Member("double on_b[3]", "the same on b",
                   "copy(from.nearest ? (*from.nearest)[1] : nowhere, to.on_b);")]}),
    Bound("clash_result", counts={"pairs": "count"}),
    Bound("pose_clash", kind="same"),
    # files.h
    Bound("io_warning", kind="part"),
    Bound("column", kind="part", leave="role", custom={
        "list_length": [
            Member("int32_t is_list", "whether each row has a list of values",
                   "to.is_list = from.list_length.has_value();"),
            Member("int32_t is_stored_elsewhere", "whether the values are stored in the points, "
                                                  "faces or corners of the file, not in `values`",
                   "to.is_stored_elsewhere = from.role != tf::column_role::data;")],
        "values": [Member("const void* values", "[value_count] values of `type`",
                          "to.values = from.values.data();"),
                   Member("size_t value_count", "", "to.value_count = from.size();")],
        "list_begin": [Member("const uint64_t* list_begin",
                              "[rows + 1] first value of each list; else null",
                              "if (from.list_length) to.list_begin = from.list_begin.data();")]}),
    Bound("element", kind="part"),
    Bound("named_faces", kind="part"),
    Bound("mesh_file", "file_view", leave="ranges has_w header", custom={
        "texture": [Member("const double* texture", "[texture_count][3] u, v, w",
                           "to.texture = flat(from.attributes.corners.texture);"),
                    Member("size_t texture_count", "",
                           "to.texture_count = from.attributes.corners.texture.size();")],
        "las": [Member("int32_t is_las", "", "to.is_las = from.las.has_value();"),
                Member("double las_scale[3]", "", "if (from.las) "
                                                  "std::copy(from.las->scale.begin(), "
                       "from.las->scale.end(), to.las_scale);"),
                Member("double las_offset[3]", "", "if (from.las) "
                                                   "std::copy(from.las->offset.begin()"
                       ", from.las->offset.end(), to.las_offset);")]}),
    Bound("read_options", custom={"+": [Member("const char* format", "null: determined by the "
                                                                     "content")]}),
    Bound("write_options", leave="keep_names round"),
    Bound("write_result", "written"),
    Bound("usable_options"),
    Bound("usable_mesh", leave="distinct face_of_triangle", custom={
        "+": [Member("const uint32_t* face_in_file",
                     "[F] number of each face in the file, counting polygons",
                     "to.face_in_file = faces_in_file(kept, from).data();")],
        "triangle_of_face": [Member(
            "const uint32_t* triangle_of_face",
            "[F] number of each face's triangle in the file; null: the same numbers",
            "to.triangle_of_face = or_null(from.triangle_of_face);")],
        "component": [Member("const uint32_t* component",
                             "[F] with `details`: component of each face; else null",
                             "to.component = or_null(from.component);")]}),
    Bound("urdf_joint", kind="part", leave="origin axis mimics mimic_multiplier mimic_offset", custom={
        "kind": [Member("int32_t kind", "0 fixed, 1 revolute, 2 continuous, 3 prismatic",
                        "to.kind = static_cast<int32_t>(from.kind);")],
        "limits": [Member("double lower", "least value; NaN without limits",
                          "to.lower = from.limits ? (*from.limits)[0] : not_known;"),
                   Member("double upper", "greatest value",
                          "to.upper = from.limits ? (*from.limits)[1] : not_known;")]}),
    Bound("urdf_mesh", kind="part", custom={
        "file": [Member("const char* file", 'empty for a box, a cylinder or a sphere',
                        "to.file = kept.keep(from.file.string()).c_str();")],
        "shape": [
            Member("const double* points", "[point_count][3] points of a box, cylinder or sphere",
                   "to.points = flat(from.shape.points);"),
            Member("size_t point_count", "", "to.point_count = from.shape.points.size();"),
            Member("const uint32_t* faces", "[face_count][3]",
                   "to.faces = flat(from.shape.faces);"),
            Member("size_t face_count", "", "to.face_count = from.shape.faces.size();")]}),
    Bound("urdf_robot", "robot_view", leave="approximated skipped", counts={"links": "link_count"},
          custom={"+": [
              Member("const uint32_t* adjacent",
                     "[adjacent_count][2] pairs of links connected by a joint, which need not be "
                     "compared",
                     "const auto& adjacent = kept.keep(from.adjacent()); "
                     "to.adjacent = flat(adjacent);"),
              Member("size_t adjacent_count", "", "to.adjacent_count = adjacent.size();")]}),
]

#: Lists as results: the element, the name of the list, and its docstring.
LISTS = [
    List("mesh_feature", "features", "features", "Features, largest area first."),
    List("mesh_part", "mesh_parts", "parts", "Parts of a mesh."),
    List("intersection_region", "regions", "regions", "Regions, in the order of their lowest "
                                                      "faces."),
    List("uint32_t", "indices", "values", "A list of numbers."),
    List("double", "heights", "heights", "A list of heights."),
    List("string", "strings", "values", "A list of strings."),
]
