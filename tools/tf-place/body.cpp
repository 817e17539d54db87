#include "tools/tf-place/body.hpp"

#include "tools/common/console.hpp"
#include <libmesh/detail/nearest_float.hpp>
#include <libmesh/face_tree.hpp>
#include <libmesh/select_faces.hpp>
#include <libmesh/validate.hpp>
#include <libmesh/weld/equal_points.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <utility>

namespace tools {
namespace {

bool finite(const tf::point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// The numbers of the faces that can be computed with.
std::vector<std::uint32_t> usable_faces(const tf::mesh& mesh, std::uint64_t& left_out) {
    const tf::mesh_defects defects = tf::find_defects(mesh);
    std::vector<std::uint32_t> unusable;
    std::merge(defects.nonfinite_faces.begin(), defects.nonfinite_faces.end(),
               defects.out_of_range_faces.begin(), defects.out_of_range_faces.end(),
               std::back_inserter(unusable));
    left_out = unusable.size();
    std::vector<std::uint32_t> all(mesh.faces.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> usable;
    std::set_difference(all.begin(), all.end(), unusable.begin(), unusable.end(),
                        std::back_inserter(usable));
    return usable;
}

}  // namespace

const tf::tree<3>& body::faces() {
    if (!tree) tree = std::make_unique<tf::tree<3>>(tf::face_tree(mesh));
    return *tree;
}

std::string body::name() const {
    return path == "-" ? "stdin" : std::filesystem::path(path).filename().string();
}

body make_body(job& work, const std::string& path, tf::mesh_file file, bool cloud_allowed) {
    body b;
    b.path = path;
    b.file = std::move(file);
    const auto timing = work.time("prepare");
    std::vector<std::uint32_t> usable = usable_faces(b.file.mesh, b.non_finite);
    if (b.non_finite > 0)
        work.warn("non-finite", path + ": " + counted(b.non_finite, "face", "faces") +
                                    " with a NaN or infinite coordinate left out");
    b.mesh = tf::join_equal_points(tf::select_faces(b.file.mesh, usable));
    if (usable.size() < b.file.mesh.faces.size()) b.triangle_of_face = std::move(usable);
    if (b.mesh.faces.empty() && b.file.mesh.faces.empty() && cloud_allowed)
        std::copy_if(b.file.mesh.points.begin(), b.file.mesh.points.end(),
                     std::back_inserter(b.mesh.points), finite);
    if (b.mesh.points.empty())
        throw failure(bad_input, "no-triangles",
                      path + ": no triangle with finite coordinates (" +
                          counted(b.file.mesh.points.size(), "point", "points") + ")");
    b.box = tf::bounding_box(b.mesh.points);
    return b;
}

void take_places(body& b, const std::vector<tf::point3>& placed, const tf::point3& offset,
                 bool to_single) {
    auto& points = b.file.mesh.points;
    const bool cloud = b.mesh.faces.empty();
    std::size_t next = 0;
    for (tf::point3& p : points) {
        if (cloud && finite(p)) {
            p = placed[next++];
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] += offset[k];
            if (to_single) p[k] = tf::detail::nearest_float(p[k]);
        }
    }
    for (std::uint32_t f = 0; f < b.mesh.faces.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            points[b.file.mesh.faces[b.triangle(f)][i]] = placed[b.mesh.faces[f][i]];
}

void round_to_single(tf::mesh_file& file) {
    for (tf::point3& p : file.mesh.points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = tf::detail::nearest_float(p[k]);
}

}  // namespace tools
