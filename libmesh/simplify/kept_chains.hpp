#pragma once
/// \file
/// Preserved edges: borders, feature edges and edges between groups.

#include <libmesh/simplify/connected_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/simplify.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::simplify {

/// Chains of preserved edges. An inner vertex of a chain may be removed as long as the chain stays
/// within a distance of the original one.
class kept_chains {
  public:
    kept_chains(const connected_faces& mesh, const simplify_options& options);

    /// Number of vertices that must stay.
    [[nodiscard]] std::uint64_t locked() const {
        return static_cast<std::uint64_t>(std::ranges::count(locked_, 1));
    }
    [[nodiscard]] bool is_free(std::uint32_t p) const { return !locked_[p] && at_[p].empty(); }
    /// Whether `p` may be collapsed into `q`.
    [[nodiscard]] bool may_join(std::uint32_t p, std::uint32_t q) const {
        return !locked_[p] && (at_[p].empty() || (at_[p].size() == 2 && has(p, q)));
    }
    [[nodiscard]] bool has(std::uint32_t p, std::uint32_t q) const;
    /// A bound of the distance between the chain and the original one after `gone`, an inner
    /// vertex, is collapsed into `kept`, its neighbor in the chain; empty if the chain would turn
    /// back.
    [[nodiscard]] std::optional<double> bound(const std::vector<point3>& points, std::uint32_t gone,
                                              std::uint32_t kept) const;
    /// Replaces `q` by `p`, at any position. Chain edges at `gone`, which is `p` or `q`, get the
    /// bound `at_most`.
    void join(std::uint32_t p, std::uint32_t q, std::uint32_t gone, double at_most);

  private:
    struct link {
        std::uint32_t to = 0;
        double at_most = 0.0;  ///< bound of the distance to the original chain
    };
    std::vector<std::vector<link>> at_;
    std::vector<std::uint8_t> locked_;
};

}  // namespace treeform::detail::simplify
