#include "bindings.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from) {
    const auto& v = from.volumes;
    return v ? py::object(py::make_tuple(v->first, v->second, v->either, v->both)) : py::none();
}

py::object contacts_of(const tf::placement& at) {
    using contact = tf::placement_contact;
    constexpr std::uint32_t no_face = tf::operand_element::none;
    py::dict made;
    made["points"] = column(at.contacts, [](const contact& c) { return numbers(c.point); });
    made["normals"] = column(at.contacts, [](const contact& c) { return numbers(c.normal); });
    made["moving"] = column(at.contacts, [](const contact& c) { return c.moving; });
    made["fixed_face"] =
        column(at.contacts, [=](const contact& c) { return c.fixed_face.value_or(no_face); });
    made["fixed"] =
        column(at.contacts, [](const contact& c) { return static_cast<std::uint32_t>(c.fixed); });
    return object_of("treeform._placement", "Contacts", made);
}

py::array ends_of(const std::vector<tf::open_edge>& open) {
    auto ends = column(open, [](const tf::open_edge& edge) {
        return std::array{edge.ends[0].x, edge.ends[0].y, edge.ends[0].z,
                          edge.ends[1].x, edge.ends[1].y, edge.ends[1].z};
    });
    return ends.reshape({-1, 2, 3});
}

py::list regions_of(tf::part_clash& from) {
    py::list regions;
    for (tf::contact_region& region : from.regions)
        regions.append(py::make_tuple(value_of(region.box), region.face_pairs,
                                      as_array(std::move(region.faces_a)),
                                      as_array(std::move(region.faces_b))));
    return regions;
}

py::list texts_of(const std::vector<tf::io_warning>& warnings) {
    py::list texts;
    for (const tf::io_warning& one : warnings) texts.append(one.text);
    return texts;
}

py::array faces_in_file(const tf::usable_mesh& part) {
    std::vector<std::uint32_t> numbers(part.mesh.faces.size());
    for (std::uint32_t f = 0; f < numbers.size(); ++f) numbers[f] = part.face_in_file(f);
    return as_array(std::move(numbers));
}

py::object with_attributes(const file_data* data, tf::attributes&& attributes) {
    if (data == nullptr) return py::none();
    file_data kept = *data;
    kept.own().attributes = std::move(attributes);
    return py::cast(std::move(kept));
}

py::list warnings_of(const tf::weld_stream_result& from) {
    py::list warnings = texts_of(from.survey.warnings);
    for (const auto* const written : {&from.written.welded, &from.written.removed})
        if (*written)
            for (const py::handle text : texts_of((*written)->warnings)) warnings.append(text);
    return warnings;
}

py::object object(of_result, tf::section_result&& s) {
    using layer = tf::section_layer;
    using loop = tf::section_loop;
    py::dict made, loops;
    made["heights"] = column(s.layers, [](const layer& l) { return l.height; });
    made["origins"] = column(s.layers, [](const layer& l) { return numbers(l.at); });
    made["areas"] = column(s.layers, [](const layer& l) { return l.area; });
    made["lengths"] = column(s.layers, [](const layer& l) { return l.length; });
    made["open_counts"] = column(s.layers, [](const layer& l) { return l.open_count; });
    loops["first_loop"] = column(s.layers, [](const layer& l) { return l.first_loop; });
    loops["first_point"] =
        column(s.loops, [](const loop& l) { return static_cast<std::uint64_t>(l.first_point); });
    loops["closed"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.closed}; });
    loops["oriented"] = column(s.loops, [](const loop& l) { return std::uint8_t{l.oriented}; });
    loops["parent"] = column(s.loops, [](const loop& l) { return l.parent; });
    loops["depth"] = column(s.loops, [](const loop& l) { return l.depth; });
    loops["loop_areas"] = column(s.loops, [](const loop& l) { return l.area; });
    loops["loop_lengths"] = column(s.loops, [](const loop& l) { return l.length; });
    made["points"] = as_array<double>(std::vector(s.points));
    made["faces"] = as_array(std::vector(s.faces));
    made["frame"] = column(std::array{s.frame.x, s.frame.y, s.frame.normal},
                           [](const tf::point3& axis) { return numbers(axis); });
    made["_loops"] = loops;
    made["_data"] = std::move(s);
    return object_of("treeform._cuts", "Section", made);
}

py::object object(of_result, tf::cut_result&& from, const carrying& attributes) {
    const py::object made = py::module_::import("treeform._cuts")
                                .attr("CutPieces")(as_python(std::move(from.pieces), attributes));
    made.attr("certificate") = as_python(std::move(from.certificate));
    made.attr("resolved") = from.resolved;
    return made;
}

py::object object(of_result, tf::intersection_regions&& from) {
    const py::object regions = as_python(std::move(from.regions));
    return py::make_tuple(regions, as_array(std::move(from.region_of_pair)));
}

py::object object(of_result, tf::curve_network&& from) {
    py::list paths;
    for (tf::curve_path& one : from.paths)
        paths.append(py::make_tuple(as_array(std::move(one.points)), one.closed));
    return py::make_tuple(
        column(from.points,
               [](const tf::curve_point& p) {
                   return std::array<double, 3>{p.position.x, p.position.y, p.position.z};
               }),
        paths);
}

py::object object(of_result, tf::rounding_effects&& from) {
    return py::make_tuple(from.collapsed, from.meeting);
}

py::object mesh_object(tf::mesh&& mesh, const py::object& certificate, const py::object& data) {
    return py::module_::import("treeform._mesh")
        .attr("Mesh")
        .attr("_of")(as_array(std::move(mesh.points)), as_array(std::move(mesh.faces)), data,
                     certificate);
}

py::object moved_mesh(std::vector<tf::point3>&& points, const held_mesh& body,
                      const tf::transform<3>& matrix, const py::object& certificate) {
    const py::tuple turned = turned_over(body, matrix);
    const py::object there =
        points.empty() ? py::object(body.points()) : as_array(std::move(points));
    return py::module_::import("treeform._mesh")
        .attr("Mesh")
        .attr("_of")(there, turned[0], turned[1], certificate);
}

}  // namespace binding
