// Made by tools/bindings of the headers of C++: see its README.
#include "../bindings.hpp"

namespace binding {

py::object object(of_result, tf::certificate&& from) {
    py::dict made;
    made["status"] = py::cast(word_of(from.status));
    made["meeting_count"] = as_python(std::move(from.meeting_count));
    made["meeting"] = column(from.meeting, [](const auto& one) { return one; });
    made["open_count"] = as_python(std::move(from.open_count));
    made["open_edges"] = ends_of(from.open_edges);
    made["open_faces"] = column(from.open_faces, [](const auto& one) {
        return std::array{one.operand, one.index};
    });
    made["boundary_edges"] = as_python(std::move(from.boundary_edges));
    made["misoriented_edges"] = as_python(std::move(from.misoriented_edges));
    made["max_displacement"] = as_python(std::move(from.max_displacement));
    made["precision"] = as_python(std::move(from.precision));
    made["vanished_faces"] = as_python(std::move(from.vanished_faces));
    made["size_before"] = as_python(std::move(from.size_before));
    made["size_after"] = as_python(std::move(from.size_after));
    made["size_is_volume"] = as_python(std::move(from.size_is_volume));
    made["message"] = py::cast(from.message());
    return object_of("treeform._results", "Certificate", made);
}

py::object object(of_result, tf::boolean_result&& from, const carrying& attributes) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
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

py::object object(of_result, tf::section_loop&& from, const tf::section_result& whole) {
    py::dict made;
    made["points"] = part_of<double>(whole.points, from);
    made["faces"] = part_of<std::uint32_t>(whole.faces, from);
    made["closed"] = as_python(std::move(from.closed));
    made["oriented"] = as_python(std::move(from.oriented));
    made["parent"] = parent_of(whole, from);
    made["depth"] = as_python(std::move(from.depth));
    made["area"] = as_python(std::move(from.area));
    made["length"] = as_python(std::move(from.length));
    return object_of("treeform._cuts", "SectionLoop", made);
}

py::object object(of_result, tf::section_result&& from) {
    py::dict made;
    made["heights"] = column(from.layers, [](const auto& one) { return one.height; });
    made["origins"] = column(from.layers, [](const auto& one) { return one.at; });
    made["areas"] = column(from.layers, [](const auto& one) { return one.area; });
    made["lengths"] = column(from.layers, [](const auto& one) { return one.length; });
    made["open_counts"] = column(from.layers, [](const auto& one) { return one.open_count; });
    made["points"] = as_array<double>(std::vector(from.points));
    made["faces"] = as_array(std::vector(from.faces));
    made["axes"] = as_python(std::move(from.axes));
    made["_data"] = py::cast(std::move(from));
    return object_of("treeform._cuts", "Section", made);
}

py::object object(of_result, tf::cut_piece&& from, const carrying& attributes) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
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

py::object object(of_result, tf::offset_result&& from) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
    const py::object data = py::none();
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["certificate"] = certificate;
    made["distance"] = as_python(std::move(from.distance));
    made["resolution"] = as_python(std::move(from.resolution));
    made["least_distance"] = as_python(std::move(from.least_distance));
    made["greatest_distance"] = as_python(std::move(from.greatest_distance));
    made["cells"] = as_python(std::move(from.cells));
    made["sealed_cavities"] = as_python(std::move(from.sealed_cavities));
    made["blind_drains"] = as_python(std::move(from.blind_drains));
    made["tetrahedra"] = as_python(std::move(from.tetrahedra));
    made["tetrahedra_points"] = as_python(std::move(from.tetrahedra_points));
    made["filled_tetrahedra"] = as_python(std::move(from.filled_tetrahedra));
    return object_of("treeform._shapes", "OffsetResult", made);
}

py::object object(of_result, tf::simplify_result&& from, const carrying& attributes) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
    const py::object data = data_of(from, attributes);
    py::dict made;
    made["mesh"] = mesh_object(std::move(from.mesh), certificate, data);
    made["face_source"] = as_python(std::move(from.face_source));
    made["vertex_source"] = as_python(std::move(from.vertex_source));
    made["face_of_new_vertex"] = as_python(std::move(from.face_of_new_vertex));
    made["corner_source"] = as_python(std::move(from.corner_source));
    made["collapses"] = as_python(std::move(from.collapses));
    made["refused_by_topology"] = as_python(std::move(from.refused_by_topology));
    made["refused_by_turning"] = as_python(std::move(from.refused_by_turning));
    made["refused_by_distance"] = as_python(std::move(from.refused_by_distance));
    made["refused_by_contact"] = as_python(std::move(from.refused_by_contact));
    made["input_to_result_bound"] = as_python(std::move(from.input_to_result_bound));
    made["result_to_input_bound"] = as_python(std::move(from.result_to_input_bound));
    made["certificate"] = certificate;
    return object_of("treeform._shapes", "SimplifyResult", made);
}

py::object object(of_result, tf::thickness_result&& from) {
    py::dict made;
    made["of_face"] = as_python(std::move(from.of_face));
    made["least"] = as_python(std::move(from.least));
    made["thinnest"] = as_python(std::move(from.thinnest));
    return object_of("treeform._shapes", "Thickness", made);
}

py::object object(of_result, tf::oriented_box&& from) {
    py::dict made;
    made["center"] = as_python(std::move(from.center));
    made["axes"] = as_python(std::move(from.axes));
    made["size"] = as_python(std::move(from.size));
    return object_of("treeform._shapes", "OrientedBox", made);
}

py::object object(of_result, tf::isoline&& from) {
    py::dict made;
    made["level"] = as_python(std::move(from.level));
    made["first_point"] = as_python(std::move(from.first_point));
    made["point_count"] = as_python(std::move(from.point_count));
    made["closed"] = as_python(std::move(from.closed));
    made["oriented"] = as_python(std::move(from.oriented));
    made["length"] = as_python(std::move(from.length));
    return object_of("treeform._shapes", "Isoline", made);
}

py::object object(of_result, tf::isolines_result&& from) {
    py::dict made;
    made["lines"] = as_python(std::move(from.lines));
    made["points"] = as_python(std::move(from.points));
    made["faces"] = as_python(std::move(from.faces));
    return object_of("treeform._shapes", "Isolines", made);
}

py::object object(of_result, tf::repair_result&& from, const carrying& attributes) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
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

py::object object(of_result, tf::convex_hull_result&& from) {
    py::dict made;
    made["dimension"] = as_python(std::move(from.dimension));
    made["faces"] = as_python(std::move(from.faces));
    made["first_face"] = column(from.sides, [](const auto& one) { return one.first_face; });
    made["areas"] = column(from.sides, [](const auto& one) { return one.area; });
    made["normals"] = column(from.sides, [](const auto& one) { return one.normal; });
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

py::object object(of_result, tf::intersection_result&& from) {
    py::dict made;
    made["pairs"] = column(from.pairs, [](const auto& one) { return std::array{one.a, one.b}; });
    made["kinds"] = column(from.pairs, [](const auto& one) { return one.kind; });
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
    made["non_finite"] = py::cast(from.part.non_finite);
    made["pairs"] = column(from.found.pairs, [](const auto& one) {
        return std::array{one.a, one.b};
    });
    made["kinds"] = column(from.found.pairs, [](const auto& one) { return one.kind; });
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

py::object object(of_result, tf::urdf_joint&& from, const tf::urdf_robot& robot) {
    py::dict made;
    made["name"] = as_python(std::move(from.name));
    made["kind"] = as_python(std::move(from.kind));
    made["parent"] = py::cast(robot.links[from.parent]);
    made["child"] = py::cast(robot.links[from.child]);
    made["limits"] = as_python(std::move(from.limits));
    return object_of("treeform._robots", "Joint", made);
}

py::object object(of_result, tf::urdf_robot&& from, std::vector<tf::urdf_mesh>& parts) {
    py::dict made;
    made["name"] = as_python(std::move(from.name));
    made["links"] = as_python(std::vector(from.links));
    made["joints"] = as_python(std::vector(from.joints), from);
    made["parts"] = meshes_of(std::move(parts));
    made["link_of_part"] = column(parts, &tf::urdf_mesh::link);
    made["adjacent"] = column(from.adjacent(parts), std::identity{});
    made["approximated"] = as_python(std::move(from.approximated));
    made["skipped"] = as_python(std::move(from.skipped));
    made["_data"] = py::cast(robot_data(from, parts));
    return object_of("treeform._robots", "Robot", made);
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
    made["kept"] = as_python(std::move(from.kept));
    made["faces"] = as_python(std::move(from.faces));
    made["triangles"] = as_python(std::move(from.triangles));
    made["statistics"] = counters(from.statistics);
    made["max_displacement"] = py::cast(from.statistics.max_displacement + from.survey.las_moved);
    made["warnings"] = warnings_of(from);
    return object_of("treeform._weld", "WeldStreamResult", made);
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

py::dict counters(const tf::repair_statistics& from) {
    py::dict made;
    made["tetrahedra"] = from.tetrahedra;
    made["degenerate"] = from.degenerate;
    made["repeated"] = from.repeated;
    made["closed_edges"] = from.closed_edges;
    made["split_edges"] = from.split_edges;
    made["gap_limit"] = from.gap_limit;
    made["widest_closed"] = from.widest_closed;
    made["flipped"] = from.flipped;
    made["turned_outward"] = from.turned_outward;
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
    made["flipped_area"] = from.flipped_area;
    made["removed"] = from.removed;
    made["covered"] = from.covered;
    made["left_open"] = from.left_open;
    made["exact_faces"] = from.exact_faces;
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
    made["kept_apart"] = from.kept_apart;
    return made;
}

}  // namespace binding
