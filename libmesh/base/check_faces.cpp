#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/point_math.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform::detail::base {
namespace {

[[noreturn]] void refuse(const char* function, const std::string& why) {
    throw std::invalid_argument("treeform::" + std::string(function) + ": " + why);
}

}  // namespace

void check_faces(const char* function, std::size_t point_count, std::span<const face> faces) {
    if (faces.size() > std::numeric_limits<std::uint32_t>::max())
        refuse(function, "more than 2^32 - 1 faces");
    if (point_count > std::numeric_limits<std::uint32_t>::max()) return;  // all corners are points
    const auto points = static_cast<std::uint32_t>(point_count);
    const std::size_t bad = first_bad(faces.size(), [&](std::size_t i) {
        const auto& [a, b, c] = faces[i];
        return std::max(std::max(a, b), c) >= points;
    });
    if (bad == faces.size()) return;
    const std::uint32_t corner = *std::ranges::max_element(faces[bad]);
    refuse(function, "face " + std::to_string(bad) +
                         " has a corner out of range: " + std::to_string(corner) + ", of " +
                         std::to_string(points) + " points numbered from 0");
}

void check_finite_faces(const char* function, mesh_view mesh) {
    const std::size_t bad = first_bad(mesh.faces.size(), [&](std::size_t i) {
        const auto& [a, b, c] = mesh.faces[i];
        return !is_finite(mesh.points[a]) || !is_finite(mesh.points[b]) ||
               !is_finite(mesh.points[c]);
    });
    if (bad != mesh.faces.size())
        refuse(function, "face " + std::to_string(bad) + " has a corner that is not finite");
}

void refuse_cloud(const char* function, mesh_view mesh) {
    if (mesh.faces.empty() && !mesh.points.empty()) refuse(function, "the mesh is a point cloud");
}

}  // namespace treeform::detail::base
