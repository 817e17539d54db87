#include "bindings.hpp"

namespace binding {

py::object volumes_of(const tf::boolean_result& from) {
    const auto& v = from.volumes;
    return v ? py::object(py::make_tuple(v->first, v->second, v->either, v->both)) : py::none();
}

py::array ends_of(const std::vector<std::array<tf::point3, 2>>& edges) {
    auto ends = column(edges, [](const auto& edge) {
        const auto& [from, to] = edge;
        return std::array{from.x, from.y, from.z, to.x, to.y, to.z};
    });
    return ends.reshape({-1, 2, 3});
}

std::vector<py::tuple> regions_of(tf::part_clash& from) {
    return list_of(from.regions, [](tf::contact_region& region) {
        return py::make_tuple(value_of(region.box), region.face_pairs,
                              as_array(std::move(region.faces_a)),
                              as_array(std::move(region.faces_b)));
    });
}

robot_data::robot_data(const tf::urdf_robot& robot, const std::vector<tf::urdf_mesh>& parts)
    : content(robot), links(list_of(parts, &tf::urdf_mesh::link)) {}

std::vector<py::object> meshes_of(std::vector<tf::urdf_mesh>&& parts) {
    return list_of(parts, [](tf::urdf_mesh& one) {
        return mesh_object(std::move(one.shape), py::none(), py::none());
    });
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

std::vector<std::string> warnings_of(const tf::weld_stream_result& from) {
    std::vector<std::string> texts = list_of(from.survey.warnings, &tf::io_warning::text);
    for (const auto* const written : {&from.welded, &from.removed})
        if (*written)
            for (const tf::io_warning& one : (*written)->warnings) texts.push_back(one.text);
    return texts;
}

py::object parent_of(const tf::section_result& whole, const tf::section_loop& loop) {
    if (loop.parent == none) return py::none();
    const auto layer = std::ranges::find_if(whole.layers, [&](const tf::section_layer& l) {
        return loop.parent - l.first_loop < l.loop_count;
    });
    return py::int_(loop.parent - layer->first_loop);
}

py::object object(of_result, std::vector<tf::point_location>&& from) {
    return py::make_tuple(column(from, &tf::point_location::where),
                          column(from, &tf::point_location::winding));
}

py::object object(of_result, tf::cut_result&& from, const carrying& attributes) {
    const py::object made = py::module_::import("treeform._cuts")
                                .attr("CutPieces")(as_python(std::move(from.pieces), attributes));
    made.attr("certificate") = as_python(std::move(from.certificate));
    made.attr("resolved") = from.resolved;
    return made;
}

py::object object(of_result, tf::curve_network&& from) {
    const auto paths = list_of(from.paths, [](tf::curve_path& one) {
        return py::make_tuple(as_array(std::move(one.points)), one.closed);
    });
    const auto numbers_of = [](const tf::curve_point& p) {
        return std::array<double, 3>{p.position.x, p.position.y, p.position.z};
    };
    return py::make_tuple(column(from.points, numbers_of), paths);
}

py::object object(of_result, tf::rounding_effects&& from) {
    return py::make_tuple(from.collapsed, from.meeting);
}

py::list packed_parts(std::vector<tf::packed_part>&& from, const held_meshes& parts) {
    py::list made;
    for (std::size_t i = 0; i < parts.size(); ++i)
        made.append(as_python(std::move(from[i]), *parts[i]));
    return made;
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
