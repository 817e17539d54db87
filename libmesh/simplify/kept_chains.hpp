#pragma once
/// \file
/// Edges that stay: borders, those of features and of groups.

#include <libmesh/simplify/connected_faces.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/simplify.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace treeform::detail::simplify {

/// Edges that stay, in chains from vertex to vertex. Within a chain, a vertex may be left out as
/// long as the chain stays within a distance of what it was.
class kept_chains {
  public:
    kept_chains(const connected_faces& mesh, const simplify_options& options);

    [[nodiscard]] bool is_free(std::uint32_t p) const { return !locked_[p] && at_[p].empty(); }
    /// Whether the vertex may go to the other end of the edge.
    [[nodiscard]] bool may_join(std::uint32_t p, std::uint32_t q) const {
        return !locked_[p] && (at_[p].empty() || (at_[p].size() == 2 && has(p, q)));
    }
    [[nodiscard]] bool has(std::uint32_t p, std::uint32_t q) const;
    /// Bound of how far the chains are from what they were once `gone`, in the middle of one, has
    /// become `kept`, its neighbor in it; none where they would turn back.
    [[nodiscard]] std::optional<double> bound(const std::vector<point3>& points, std::uint32_t gone,
                                              std::uint32_t kept) const;
    /// `q` becomes `p`, wherever that is. Edges of chains at `gone`, one of both, get the bound.
    void join(std::uint32_t p, std::uint32_t q, std::uint32_t gone, double at_most);

  private:
    struct link {
        std::uint32_t to = 0;
        double at_most = 0.0;  ///< no point of the chain is further from what it was
    };
    std::vector<std::vector<link>> at_;
    std::vector<std::uint8_t> locked_;
};

}  // namespace treeform::detail::simplify
