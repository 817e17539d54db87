#include "tools/tf-selfintersect/search.hpp"

#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <utility>

namespace tools {
namespace {

tf::usable_options part_options_of(const job& work, const tf::mesh_file& file,
                                   const search_settings& settings, double tolerance) {
    const auto by_format =
        file.indexed ? tf::vertex_identity::by_index : tf::vertex_identity::by_coordinates;
    return {.vertices = settings.vertices.value_or(by_format),
            .tolerance = tolerance,
            .box = settings.box,
            .details = settings.between || settings.within || work.options.detailed()};
}

tf::face_pair_options search_options(job& work, const findings& result,
                                     const search_settings& settings) {
    return {.vertices = tf::vertex_identity::by_index,  // joined as asked
            .first_only = settings.first,
            .kinds = settings.looked_for(),
            .component_of_face = result.part.component,
            .between = settings.between,
            .within = settings.within,
            .progress = work.progress("pairs")};
}

}  // namespace

tf::pair_kinds search_settings::counted() const {
    using kind = tf::pair_kind;
    tf::pair_kinds kinds = tf::pair_kinds::all;
    if (no_coplanar) kinds = kinds - kind::overlap - kind::fold - kind::duplicate;
    return touching ? kinds : kinds - kind::touching - kind::degenerate;
}

tf::pair_kinds search_settings::looked_for() const {
    return first ? counted() : counted() + tf::pair_kind::degenerate;
}

std::set<std::uint32_t> findings::components_of(const tf::intersection_region& region) const {
    std::set<std::uint32_t> components;
    if (!part.component.empty())
        for (const std::uint32_t f : region.faces) components.insert(part.component[f]);
    return components;
}

findings search(job& work, tf::mesh_file& file, const search_settings& settings, bool keep_mesh) {
    findings result;
    result.faces_stored = file.stored_faces;
    result.triangles = file.mesh.faces.size();
    result.points_stored = file.mesh.points.size();
    if (file.mesh.faces.empty()) throw no_triangles(work.name, 0, file.mesh.points.size());
    result.box = tf::bounding_box(file.mesh.points);
    result.tolerance_used = settings.tolerance.used(result.diagonal());
    {
        const job::timer timing = work.time("prepare");
        result.part =
            tf::usable_faces(keep_mesh ? file.mesh : std::move(file.mesh), file.face_of_triangle,
                             part_options_of(work, file, settings, result.tolerance_used));
        work.warn_of_non_finite(result.part.non_finite, "face", "faces");
        if (result.part.non_finite == result.triangles)
            throw no_triangles(work.name, result.triangles, result.points_stored);
        work.keeper.check();
    }
    const tf::mesh& mesh = result.part.mesh;
    result.searched = mesh.faces.size();
    result.found = tf::self_intersections(mesh, search_options(work, result, settings));
    work.call_ended();
    work.seconds["tree"] += result.found.tree_seconds;
    work.seconds["pairs"] += result.found.pair_seconds;
    group_findings(work, result, settings);
    return result;
}

void group_findings(job& work, findings& result, const search_settings& settings) {
    const tf::mesh& mesh = result.part.mesh;
    std::erase_if(result.found.pairs, [&](const tf::face_pair& pair) {
        return !settings.counted().contains(pair.kind);
    });
    const job::timer timing = work.time("regions");
    result.regions = tf::group_pairs(mesh, result.found.pairs);
    result.marks = tf::face_marks(mesh.faces.size(), result.found.pairs, result.regions);
}

void hint_at_near_points(job& work, const findings& result) {
    constexpr std::size_t most = 1'000'000;
    constexpr std::array<const char*, 3> steps{"0.0001%", "0.001%", "0.01%"};
    const tf::mesh& mesh = result.part.mesh;
    const bool in_tiles = result.searched > mesh.faces.size();
    if (!result.box || result.tolerance_used > 0.0 || in_tiles || mesh.points.size() > most) return;
    std::array<double, steps.size()> lengths{};
    for (std::size_t i = 0; i < steps.size(); ++i)
        lengths[i] = parse_distance("-t", steps[i]).used(result.diagonal());
    const auto closing = tf::closing_tolerance(mesh, lengths);
    const std::size_t step = closing.value_or(0);
    if (const auto near = tf::count_nearly_equal(mesh.points, lengths[step]); near > 0)
        work.warn("near-corners",
                  counted(near, "vertex lies", "vertices lie") + " within " + brief(lengths[step]) +
                      " of another one, but not at the same coordinates; -t " + steps[step] +
                      (closing ? " joins them and closes the surface" : " joins them"));
}

}  // namespace tools
