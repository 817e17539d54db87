#include "bindings.hpp"

namespace binding {
namespace {

/// Names of parts are carried over only from a single operand.
bool has_values(const tf::attributes& all, bool single) {
    return (single && !all.parts.empty()) || !all.corners.texture_of_corner.empty() ||
           !all.corners.normal_of_corner.empty() ||
           std::ranges::any_of(all.elements, [](const tf::element& e) {
               return (e.name == "vertex" || e.name == "face") &&
                      std::ranges::any_of(e.columns, [](const tf::column& c) {
                          return c.role == tf::column_role::data;
                      });
           });
}

const file_data* data_of(const held_mesh& mesh, bool single) {
    if (mesh.data().is_none()) return nullptr;
    const auto& data = mesh.data().cast<const file_data&>();
    return has_values(data.file().attributes, single) ? &data : nullptr;
}

}  // namespace

tf::mesh_file file_of(const held_mesh& mesh) {
    std::optional<file_data> data;
    if (!mesh.data().is_none()) data = mesh.data().cast<const file_data&>();
    tf::mesh_file file;
    without_lock([&] {
        const auto [points, faces] = mesh.view();
        if (data) file = data->file();
        file.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
        if (file.face_of_triangle.empty()) file.stored_faces = faces.size();
    });
    return file;
}

py::tuple turned_over(const held_mesh& body, const tf::transform<3>& by) {
    const bool bare = body.data().is_none();
    if (bare && !by.mirrors()) return py::make_tuple(body.faces(), py::none());
    file_data copy = bare ? file_data() : body.data().cast<const file_data&>();
    tf::mesh_file& file = copy.own();
    const auto faces = body.view().faces;
    file.mesh = {{}, {faces.begin(), faces.end()}};
    file.move(by);
    py::array there = as_array(std::move(file.mesh.faces));
    file.mesh = {};
    return py::make_tuple(std::move(there), bare ? py::none() : py::cast(std::move(copy)));
}

void require_rows(const tf::mesh_file& file, std::size_t operand) {
    const std::size_t triangles = file.mesh.faces.size();
    const auto refuse = [&](const std::string& what) {
        throw std::invalid_argument("operand " + std::to_string(operand) + ": attributes: " + what);
    };
    if (!file.face_of_triangle.empty() && file.face_of_triangle.size() != triangles)
        refuse("face_of_triangle is for " + std::to_string(file.face_of_triangle.size()) +
               " faces; there are " + std::to_string(triangles));
    const std::size_t faces =
        file.face_of_triangle.empty() ? triangles : std::size_t{file.face_of_triangle.back()} + 1;
    for (const tf::element& e : file.attributes.elements) {
        if (e.name != "vertex" && e.name != "face") continue;
        const std::size_t rows = e.name == "face" ? faces : file.mesh.points.size();
        if (e.rows != rows)
            refuse(e.name + " has " + std::to_string(e.rows) + " rows; there are " +
                   std::to_string(rows));
    }
    if (const std::string fault = file.attributes.corners.fault(triangles); !fault.empty())
        refuse(fault);
}

carrying::carrying(const held_meshes& operands) {
    const bool single = operands.size() == 1;
    if (std::ranges::all_of(operands,
                            [=](const held_mesh* m) { return data_of(*m, single) == nullptr; }))
        return;
    for (const held_mesh* one : operands) {
        tf::mesh_file& file = files_.emplace_back();
        if (const file_data* data = data_of(*one, single)) file = data->file();
        const auto [points, faces] = one->view();
        file.mesh = {{points.begin(), points.end()}, {faces.begin(), faces.end()}};
        require_rows(file, files_.size() - 1);
    }
    sources_ = list_of(files_, [](const tf::mesh_file& file) {
        return tf::attribute_source{&file, {}};
    });
}

tf::simplify_result carrying::simplify(const tf::mesh_ref& mesh, double max_distance,
                                       std::span<const std::uint32_t> face_groups,
                                       tf::simplify_options options) const {
    std::vector<std::uint32_t> corner_groups;
    if (!sources_.all().empty()) corner_groups = sources_.corner_groups();
    options.face_groups = face_groups;
    options.corner_groups = corner_groups;
    return tf::simplify(mesh, max_distance, options);
}

template <class Carry>
py::object carrying::carried(const tf::mesh& made, Carry&& carry) const {
    if (sources_.all().empty()) return py::none();
    tf::mesh_file result;
    without_lock([&] {
        result.mesh = made;
        carry(result);
        tools::warn_of_materials(result, sources_);
        result.mesh = {};
    });
    return py::cast(file_data(std::move(result)));
}

py::object carrying::to(const tf::mesh& made, std::span<const tf::operand_element> face_source,
                        std::span<const tf::operand_element> vertex_source,
                        std::span<const tf::operand_element> face_of_cut_vertex) const {
    return carried(made, [&](tf::mesh_file& file) {
        sources_.transfer(file, face_source, vertex_source, face_of_cut_vertex);
    });
}

py::object carrying::to(const tf::mesh& made, std::span<const std::uint32_t> face_source,
                        std::span<const std::uint32_t> vertex_source,
                        std::span<const std::uint32_t> face_of_new_vertex,
                        std::span<const std::uint32_t> corner_source,
                        std::span<const std::uint32_t> cap) const {
    return carried(made, [&](tf::mesh_file& file) {
        sources_.transfer(file, face_source, vertex_source, face_of_new_vertex, corner_source);
        if (!cap.empty()) sources_.all().front().texture_caps(file, cap);
    });
}

}  // namespace binding
