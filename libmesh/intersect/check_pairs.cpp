#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/view_axis.hpp>
#include <libmesh/intersect/check_pairs.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace treeform::detail::intersect {
namespace {

/// What is wrong with a face; empty when nothing is.
std::string fault_of(mesh_view mesh, std::uint32_t f, bool need_area) {
    if (f >= mesh.faces.size()) return "which is out of range";
    for (const std::uint32_t corner : mesh.faces[f]) {
        if (corner >= mesh.points.size()) return "which has a corner that is out of range";
        if (!base::is_finite(mesh.points[corner])) return "which has a corner that is not finite";
    }
    if (need_area && !geometry::find_view_axis(base::triangle_of(mesh, f), nullptr))
        return "which has no area";
    return {};
}

}  // namespace

void check_pairs(const char* function, mesh_view mesh, std::span<const face_pair> pairs,
                 bool need_area) {
    constexpr std::size_t grain = std::size_t{1} << 7;
    const auto fault = [&](const face_pair& pair, std::uint32_t f) {
        return fault_of(mesh, f, need_area && pair.kind != pair_kind::degenerate);
    };
    const auto is_bad = [&](std::size_t i) {
        return !fault(pairs[i], pairs[i].a).empty() || !fault(pairs[i], pairs[i].b).empty();
    };
    const std::size_t bad = base::first_bad(pairs.size(), is_bad, grain);
    for (std::size_t i = bad; i < std::min(bad + 1, pairs.size()); ++i)
        for (const std::uint32_t f : {pairs[i].a, pairs[i].b})
            if (const std::string why = fault(pairs[i], f); !why.empty())
                throw std::invalid_argument("treeform::" + std::string(function) + ": pair " +
                                            std::to_string(i) + " has face " + std::to_string(f) +
                                            ", " + why);
}

}  // namespace treeform::detail::intersect
