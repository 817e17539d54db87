// Made by tools/bindings of the headers of C++: see its README.
#include "../parts.hpp"

namespace binding {

py::object object(of_result, tf::boolean_result&& from, const carrying& attributes) {
    const py::object certificate = py::cast(from.certificate);
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["certificate"] = certificate;
    made["volumes"] = volumes_of(from);
    made["statistics"] =
        with(with(counters(from.statistics), "vanished_components", from.vanished_components),
             "vanished_reach", from.vanished_reach);
    return object_of("treeform._booleans", "BooleanResult", made);
}

py::object object(of_result, tf::cut_piece&& from, const carrying& attributes) {
    const py::object certificate = py::cast(from.certificate);
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["cap"] = as_python(std::move(from.cap));
    made["certificate"] = certificate;
    return object_of("treeform._cuts", "CutPiece", made);
}

py::object object(of_result, tf::mesh_part&& from, const carrying& attributes) {
    const py::object certificate = py::none();
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["volume"] = as_python(std::move(from.volume));
    made["area"] = as_python(std::move(from.area));
    return object_of("treeform._cuts", "MeshPart", made);
}

py::object object(of_result, tf::mass_properties&& from) {
    py::dict made;
    made["volume"] = as_python(std::move(from.volume));
    made["center"] = as_python(std::move(from.center));
    made["inertia"] = as_python(std::move(from.inertia));
    return object_of("treeform._cuts", "MassProperties", made);
}

py::object object(of_result, tf::resolve_result&& from, const carrying& attributes) {
    const py::object certificate = py::cast(from.certificate);
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["certificate"] = certificate;
    made["statistics"] =
        with(counters(from.statistics), "vanished_components", from.vanished_components);
    return object_of("treeform._repair", "ResolveResult", made);
}

py::object object(of_result, tf::repair_result&& from, const carrying& attributes) {
    const py::object certificate = py::cast(from.certificate);
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["is_left"] = as_python(std::move(from.is_left)).attr("view")("bool");
    made["certificate"] = certificate;
    made["steps"] = counters(from.statistics);
    return object_of("treeform._repair", "RepairResult", made);
}

py::object object(of_result, tf::wrap_result&& from) {
    const py::object certificate = py::cast(from.certificate);
    const py::object data = py::none();
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["certificate"] = certificate;
    made["statistics"] = counters(from.statistics);
    return object_of("treeform._repair", "WrapResult", made);
}

py::object object(of_result, tf::convex_hull_result&& from) {
    py::dict made;
    made["dimension"] = as_python(std::move(from.dimension));
    made["faces"] = as_python(std::move(from.faces));
    made["first_face"] = column(from.sides, [](const auto& one) { return one.first_face; });
    made["areas"] = column(from.sides, [](const auto& one) { return one.area; });
    made["normals"] = column(from.sides, [](const auto& one) { return numbers(one.normal); });
    return object_of("treeform._repair", "ConvexHull", made);
}

py::object object(of_result, tf::solid_defects&& from) {
    py::dict made;
    made["nonfinite_vertices"] = as_python(std::move(from.nonfinite_vertices));
    made["unusable_faces"] = as_python(std::move(from.unusable_faces));
    made["without_faces"] = as_python(std::move(from.without_faces));
    made["tetrahedra"] = as_python(std::move(from.tetrahedra));
    made["degenerate"] = as_python(std::move(from.degenerate));
    made["repeated"] = as_python(std::move(from.repeated));
    made["open_edges"] = as_python(std::move(from.open_edges));
    made["nonmanifold_edges"] = as_python(std::move(from.nonmanifold_edges));
    made["misoriented_edges"] = as_python(std::move(from.misoriented_edges));
    made["nonmanifold_vertices"] = as_python(std::move(from.nonmanifold_vertices));
    made["meeting_pairs"] = as_python(std::move(from.meeting_pairs));
    made["inverted"] = as_python(std::move(from.inverted));
    made["wrongly_nested"] = as_python(std::move(from.wrongly_nested));
    made["message"] = py::cast(from.message());
    return object_of("treeform._properties", "SolidDefects", made);
}

py::object object(of_result, tf::mesh_defects&& from) {
    py::dict made;
    made["nonfinite_points"] = as_python(std::move(from.nonfinite_points));
    made["nonfinite_faces"] = as_python(std::move(from.nonfinite_faces));
    made["degenerate_faces"] = as_python(std::move(from.degenerate_faces));
    made["out_of_range_faces"] = as_python(std::move(from.out_of_range_faces));
    return object_of("treeform._properties", "MeshDefects", made);
}

py::object object(of_result, tf::topology_counts&& from) {
    py::dict made;
    made["edges"] = as_python(std::move(from.edges));
    made["boundary_edges"] = as_python(std::move(from.boundary_edges));
    made["nonmanifold_edges"] = as_python(std::move(from.nonmanifold_edges));
    made["misoriented_edges"] = as_python(std::move(from.misoriented_edges));
    made["nonmanifold_points"] = as_python(std::move(from.nonmanifold_points));
    made["components_by_point"] = as_python(std::move(from.components_by_point));
    made["components_by_edge"] = as_python(std::move(from.components_by_edge));
    made["points_used"] = as_python(std::move(from.points_used));
    made["faces"] = as_python(std::move(from.faces));
    made["repeated_corner_faces"] = as_python(std::move(from.repeated_corner_faces));
    made["duplicate_faces"] = as_python(std::move(from.duplicate_faces));
    made["closed"] = as_python(std::move(from.closed));
    return object_of("treeform._properties", "Topology", made);
}

py::object object(of_result, tf::mesh_feature&& from) {
    py::dict made;
    made["kind"] = as_python(std::move(from.kind));
    made["origin"] = as_python(std::move(from.origin));
    made["direction"] = as_python(std::move(from.direction));
    made["radius"] = as_python(std::move(from.radius));
    made["hollow"] = as_python(std::move(from.hollow));
    made["area"] = as_python(std::move(from.area));
    made["deviation"] = as_python(std::move(from.deviation));
    made["faces"] = as_python(std::move(from.faces));
    return object_of("treeform._properties", "Feature", made);
}

py::object object(of_result, tf::self_intersection_result&& from) {
    py::dict made;
    made["pairs"] = column(from.pairs, [](const auto& one) { return std::array{one.a, one.b}; });
    made["kinds"] =
        column(from.pairs, [](const auto& one) { return static_cast<std::uint8_t>(one.kind); });
    made["counts"] = counts_of<tf::pair_kind>(from.counts);
    return object_of("treeform._intersections", "FacePairs", made);
}

py::object object(of_result, tf::mesh_intersection_result&& from) {
    py::dict made;
    made["pairs"] = column(from.pairs, [](const auto& one) { return std::array{one.a, one.b}; });
    made["kinds"] =
        column(from.pairs, [](const auto& one) { return static_cast<std::uint8_t>(one.kind); });
    made["counts"] = counts_of<tf::pair_kind>(from.counts);
    return object_of("treeform._intersections", "FacePairs", made);
}

py::object object(of_result, tf::intersection_region&& from) {
    py::dict made;
    made["faces"] = as_python(std::move(from.faces));
    made["bounds"] = as_python(std::array{from.min, from.max});
    made["pairs"] = as_python(std::move(from.pairs));
    return object_of("treeform._intersections", "Region", made);
}

py::object object(of_result, tf::stream_search_result&& from) {
    py::dict made;
    made["face_in_file"] = faces_in_file(from.part);
    made["mesh"] = mesh_object(std::move(from.part.mesh), py::none(), py::none());
    made["dropped"] = py::cast(from.part.dropped);
    made["pairs"] = column(from.found.pairs, [](const auto& one) {
        return std::array{one.a, one.b};
    });
    made["kinds"] = column(from.found.pairs,
                           [](const auto& one) { return static_cast<std::uint8_t>(one.kind); });
    made["counts"] = counts_of<tf::pair_kind>(from.found.counts);
    made["stored_faces"] = as_python(std::move(from.stored_faces));
    made["tiles"] = as_python(std::move(from.tiles));
    return object_of("treeform._intersections", "FilePairs", made);
}

py::object object(of_result, tf::write_result&& from) {
    py::dict made;
    made["format"] = as_python(std::move(from.format));
    made["precision"] = as_python(std::move(from.written_as));
    made["max_displacement"] = as_python(std::move(from.max_displacement));
    made["warnings"] = texts_of(from.warnings);
    return object_of("treeform._files", "Written", made);
}

py::object object(of_result, tf::weld_result&& from, const file_data* data) {
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), py::none(),
                               with_attributes(data, std::move(from.attributes)));
    made["index"] = as_python(std::move(from.groups.group_of_point));
    made["source"] = as_python(std::move(from.point_of_group));
    made["face_source"] = as_python(std::move(from.face_of_new));
    made["statistics"] = counters(from.statistics);
    return object_of("treeform._weld", "WeldResult", made);
}

py::object object(of_result, tf::weld_stream_result&& from) {
    py::dict made;
    made["points"] = py::cast(from.survey.points);
    made["tolerance"] = py::cast(from.survey.tolerance);
    made["non_finite"] = py::cast(from.survey.non_finite);
    made["tiles"] = py::cast(from.survey.tiles);
    made["continued"] = py::cast(from.survey.continued);
    made["kept"] = as_python(std::move(from.counts.kept));
    made["groups"] = as_python(std::move(from.counts.groups));
    made["max_displacement"] = py::cast(from.counts.max_displacement + from.survey.las_moved);
    made["faces"] = py::cast(from.counts.faces);
    made["statistics"] = counters(from.counts);
    made["warnings"] = warnings_of(from);
    return object_of("treeform._weld", "WeldStreamResult", made);
}

py::object object(of_result, tf::deviation_result&& from) {
    py::dict made;
    made["distances"] = as_python(std::move(from.distances));
    made["faces"] = as_python(std::move(from.faces));
    made["is_signed"] = as_python(std::move(from.is_signed));
    made["side_counts"] =
        from.sides
            ? py::object(py::make_tuple(from.sides->inside, from.sides->on, from.sides->outside))
            : py::none();
    made["mean"] = as_python(std::move(from.mean));
    made["mean_absolute"] = as_python(std::move(from.mean_absolute));
    made["rms"] = as_python(std::move(from.rms));
    made["p50"] = as_python(std::move(from.p50));
    made["p95"] = as_python(std::move(from.p95));
    made["p99"] = as_python(std::move(from.p99));
    made["max"] = as_python(std::move(from.max));
    made["worst"] = as_python(std::move(from.worst));
    made["lowest"] = as_python(std::move(from.lowest));
    made["highest"] = as_python(std::move(from.highest));
    made["there"] = py::make_tuple(from.there.sampled, from.there.at_most);
    made["back"] =
        from.back ? py::object(py::make_tuple(from.back->sampled, from.back->at_most)) : py::none();
    made["histogram_range"] = py::make_tuple(from.histogram.low, from.histogram.high);
    made["histogram"] = as_python(std::move(from.histogram.counts));
    made["band_counts"] =
        from.band
            ? py::object(py::make_tuple(from.band->below, from.band->within, from.band->above))
            : py::none();
    return object_of("treeform._nearness", "Deviation", made);
}

py::object object(of_result, tf::closest_points_result&& from) {
    py::dict made;
    made["face_a"] = as_python(std::move(from.face_a));
    made["face_b"] = as_python(std::move(from.face_b));
    made["distance"] = as_python(std::move(from.distance));
    made["on_a"] = as_python(std::move(from.on_a));
    made["on_b"] = as_python(std::move(from.on_b));
    return object_of("treeform._assembly", "NearestPoints", made);
}

py::object object(of_result, tf::search_effort&& from) {
    py::dict made;
    made["pairs"] = as_python(std::move(from.pairs));
    made["bound"] = as_python(std::move(from.bound));
    made["cut"] = as_python(std::move(from.cut));
    return object_of("treeform._placement", "SearchEffort", made);
}

py::object object(of_result, tf::mesh_measure&& from) {
    py::dict made;
    made["relation"] = as_python(std::move(from.relation.relation));
    made["a_inside_b"] = as_python(std::move(from.relation.a_inside_b));
    made["b_inside_a"] = as_python(std::move(from.relation.b_inside_a));
    made["distance"] = as_python(std::move(from.distance));
    made["surface_distance"] = as_python(std::move(from.surface_distance));
    made["on_a"] = as_python(from.on_a.point);
    made["face_a"] = py::cast(from.on_a.face);
    made["on_b"] = as_python(from.on_b.point);
    made["face_b"] = py::cast(from.on_b.face);
    return object_of("treeform._placement", "Measure", made);
}

py::object object(of_result, tf::placement&& from, const held_mesh& moving) {
    const py::object certificate = py::cast(from.certificate);
    py::dict made;
    made["certificate"] = certificate;
    made["end"] = as_python(std::move(from.end));
    made["mesh"] = moved_mesh(std::move(from.points), moving, from.matrix,
                              from.certificate ? certificate : py::none());
    made["matrix"] = as_python(std::move(from.matrix));
    made["direction"] = as_python(std::move(from.direction));
    made["travel"] = as_python(std::move(from.travel));
    made["at_start"] = as_python(std::move(from.at_start));
    made["at_place"] = as_python(std::move(from.at_place));
    made["nearest"] = from.nearest
                          ? py::object(py::make_tuple(from.nearest->fixed,
                                                      as_python(std::move(from.nearest->how))))
                          : py::none();
    made["contacts"] = contacts_of(from);
    made["contact_count"] = as_python(std::move(from.contact_count));
    made["effort"] = as_python(std::move(from.effort));
    made["message"] = py::cast(from.message());
    made["angle"] = py::cast(0.0);
    made["tolerance"] = py::cast(0.0);
    made["offset"] = py::cast(0.0);
    return object_of("treeform._placement", "Placement", made);
}

py::object object(of_result, tf::impact&& from) {
    py::dict made;
    made["end"] = as_python(std::move(from.end));
    made["time"] = as_python(std::move(from.time));
    made["faces"] = column(from.contacts, [](const auto& one) {
        return std::array{one.face_a, one.face_b};
    });
    made["points"] = column(from.contacts, [](const auto& one) { return numbers(one.point); });
    return object_of("treeform._placement", "Impact", made);
}

py::object object(of_result, tf::penetration_depth_result&& from) {
    py::dict made;
    made["depth"] = as_python(std::move(from.depth));
    made["move"] = as_python(std::move(from.move));
    made["effort"] = as_python(std::move(from.effort));
    return object_of("treeform._placement", "Depth", made);
}

py::object object(of_result, tf::laid_flat&& from, const held_mesh& moving) {
    const py::object certificate = py::cast(from.certificate);
    py::dict made;
    made["mesh"] = moved_mesh(std::move(from.points), moving, from.matrix, certificate);
    made["matrix"] = as_python(std::move(from.matrix));
    made["areas"] = column(from.sides, [](const auto& one) { return one.area; });
    made["normals"] = column(from.sides, [](const auto& one) { return numbers(one.normal); });
    made["tip_angles"] = column(from.stability, [](const auto& one) { return one.tip_angle; });
    made["overhangs"] = column(from.stability, [](const auto& one) { return one.overhang; });
    made["center_of_mass"] = as_python(std::move(from.center_of_mass));
    made["mass"] = as_python(std::move(from.mass));
    made["chosen"] = as_python(std::move(from.chosen));
    made["on_bed"] = as_python(std::move(from.on_bed));
    made["certificate"] = certificate;
    made["message"] = py::cast(from.message());
    return object_of("treeform._placement", "LaidFlat", made);
}

py::object object(of_result, tf::align_result&& from, const held_mesh& moving) {
    py::dict made;
    made["mesh"] = moved_mesh(std::move(from.points), moving, from.matrix, py::none());
    made["matrix"] = as_python(std::move(from.matrix));
    made["scale"] = as_python(std::move(from.scale));
    made["rms"] = as_python(std::move(from.rms));
    made["rms_at_start"] = as_python(std::move(from.rms_at_start));
    made["overlap"] = as_python(std::move(from.overlap));
    made["inliers"] = as_python(std::move(from.inliers));
    made["correlation"] = as_python(std::move(from.correlation));
    made["uncertainty"] = as_python(std::move(from.uncertainty));
    made["end"] = as_python(std::move(from.end));
    made["converged"] = as_python(std::move(from.converged));
    made["iterations"] = as_python(std::move(from.iterations));
    made["start"] = as_python(std::move(from.start));
    made["undetermined"] = py::cast(from.undetermined());
    made["message"] = py::cast(from.message());
    return object_of("treeform._placement", "Alignment", made);
}

py::object object(of_result, tf::packed_part&& from, const held_mesh& moving) {
    py::dict made;
    made["placed"] = as_python(std::move(from.placed));
    made["plate"] = as_python(std::move(from.plate));
    made["mesh"] = moved_mesh(std::move(from.points), moving, from.matrix, py::none());
    made["matrix"] = as_python(std::move(from.matrix));
    return object_of("treeform._placement", "PackedPart", made);
}

py::object object(of_result, tf::packing&& from) {
    py::dict made;
    made["parts"] = py::list();
    made["not_placed"] = as_python(std::move(from.not_placed));
    made["plates_used"] = as_python(std::move(from.plates_used));
    made["tries"] = as_python(std::move(from.tries));
    made["density"] = as_python(std::move(from.density));
    made["message"] = py::cast(from.message());
    return object_of("treeform._placement", "Packing", made);
}

py::object object(of_result, tf::part_clash&& from) {
    py::dict made;
    made["a"] = as_python(std::move(from.a));
    made["b"] = as_python(std::move(from.b));
    made["how"] = as_python(std::move(from.how));
    made["a_inside_b"] = as_python(std::move(from.a_inside_b));
    made["b_inside_a"] = as_python(std::move(from.b_inside_a));
    made["distance"] = as_python(std::move(from.distance));
    made["nearest"] = as_python(std::move(from.nearest));
    made["face_pairs"] = as_python(std::move(from.face_pairs));
    made["regions"] = regions_of(from);
    made["volume"] = as_python(std::move(from.volume));
    made["depth"] = as_python(std::move(from.depth));
    made["move"] = as_python(std::move(from.move));
    made["depth_effort"] = as_python(std::move(from.depth_effort));
    return object_of("treeform._assembly", "PartClash", made);
}

py::object object(of_result, tf::pose_result&& from) {
    py::dict made;
    made["pose"] =
        column_of_poses(from, [](std::uint32_t pose, const tf::pose_clash&) { return pose; });
    made["parts"] = column_of_poses(from, [](std::uint32_t, const tf::pose_clash& one) {
        return std::array{one.a, one.b};
    });
    made["how"] = column_of_poses(from, [](std::uint32_t, const tf::pose_clash& one) {
        return static_cast<std::uint8_t>(one.how);
    });
    made["distance"] = column_of_poses(
        from, [](std::uint32_t, const tf::pose_clash& one) { return one.distance; });
    made["clashing"] = as_python(std::move(from.clashing));
    return object_of("treeform._assembly", "PoseClashes", made);
}

py::object object(of_result, tf::clash_result&& from) {
    py::dict made;
    made["pairs"] = as_python(std::move(from.pairs));
    made["counts"] = counts_of<tf::standing>(from.counts);
    made["boxes_apart"] = as_python(std::move(from.boxes_apart));
    made["clashes"] = as_python(std::move(from.clashes));
    return object_of("treeform._assembly", "ClashResult", made);
}

py::dict counters(const tf::boolean_statistics& from) {
    py::dict made;
    made["pairs"] = from.pairs;
    made["cut_faces"] = from.cut_faces;
    made["degenerate"] = from.degenerate;
    made["skipped_faces"] = from.skipped_faces;
    made["covered"] = from.covered;
    made["exact_faces"] = from.exact_faces;
    made["split_vertices"] = from.split_vertices;
    made["slivers"] = from.slivers;
    made["rounding_rounds"] = from.rounding_rounds;
    made["small_parts"] = from.small_parts;
    made["small_volume"] = from.small_volume;
    made["filled_faces"] = from.filled_faces;
    return made;
}

py::dict counters(const tf::resolve_statistics& from) {
    py::dict made;
    made["removed"] = from.removed;
    made["covered"] = from.covered;
    made["filled"] = from.filled;
    made["left_open"] = from.left_open;
    made["exact_faces"] = from.exact_faces;
    made["split_vertices"] = from.split_vertices;
    return made;
}

py::dict counters(const tf::repair_statistics& from) {
    py::dict made;
    made["tetrahedra"] = from.tetrahedra;
    made["degenerate"] = from.degenerate;
    made["repeated"] = from.repeated;
    made["closed_edges"] = from.closed_edges;
    made["split_edges"] = from.split_edges;
    made["gap"] = from.gap;
    made["widest"] = from.widest;
    made["flipped"] = from.flipped;
    made["turned"] = from.turned;
    made["strays"] = from.strays;
    made["holes"] = from.holes;
    made["hole_edges"] = from.hole_edges;
    made["filled"] = from.filled;
    made["sheets"] = from.sheets;
    made["open_edges"] = from.open_edges;
    made["resolved"] = from.resolved;
    made["pairs"] = from.pairs;
    made["labeled_cells"] = from.labeled_cells;
    made["dropped_area"] = from.dropped_area;
    made["turned_area"] = from.turned_area;
    made["removed"] = from.removed;
    made["split_vertices"] = from.split_vertices;
    made["detached"] = from.detached;
    made["touching"] = from.touching;
    made["vanished_components"] = from.vanished_components;
    made["dropped_shells"] = from.dropped_shells;
    made["volume_before"] = from.volume_before;
    made["volume_after"] = from.volume_after;
    made["area_before"] = from.area_before;
    made["area_after"] = from.area_after;
    made["area_lost"] = from.area_lost;
    return made;
}

py::dict counters(const tf::wrap_statistics& from) {
    py::dict made;
    made["size"] = from.size;
    made["offset"] = from.offset;
    made["area"] = from.area;
    made["points"] = from.points;
    made["tetrahedra"] = from.tetrahedra;
    made["filled"] = from.filled;
    return made;
}

py::dict counters(const tf::weld_statistics& from) {
    py::dict made;
    made["groups"] = from.groups;
    made["non_finite"] = from.non_finite;
    made["collapsed"] = from.collapsed;
    made["degenerate"] = from.degenerate;
    made["max_displacement"] = from.max_displacement;
    made["nonmanifold_before"] = from.nonmanifold_before;
    made["nonmanifold_after"] = from.nonmanifold_after;
    made["flipped"] = from.flipped;
    made["left_alone"] = from.left_alone;
    return made;
}

py::dict counters(const tf::weld_stream_counts& from) {
    py::dict made;
    made["triangles"] = from.triangles;
    made["collapsed"] = from.collapsed;
    made["degenerate"] = from.degenerate;
    made["nonmanifold_before"] = from.nonmanifold_before;
    made["nonmanifold_after"] = from.nonmanifold_after;
    made["flipped"] = from.flipped;
    return made;
}

}  // namespace binding
