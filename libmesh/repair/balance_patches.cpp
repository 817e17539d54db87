#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/balance_patches.hpp>
#include <libmesh/repair/edge_parts.hpp>
#include <libmesh/weld/edge_uses.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace treeform::detail::repair {
namespace {

/// Patches, and how often each runs along the edges of more than two faces.
class patch_balance {
  public:
    explicit patch_balance(const working_mesh& mesh) : patch_of_(patches(mesh)) {
        const weld::edge_uses edges(mesh.points.size(), mesh.faces,
                                    weld::repeated_corners::left_out);
        std::vector<std::vector<shared_edge>> found(edges.chunks());
        edges.for_each([&](const weld::used_edge& edge, std::size_t chunk) {
            if (edge.uses.size() <= 2) return;
            shared_edge& e = found[chunk].emplace_back();
            const point3 along = base::minus(mesh.points[edge.high], mesh.points[edge.low]);
            e.length = std::sqrt(base::dot(along, along));
            for (std::size_t i = 0; i < edge.uses.size(); ++i) {
                const std::uint32_t f = edge.face(i);
                e.ways[patch_of_[f]] += runs_along(mesh.faces[f], edge.low, edge.high) ? 1 : -1;
            }
        });
        for (const auto& part : found)
            for (const shared_edge& e : part) {
                for (const auto& [patch, way] : e.ways) edges_of_[patch].push_back(edges_.size());
                edges_.push_back(e);
            }
        for (const auto& [patch, list] : edges_of_) look_at(patch);
    }

    /// [F] by patch, 1 where it is to be turned.
    std::vector<std::uint8_t> run() {
        std::vector<std::uint8_t> is_turned(patch_of_.size(), 0);
        while (!queue_.empty()) {  // ends, since the sum falls each time
            const std::uint32_t patch = queue_.begin()->second;
            is_turned[patch] ^= 1U;
            std::set<std::uint32_t> changed;
            for (const std::size_t e : edges_of_[patch]) {
                edges_[e].ways[patch] *= -1;
                for (const auto& [other, way] : edges_[e].ways) changed.insert(other);
            }
            for (const std::uint32_t other : changed) look_at(other);
        }
        for (std::size_t f = 0; f < patch_of_.size(); ++f) is_turned[f] = is_turned[patch_of_[f]];
        return is_turned;
    }

  private:
    struct shared_edge {
        double length = 0.0;
        std::map<std::uint32_t, int> ways{};  ///< by patch: faces along it, less those against it
    };

    /// By how much turning the patch would lessen the sum.
    void look_at(std::uint32_t patch) {
        double gain = 0.0, all = 0.0;
        for (const std::size_t e : edges_of_[patch]) {
            int sum = 0;
            for (const auto& [other, way] : edges_[e].ways) sum += way;
            const int then = sum - 2 * edges_[e].ways[patch];
            gain += edges_[e].length * (std::abs(sum) - std::abs(then));
            all += edges_[e].length;
        }
        if (const auto known = gains_.find(patch); known != gains_.end()) {
            queue_.erase({-known->second, patch});
            gains_.erase(known);
        }
        constexpr double noise = 1e-9;  // of sums that are equal but for rounding
        if (!(gain > noise * all)) return;
        gains_[patch] = gain;
        queue_.emplace(-gain, patch);
    }

    std::vector<std::uint32_t> patch_of_;  ///< [F]
    std::vector<shared_edge> edges_{};
    std::map<std::uint32_t, std::vector<std::size_t>> edges_of_{};  ///< by patch
    std::map<std::uint32_t, double> gains_{};
    std::set<std::pair<double, std::uint32_t>> queue_{};
};

}  // namespace

std::uint64_t balance_patches(working_mesh& mesh) {
    const std::vector<std::uint8_t> is_turned = patch_balance(mesh).run();
    std::uint64_t count = 0;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        if (is_turned[f] == 0) continue;
        mesh.faces[f] = turned(mesh.faces[f]);
        ++count;
    }
    return count;
}

}  // namespace treeform::detail::repair
