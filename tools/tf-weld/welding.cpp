#include "tools/tf-weld/welding.hpp"

#include "tools/tf-weld/properties.hpp"
#include <libmesh/base/finite.hpp>
#include <treeform/mesh/weld_points.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tools {
namespace {

/// In two passes through memory: g++ 12 takes a cast to float and back for no operation at times.
std::vector<tf::point3> in_single(tf::points_view points) {
    std::vector<std::array<float, 3>> single;
    single.reserve(points.size());
    for (const tf::point3& p : points)
        single.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    std::vector<tf::point3> rounded;
    rounded.reserve(points.size());
    for (const auto& p : single) rounded.push_back({p[0], p[1], p[2]});
    return rounded;
}

tf::mesh_weld_options library_options(job& work, const welding& w, const weld_settings& settings,
                                      std::string_view step) {
    tf::mesh_weld_options options;
    options.points.tolerance = w.tolerance;
    options.points.rule = settings.rule;
    options.points.progress = work.progress(step);
    options.conditions = w.conditions;
    options.keep = settings.keep;
    options.keep_by = settings.keep_by;
    options.only_borders = settings.borders;
    options.keep_manifold = settings.keep_manifold;
    options.keep_collapsed = settings.keep_degenerate;
    return options;
}

/// Corners of a soup that are equal are one vertex before anything else is asked: only then has it
/// edges, open or not.
tf::mesh join_corners(const tf::mesh& soup, const tf::point_groups& equal) {
    tf::mesh joined;
    joined.points.reserve(equal.first_of_group.size());
    for (const std::uint32_t p : equal.first_of_group) joined.points.push_back(soup.points[p]);
    joined.faces = soup.faces;
    for (tf::face& corners : joined.faces)
        for (std::uint32_t& corner : corners) corner = equal.group_of_point[corner];
    return joined;
}

void weld_soup(const tf::mesh_file& file, const tf::mesh_weld_options& options, welding& w) {
    const tf::point_groups equal = tf::weld_points(file.mesh.points, {});
    w.result = tf::weld_mesh(join_corners(file.mesh, equal), file.attributes, options);
    tf::point_groups& groups = w.result.groups;
    if (groups.stopped) return;
    std::vector<std::uint32_t> group_of_corner(w.points);
    for (std::size_t c = 0; c < w.points; ++c)
        group_of_corner[c] = groups.group_of_point[equal.group_of_point[c]];
    groups.group_of_point = std::move(group_of_corner);
    for (auto* points : {&w.result.point_of_group, &groups.first_of_group})
        for (std::uint32_t& p : *points) p = equal.first_of_group[p];
}

/// What must hold of any result; a failure is a bug.
void check_counts(const welding& w, const weld_settings& settings) {
    const tf::mesh_weld_result& r = w.result;
    std::uint64_t kept = 0;
    for (std::uint32_t p = 0; p < w.points; ++p) {
        if (r.groups.group_of_point[p] >= w.distinct())
            throw std::logic_error("a point belongs to no group");
        kept += w.keeps(p) ? 1U : 0U;
    }
    if (r.groups.group_of_point.size() != w.points || kept != w.distinct())
        throw std::logic_error("points in are not points kept and points removed");
    const std::uint64_t dropped = settings.keep_degenerate ? 0 : r.collapsed + r.degenerate;
    if (r.mesh.faces.size() + dropped != w.triangles || r.face_of_new.size() != r.mesh.faces.size())
        throw std::logic_error("faces in are not faces kept and faces dropped");
}

}  // namespace

std::uint64_t welding::groups() const {
    if (counted) return counted->groups;
    std::vector<std::uint8_t> members(distinct(), 0);
    std::uint64_t count = 0;
    for (const std::uint32_t group : result.groups.group_of_point)
        if (members[group] < 2 && ++members[group] == 2) ++count;
    return count;
}

welding weld(job& work, tf::mesh_file& file, const weld_settings& settings) {
    const job::timer timing = work.time("weld");
    welding w;
    w.points = file.mesh.points.size();
    w.polygons = file.stored_faces;
    w.triangles = file.mesh.faces.size();
    if (w.points == 0) throw failure(bad_input, "no-points", work.name + ": no points");
    if (settings.borders && w.triangles == 0)
        throw failure(bad_input, "no-faces", work.name + ": no faces, so --borders finds no edge");
    w.conditions = conditions_of(file, settings);
    check_keep(file, settings);
    w.box = tf::bounding_box(file.mesh.points);
    w.tolerance = settings.tolerance.used(w.box ? tf::diagonal(*w.box) : 0.0);
    w.non_finite = static_cast<std::uint64_t>(
        std::count_if(file.mesh.points.begin(), file.mesh.points.end(),
                      [](const tf::point3& p) { return !tf::detail::base::is_finite(p); }));
    w.polygon_of_triangle = file.stored_face;
    tf::split_polygons(file);

    // Joining a soup's corners would make the edges that --keep-manifold is to prevent.
    const bool soup = !file.indexed && !settings.keep_manifold &&
                      tf::find_element(file.attributes, "vertex") == nullptr;
    const tf::mesh_weld_options options = library_options(work, w, settings, "weld");
    if (soup)
        weld_soup(file, options, w);
    else
        w.result = tf::weld_mesh(file.mesh, file.attributes, options);
    work.out.end_progress();
    work.keeper.check();
    if (w.result.groups.stopped) throw failure(stopped, "stopped", work.name + ": stopped");
    check_counts(w, settings);
    return w;
}

std::optional<std::uint64_t> still_within(job& work, const tf::mesh_file& welded, const welding& w,
                                          const weld_settings& settings, tf::precision written_as) {
    if (settings.borders || settings.keep_manifold) return std::nullopt;
    std::vector<tf::point3> rounded;
    tf::points_view points = welded.mesh.points;
    if (written_as == tf::precision::float32 && !tf::fits_single(points)) {
        rounded = in_single(points);
        points = rounded;
    } else if (settings.keep == tf::weld_keep::first) {
        return 0;  // kept points are as they were, and the rule leaves none within the tolerance
    }
    tf::mesh_weld_options options = library_options(work, w, settings, "check");
    options.keep = tf::weld_keep::first;
    tf::attributes properties;
    if (const tf::element* vertices = tf::find_element(welded.attributes, "vertex"))
        if (!w.conditions.empty()) properties.elements.push_back(*vertices);
    const auto again = tf::weld_mesh({points, {}}, properties, options);
    work.out.end_progress();
    work.keeper.check();
    return points.size() - again.mesh.points.size();
}

}  // namespace tools
