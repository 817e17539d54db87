#include <libmesh/base/point_math.hpp>
#include <libmesh/base/stars.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/repair/fair_patch.hpp>
#include <libmesh/repair/fill_hole.hpp>
#include <libmesh/repair/fill_holes.hpp>
#include <libmesh/repair/open_rims.hpp>
#include <libmesh/repair/refined_patch.hpp>
#include <libmesh/repair/triangulate_rim.hpp>
#include <libmesh/topology/area.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Triangles from the rim to the mean of its points, which is new: there is always this way.
std::vector<face> cone_over(working_mesh& mesh, const open_rim& rim) {
    const double share = 1.0 / static_cast<double>(rim.points.size());
    point3 mean{0.0, 0.0, 0.0};
    for (const std::uint32_t p : rim.points)
        mean = base::plus(mean, base::scaled(mesh.points[p], share));
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(mean);
    std::vector<face> faces;
    for (std::size_t i = 0; i < rim.points.size(); ++i)
        faces.push_back({rim.points[i], rim.points[(i + 1) % rim.points.size()], middle});
    return faces;
}

/// How large the parts of a mesh are that holes are in.
class part_areas {
  public:
    explicit part_areas(const working_mesh& mesh)
        : part_of_(parts_by_edges(mesh)), areas_(part_of_.size(), 0.0) {
        for (std::uint32_t f = 0; f < part_of_.size(); ++f)
            areas_[part_of_[f]] += topology::area({mesh.points, {&mesh.faces[f], 1}});
    }

    /// A sheet has about the area of what closes it, a half of a ball twice as much. A flat solid
    /// without its top has as much as a sheet, but is all to one side of where that is missing.
    [[nodiscard]] bool is_sheet_without(const working_mesh& mesh, const open_rim& rim,
                                        const std::vector<face>& filling) {
        constexpr double most = 0.6;
        const std::uint32_t part = part_of_[rim.faces[0]];
        return topology::area({mesh.points, filling}) > most * areas_[part] &&
               !is_all_below(mesh, rim, part);
    }

  private:
    /// Whether the rim is plane, to the rounding of float32 or six digits, and the part lies below
    /// it, as seen from the side that the filling looks to, by more than rounding makes.
    [[nodiscard]] bool is_all_below(const working_mesh& mesh, const open_rim& rim,
                                    std::uint32_t part) {
        // Scaled, so that products are doubles whatever the unit.
        const point3 origin = mesh.points[rim.points[0]];
        double size = 0.0, largest = 0.0;
        for (const std::uint32_t p : rim.points)
            for (std::size_t k = 0; k < 3; ++k) {
                size = std::max(size, std::abs(mesh.points[p][k] - origin[k]));
                largest = std::max(largest, std::abs(mesh.points[p][k]));
            }
        if (!(size > 0.0) || !std::isfinite(size)) return false;
        const auto at = [&](std::uint32_t p) {
            const point3& from = mesh.points[p];
            return point3{(from.x - origin.x) / size, (from.y - origin.y) / size,
                          (from.z - origin.z) / size};
        };
        point3 normal{};
        for (std::size_t i = 0; i < rim.points.size(); ++i)
            normal = base::plus(normal, base::cross(at(rim.points[i]),
                                                    at(rim.points[(i + 1) % rim.points.size()])));
        const double length = std::sqrt(base::dot(normal, normal));
        if (!(length > 0.0)) return false;
        const auto height = [&](std::uint32_t p) { return base::dot(at(p), normal) / length; };
        const double rounding = 0x1p-21 * std::max(1.0, largest / size);
        if (std::ranges::any_of(
                rim.points, [&](std::uint32_t p) { return !(std::abs(height(p)) <= rounding); }))
            return false;
        double lowest = 0.0;
        for (const std::uint32_t f : faces_of(part))
            for (const std::uint32_t p : mesh.faces[f]) {
                if (!(height(p) <= rounding)) return false;
                lowest = std::min(lowest, height(p));
            }
        return lowest < -16.0 * rounding;
    }

    /// Found once for all of them, where it is first asked for.
    [[nodiscard]] std::span<const std::uint32_t> faces_of(std::uint32_t part) {
        if (by_part_.empty()) {
            by_part_.resize(part_of_.size());
            std::iota(by_part_.begin(), by_part_.end(), 0U);
            std::ranges::stable_sort(by_part_, {}, [&](std::uint32_t f) { return part_of_[f]; });
        }
        const auto part_of = [&](std::uint32_t f) { return part_of_[f]; };
        return {std::ranges::lower_bound(by_part_, part, {}, part_of),
                std::ranges::upper_bound(by_part_, part, {}, part_of)};
    }

    std::vector<std::uint32_t> part_of_;    ///< [F]
    std::vector<double> areas_;             ///< by part
    std::vector<std::uint32_t> by_part_{};  ///< faces, part by part
};

}  // namespace

filled_holes fill_holes(working_mesh& mesh, std::uint64_t largest, sheets_too sheets,
                        rim_edges rims) {
    filled_holes done;
    const directed_edges edges(mesh.faces);
    std::optional<base::stars> stars;  // of the mesh before the first hole was filled
    part_areas parts(mesh);
    for (const open_rim& rim : open_rims(mesh, rims)) {
        if (rim.points.size() > largest) continue;
        std::vector<face> faces = triangulate_rim(mesh, rim, edges);
        const bool is_cone = faces.empty();
        if (is_cone) faces = cone_over(mesh, rim);
        if (sheets == sheets_too::no && parts.is_sheet_without(mesh, rim, faces)) {
            ++done.sheets;
            continue;
        }
        if (!is_cone && is_to_be_fair(mesh, rim, faces)) {
            if (!stars) stars.emplace(mesh.points.size(), mesh.faces);
            const std::size_t first = mesh.points.size();
            faces = refined_patch(mesh, rim, faces, edges);
            make_fair(mesh, rim, faces, first, *stars);
        }
        done.all.push_back({static_cast<std::uint32_t>(mesh.faces.size()),
                            static_cast<std::uint32_t>(rim.points.size())});
        for (const face& f : faces) mesh.append(f, repair_result::none);
        ++done.holes;
        done.edges += rim.points.size();
        done.faces += faces.size();
    }
    return done;
}

filled_holes filled_holes::used(std::span<const std::uint8_t> is_used) const {
    filled_holes left;
    if (all.empty()) return left;
    for (std::uint32_t f = all.front().first_face; f < is_used.size(); ++f) {
        if (is_used[f] == 0) continue;
        ++left.faces;
        const filled_hole& own =
            *(std::ranges::upper_bound(all, f, {}, &filled_hole::first_face) - 1);
        if (!left.all.empty() && left.all.back().first_face == own.first_face) continue;
        left.all.push_back(own);
        left.edges += own.edges;
    }
    left.holes = left.all.size();
    return left;
}

}  // namespace treeform::detail::repair
