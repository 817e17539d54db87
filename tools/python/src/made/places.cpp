// Made by tools/bindings of the headers of C++: see its README.
#include "../bindings.hpp"

namespace binding {

py::object object(of_result, tf::deviation_result&& from) {
    py::dict made;
    made["distances"] = as_python(std::move(from.distances));
    made["faces"] = as_python(std::move(from.faces));
    made["is_signed"] = as_python(std::move(from.is_signed));
    made["side_counts"] = as_python(std::move(from.side_counts));
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
    made["max_bound"] = as_python(std::move(from.max_bound));
    made["back_max"] = as_python(std::move(from.back_max));
    made["back_max_bound"] = as_python(std::move(from.back_max_bound));
    made["histogram"] = as_python(std::move(from.histogram));
    made["band_counts"] = as_python(std::move(from.band_counts));
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

py::object object(of_result, std::vector<std::optional<tf::closest_point_result>>&& from) {
    py::dict made;
    made["triangle_id"] = column(from, &tf::closest_point_result::face);
    made["distance"] = column(from, &tf::closest_point_result::distance);
    made["closest"] = column(from, &tf::closest_point_result::point);
    return object_of("treeform._nearness", "ClosestPoints", made);
}

py::object object(of_result, std::vector<std::optional<tf::mesh_hit>>&& from) {
    py::dict made;
    made["face"] = column(from, &tf::mesh_hit::face);
    made["at"] =
        column(from, [](const auto& one) { return one ? one->at : tf::feature::interior; });
    made["t"] = column(from, &tf::mesh_hit::t);
    return object_of("treeform._nearness", "RayHits", made);
}

py::object object(of_result, std::vector<tf::placement_contact>&& from) {
    py::dict made;
    made["points"] = column(from, &tf::placement_contact::point);
    made["normals"] = column(from, &tf::placement_contact::normal);
    made["moving"] = column(from, &tf::placement_contact::moving);
    made["fixed_face"] = column(from, &tf::placement_contact::fixed_face);
    made["fixed"] =
        column(from, [](const auto& one) { return static_cast<std::uint32_t>(one.fixed); });
    return object_of("treeform._placement", "Contacts", made);
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
    made["relation"] = as_python(std::move(from.relation));
    made["a_inside_b"] = as_python(std::move(from.a_inside_b));
    made["b_inside_a"] = as_python(std::move(from.b_inside_a));
    made["distance"] = as_python(std::move(from.distance));
    made["surface_distance"] = as_python(std::move(from.surface_distance));
    made["on_a"] = as_python(from.on_a.point);
    made["face_a"] = py::cast(from.on_a.face);
    made["on_b"] = as_python(from.on_b.point);
    made["face_b"] = py::cast(from.on_b.face);
    return object_of("treeform._placement", "Measure", made);
}

py::object object(of_result, tf::placement&& from, const held_mesh& moving) {
    const py::object certificate = as_python(tf::certificate(from.certificate));
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
    made["nearest"] = as_python(std::move(from.nearest));
    made["nearest_fixed"] = as_python(std::move(from.nearest_fixed));
    made["contacts"] = as_python(std::move(from.contacts));
    made["contact_count"] = as_python(std::move(from.contact_count));
    made["effort"] = as_python(std::move(from.effort));
    made["angle"] = as_python(std::move(from.angle));
    made["tolerance"] = as_python(std::move(from.tolerance));
    made["offset"] = as_python(std::move(from.offset));
    made["message"] = py::cast(from.message());
    return object_of("treeform._placement", "Placement", made);
}

py::object object(of_result, tf::impact&& from) {
    py::dict made;
    made["end"] = as_python(std::move(from.end));
    made["time"] = as_python(std::move(from.time));
    made["faces"] = column(from.contacts, [](const auto& one) {
        return std::array{one.face_a, one.face_b};
    });
    made["points"] = column(from.contacts, [](const auto& one) { return one.point; });
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
    const py::object certificate = as_python(tf::certificate(from.certificate));
    py::dict made;
    made["mesh"] = moved_mesh(std::move(from.points), moving, from.matrix, certificate);
    made["matrix"] = as_python(std::move(from.matrix));
    made["areas"] = column(from.sides, [](const auto& one) { return one.area; });
    made["normals"] = column(from.sides, [](const auto& one) { return one.normal; });
    made["tip_angles"] = as_python(std::move(from.tip_angles));
    made["center_heights"] = as_python(std::move(from.center_heights));
    made["overhangs"] = as_python(std::move(from.overhangs));
    made["center_of_mass"] = as_python(std::move(from.center_of_mass));
    made["mass_dimension"] = as_python(std::move(from.mass_dimension));
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

py::object object(of_result, tf::packing&& from, const held_meshes& parts) {
    py::dict made;
    made["parts"] = packed_parts(std::move(from.parts), parts);
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
    made["how"] =
        column_of_poses(from, [](std::uint32_t, const tf::pose_clash& one) { return one.how; });
    made["distance"] = column_of_poses(
        from, [](std::uint32_t, const tf::pose_clash& one) { return one.distance; });
    made["clashing"] = as_python(std::move(from.clashing));
    return object_of("treeform._assembly", "PoseClashes", made);
}

py::object object(of_result, tf::clash_result&& from) {
    py::dict made;
    made["pairs"] = as_python(std::move(from.pairs));
    made["counts"] = counts_of<tf::mesh_relation>(from.counts);
    made["boxes_apart"] = as_python(std::move(from.boxes_apart));
    made["clashes"] = as_python(std::move(from.clashes));
    return object_of("treeform._assembly", "ClashResult", made);
}

}  // namespace binding
