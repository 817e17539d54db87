// Functions that are more than a single C++ call.
#include "bindings.hpp"

namespace binding {

tf::boolean_expression expression_of(const std::string& operation, const std::string& formula,
                                     const std::vector<std::string>& names, std::size_t count) {
    if (operation == "union") return tf::boolean_expression::union_of(count);
    if (operation == "intersection") return tf::boolean_expression::intersection_of(count);
    if (operation == "difference") return tf::boolean_expression::difference_of(count);
    if (operation == "symmetric_difference")
        return tf::boolean_expression::symmetric_difference_of(count);
    return names.empty() ? tf::boolean_expression(formula, count)
                         : tf::boolean_expression(formula, names);
}

void require_faces(const held_meshes& meshes, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < meshes.size(); ++i)
        require_faces(*meshes[i], names.empty() ? "operand " + std::to_string(i) : names[i]);
}

namespace {

py::object box(const std::array<double, 3>& low, const std::array<double, 3>& high) {
    const tf::box3 of{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    return mesh_object(of.mesh(), py::none(), py::none());
}

// ---- cuts ----

tf::oriented_plane plane_of(const std::array<double, 3>& at, const std::array<double, 3>& normal) {
    return {{at[0], at[1], at[2]}, {normal[0], normal[1], normal[2]}};
}

void write_section(const std::filesystem::path& path, const tf::section_result& section,
                   const std::string& format, const std::string& unit) {
    without_lock([&] { tf::write_section(path, section, format, unit); });
}

void write_isolines(const std::filesystem::path& path, const py::list& lines,
                    const array_of<double>& points, const std::array<double, 3>& normal,
                    const std::string& format, const std::string& unit) {
    tf::isolines_result all;
    all.lines = list_of(lines, [](py::handle line) {
        return tf::isoline{line.attr("level").cast<double>(),
                           line.attr("first_point").cast<std::size_t>(),
                           line.attr("point_count").cast<std::size_t>(),
                           line.attr("closed").cast<bool>(),
                           line.attr("oriented").cast<bool>(),
                           line.attr("length").cast<double>()};
    });
    const std::span<const tf::point3> given = rows_of<tf::point3>(points);
    all.points.assign(given.begin(), given.end());
    const tf::oriented_plane seen = plane_of({}, normal);
    without_lock([&] { tf::write_isolines(path, all, seen, format, unit); });
}

py::object transformed(const held_mesh& mesh, const array_of<double>& matrix) {
    const tf::transform<3> by = transform_of(matrix);
    auto points = run([&](const tf::progress_callback&) {
        return tf::transform_mesh({mesh.view().points, {}}, by).points;
    });
    return moved_mesh(std::move(points), mesh, by, py::none());
}

py::object concatenate(const held_meshes& meshes) {
    const carrying attributes(meshes);
    const std::vector<tf::mesh_view> views = list_of(meshes, &held_mesh::view);
    tf::mesh made = run([&](const tf::progress_callback&) { return tf::concatenate(views); });
    std::vector<tf::operand_element> faces, vertices;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        for (std::uint32_t f = 0; f < views[i].faces.size(); ++f) faces.push_back({i, f});
        for (std::uint32_t v = 0; v < views[i].points.size(); ++v) vertices.push_back({i, v});
    }
    const py::object data = attributes.to(made, faces, vertices);
    return mesh_object(std::move(made), py::none(), data);
}

// ---- repair ----

py::object join_equal_points(const held_mesh& mesh) {
    const carrying attributes({&mesh});
    std::vector<std::uint32_t> first, faces(mesh.view().faces.size());
    tf::mesh joined = run([&](const tf::progress_callback&) {
        if (!mesh.data().is_none())
            first = tf::find_equal_points(mesh.view().points).first_of_group;
        return tf::join_equal_points(mesh.view());
    });
    std::iota(faces.begin(), faces.end(), 0U);
    const py::object data = attributes.to(joined, faces, first);
    return mesh_object(std::move(joined), py::none(), data);
}

// ---- weld ----

/// Attributes of faces have a row for each polygon, as in a file.
tf::weld_result weld_file(tf::mesh_file& file, const tf::weld_options& options) {
    file.indexed = true;
    require_rows(file, 0);
    tf::file_weld_result made = tf::weld(file, options);
    file = std::move(made.file);
    return {std::exchange(file.mesh, {}), file.attributes,
            std::move(made.groups),       std::move(made.vertex_source),
            std::move(made.face_source),  made.statistics};
}

py::object weld(const held_mesh& mesh, tf::weld_options options, const ids_array& label) {
    options.label = rows_of<std::uint32_t>(label);
    const tf::mesh_view view = mesh.view();
    std::optional<tf::mesh_file> file;
    if (!mesh.data().is_none()) file = file_of(mesh);
    tf::weld_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return file                 ? weld_file(*file, options)
               : view.faces.empty() ? tf::weld(view.points, options)
                                    : tf::weld(mesh.ref(), options);
    });
    if (!file) return object(of_result{}, std::move(result), nullptr);
    const file_data kept(std::move(*file));
    return object(of_result{}, std::move(result), &kept);
}

// ---- nearness ----

struct numbered_hit {
    double t;
    std::uint32_t ray, face;
};

py::tuple raycast_all(const held_mesh& mesh, const points_array& origins,
                      const points_array& directions, double t_min, double t_max) {
    const rays all(origins, directions, t_min, t_max);
    std::vector<numbered_hit> hits;
    run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        const tf::answer_lists<tf::mesh_hit> found =
            tf::raycast_all(mesh.prepared(), all.piece(begin, end));
        for (std::size_t i = 0; i + 1 < found.begin.size(); ++i)
            for (std::size_t h = found.begin[i]; h < found.begin[i + 1]; ++h)
                hits.push_back({finite(found.answers[h].t, i),
                                static_cast<std::uint32_t>(begin + i), found.answers[h].face});
    });
    return py::make_tuple(column(hits, &numbered_hit::t), column(hits, &numbered_hit::ray),
                          column(hits, &numbered_hit::face));
}

// ---- assembly ----

/// [P] the positions of both meshes; one of the two may be the same for all.
std::vector<tf::mesh_pair_options> positions_of(const array_of<double>& transform_a,
                                                const array_of<double>& transform_b) {
    const auto a = transforms_of(transform_a), b = transforms_of(transform_b);
    if (a.size() != b.size() && a.size() != 1 && b.size() != 1)
        throw std::invalid_argument("treeform: " + std::to_string(a.size()) + " positions of a, " +
                                    std::to_string(b.size()) + " of b");
    std::vector<tf::mesh_pair_options> all(a.size() == 1 ? b.size() : a.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {.transform_a = a[a.size() == 1 ? 0 : i], .transform_b = b[b.size() == 1 ? 0 : i]};
    return all;
}

/// A piece of the positions.
std::span<const tf::mesh_pair_options> some_of(const std::vector<tf::mesh_pair_options>& all,
                                               std::size_t begin, std::size_t end) {
    return std::span(all).subspan(begin, end - begin);
}

py::array intersects(const held_mesh& a, const held_mesh& b, const array_of<double>& transform_a,
                     const array_of<double>& transform_b) {
    const auto all = positions_of(transform_a, transform_b);
    const bool one = all.size() == 1;
    const tf::mesh_ref x = one ? a.ref() : a.prepared(), y = one ? b.ref() : b.prepared();
    const auto find = [&](std::size_t begin, std::size_t end) {
        return tf::intersects(x, y, some_of(all, begin, end));
    };
    return column(in_pieces(all.size(), find), [](bool meet) { return meet; });
}

py::array distance(const held_mesh& a, const held_mesh& b, const array_of<double>& transform_a,
                   const array_of<double>& transform_b, double radius) {
    auto all = positions_of(transform_a, transform_b);
    for (tf::mesh_pair_options& one : all) one.radius = radius;
    return as_array(in_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
        return tf::distance(a.prepared(), b.prepared(), some_of(all, begin, end));
    }));
}

}  // namespace

void add_verbs(py::module_& module) {
    py::class_<tf::section_result>(module, "SectionData")
        .def("__len__",
             [](const tf::section_result& all) -> std::size_t { return all.loops.size(); })
        .def("loops", [](const tf::section_result& all, std::size_t layer) {
            const auto& of = all.layers.at(layer);
            const auto first = all.loops.begin() + of.first_loop;
            return as_python(std::vector(first, first + of.loop_count), all);
        });  // -> list[SectionLoop]
    add_job(module, "write_section", &write_section, job_kind::writes);
    add_job(module, "write_isolines", &write_isolines, job_kind::writes);
    add_job(module, "concatenate", &concatenate);  // -> Mesh
    module.def("box", &box);                       // -> Mesh
    add_job(module, "transformed", &transformed);
    add_job(module, "join_equal_points", &join_equal_points);
    add_job(module, "weld", &weld);
    add_job(module, "raycast_all", &raycast_all);  // -> tuple[Floats, Ids, Ids]
    module.attr("RELATIONS") = py::cast(words_of<tf::mesh_relation>::all);  // -> list[str]
    add_job(module, "intersects", &intersects);
    add_job(module, "distance", &distance);
}

}  // namespace binding
