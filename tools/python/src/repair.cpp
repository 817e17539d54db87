#include "bindings.hpp"
#include "carrying.hpp"
#include "held_mesh.hpp"
#include "job.hpp"
#include "words.hpp"
#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/convex_hull.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/rounding.hpp>
#include <treeform/mesh/wrap.hpp>

#include <pybind11/stl.h>

#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace binding {
namespace {

constexpr words<3> mode_words{"split", "outer", "remove"};
constexpr words<4> rule_words{"automatic", "nonzero", "odd", "positive"};

/// Mesh, sources and certificate of a result.
template <class Result>
py::dict made_of(Result&& result, const carrying& attributes) {
    py::dict made;
    made["data"] = py::none();
    if constexpr (requires { result.face_source; })
        made["data"] = attributes.to(result.mesh, result.face_source, result.vertex_source);
    made["points"] = as_array(std::move(result.mesh.points));
    made["faces"] = as_array(std::move(result.mesh.faces));
    if constexpr (requires { result.face_source; }) {
        made["face_source"] = as_array(std::move(result.face_source));
        made["vertex_source"] = as_array(std::move(result.vertex_source));
    }
    made["certificate"] = std::move(result.certificate);
    return made;
}

py::dict resolve(const held_mesh& mesh, const std::string& mode, const std::string& inside,
                 const std::string& precision, double max_displacement, bool keep_cuts,
                 bool touching, double max_loss) {
    const carrying attributes({&mesh});
    tf::resolve_options options{.inside = choice<tf::fill_rule>("inside", fill_rule_words, inside),
                                .precision = precision_of(precision),
                                .max_displacement = max_displacement,
                                .keep_cuts = keep_cuts || attributes.mixes(),
                                .touching = touching,
                                .max_loss = max_loss};
    const auto how = choice<tf::resolve_mode>("mode", mode_words, mode);
    tf::resolve_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::resolve_self_intersections(mesh.view(), how, options);
    });
    py::dict statistics;
    statistics["removed"] = result.statistics.removed;
    statistics["covered"] = result.statistics.covered;
    statistics["filled"] = result.statistics.filled;
    statistics["left_open"] = result.statistics.left_open;
    statistics["exact_faces"] = result.statistics.exact_faces;
    statistics["split_vertices"] = result.statistics.split_vertices;
    statistics["vanished_components"] = result.vanished_components;
    py::dict made = made_of(std::move(result), attributes);
    made["statistics"] = statistics;
    return made;
}

py::dict steps_of(const tf::repair_statistics& s) {
    py::dict made;
    made["tetrahedra"] = s.tetrahedra;
    made["degenerate"] = s.degenerate;
    made["repeated"] = s.repeated;
    made["closed_edges"] = s.closed_edges;
    made["split_edges"] = s.split_edges;
    made["gap"] = s.gap;
    made["widest"] = s.widest;
    made["flipped"] = s.flipped;
    made["turned"] = s.turned;
    made["strays"] = s.strays;
    made["holes"] = s.holes;
    made["hole_edges"] = s.hole_edges;
    made["filled"] = s.filled;
    made["sheets"] = s.sheets;
    made["open_edges"] = s.open_edges;
    made["resolved"] = s.resolved;
    made["pairs"] = s.pairs;
    made["labeled_cells"] = s.labeled_cells;
    made["dropped_area"] = s.dropped_area;
    made["turned_area"] = s.turned_area;
    made["removed"] = s.removed;
    made["split_vertices"] = s.split_vertices;
    made["detached"] = s.detached;
    made["touching"] = s.touching;
    made["vanished_components"] = s.vanished_components;
    made["dropped_shells"] = s.dropped_shells;
    made["volume_before"] = s.volume_before;
    made["volume_after"] = s.volume_after;
    made["area_before"] = s.area_before;
    made["area_after"] = s.area_after;
    made["area_lost"] = s.area_lost;
    return made;
}

/// The steps that a caller names.
void set_steps(tf::repair_options& options, const std::vector<std::string>& steps) {
    const std::array<std::pair<const char*, bool*>, 5> all{{{"join", &options.join},
                                                            {"orient", &options.orient},
                                                            {"fill", &options.fill},
                                                            {"resolve", &options.resolve},
                                                            {"detach", &options.detach}}};
    constexpr words<5> names{"join", "orient", "fill", "resolve", "detach"};
    for (const auto& [name, step] : all) *step = false;
    for (const std::string& name : steps)
        *all[choice<std::size_t>("steps", names, name)].second = true;
}

py::dict repair(const held_mesh& mesh, const std::vector<std::string>& steps,
                std::optional<double> gap, std::optional<std::uint64_t> largest_hole, double strays,
                const std::string& inside, double max_loss, bool sheet,
                const std::string& precision, double max_displacement, bool keep_cuts) {
    const carrying attributes({&mesh});
    tf::repair_options options{.gap = gap,
                               .strays = strays,
                               .inside = choice<tf::repair_rule>("inside", rule_words, inside),
                               .max_loss = max_loss,
                               .sheet = sheet,
                               .precision = precision_of(precision),
                               .max_displacement = max_displacement,
                               .keep_cuts = keep_cuts || attributes.mixes()};
    set_steps(options, steps);
    if (largest_hole) options.largest_hole = *largest_hole;
    tf::repair_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::repair(mesh.view(), options);
    });
    const py::dict done = steps_of(result.statistics);
    const py::array is_left = column(result.is_left, [](std::uint8_t left) { return left; });
    py::dict made = made_of(std::move(result), attributes);
    made["steps"] = done;
    made["is_left"] = is_left.attr("view")("bool");
    return made;
}

py::dict wrap(const held_mesh& mesh, double size, std::optional<double> offset,
              const std::string& precision) {
    tf::wrap_options options{.offset = offset, .precision = precision_of(precision)};
    tf::wrap_result result = run([&](const tf::progress_callback& report) {
        options.progress = report;
        return tf::wrap(mesh.view(), size, options);
    });
    py::dict statistics;
    statistics["size"] = result.statistics.size;
    statistics["offset"] = result.statistics.offset;
    statistics["area"] = result.statistics.area;
    statistics["points"] = result.statistics.points;
    statistics["tetrahedra"] = result.statistics.tetrahedra;
    statistics["filled"] = result.statistics.filled;
    py::dict made = made_of(std::move(result), carrying(held_meshes{}));
    made["statistics"] = statistics;
    return made;
}

py::dict convex_hull(const points_array& points) {
    const tf::points_view all = points_of(points);
    tf::convex_hull_result hull =
        run([&](const tf::progress_callback& report) { return tf::convex_hull(all, report); });
    py::dict made;
    made["dimension"] = hull.dimension;
    made["first_face"] = column(hull.sides, [](const tf::hull_side& s) { return s.first_face; });
    made["areas"] = column(hull.sides, [](const tf::hull_side& s) { return s.area; });
    made["normals"] = column(hull.sides, [](const tf::hull_side& s) {
        return std::array<double, 3>{s.normal.x, s.normal.y, s.normal.z};
    });
    made["faces"] = as_array(std::move(hull.faces));
    return made;
}

py::array rounded(const points_array& points, const std::string& precision) {
    const tf::precision to = precision_of(precision);
    return as_array(
        run([&](const tf::progress_callback&) { return tf::rounded(points_of(points), to); }));
}

py::tuple find_rounding_defects(const held_mesh& mesh, const points_array& placed) {
    const tf::points_view to = points_of(placed);
    const tf::rounding_defects found = run([&](const tf::progress_callback& report) {
        return tf::find_rounding_defects(mesh.view(), to, report);
    });
    return py::make_tuple(found.collapsed, found.meeting);
}

py::tuple join_equal_points(const held_mesh& mesh) {
    const carrying attributes({&mesh});
    std::vector<std::uint32_t> first, faces(mesh.view().faces.size());
    tf::mesh joined = run([&](const tf::progress_callback&) {
        if (!mesh.data().is_none()) first = tf::find_equal_points(mesh.view().points).first_of_new;
        return tf::join_equal_points(mesh.view());
    });
    std::iota(faces.begin(), faces.end(), 0U);
    const py::object data = attributes.to(joined, faces, first);
    return py::make_tuple(as_array(std::move(joined.points)), as_array(std::move(joined.faces)),
                          data);
}

}  // namespace

void add_repair(py::module_& module) {
    module.def("resolve", &resolve);
    module.def("repair", &repair);
    module.def("wrap", &wrap);
    module.def("convex_hull", &convex_hull);
    module.def("rounded", &rounded);
    module.def("find_rounding_defects", &find_rounding_defects);
    module.def("join_equal_points", &join_equal_points);
}

}  // namespace binding
