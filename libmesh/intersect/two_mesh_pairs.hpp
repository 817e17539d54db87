#pragma once
/// \file
/// Base of the candidate sources of two meshes: pairs of faces that share no corner by number,
/// identified by their face numbers.

#include <libmesh/intersect/classify_pair.hpp>
#include <libmesh/intersect/narrow_phase.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace treeform::detail::intersect {

class two_mesh_pairs {
  public:
    explicit two_mesh_pairs(bad_faces& bad) : bad_(bad) {}

    [[nodiscard]] static face_numbers faces(const face_numbers& pair) { return pair; }
    [[nodiscard]] static std::optional<pair_kind> classify(const face_numbers&,
                                                           const pair_batch& batch, std::size_t i,
                                                           predicate_counters& counters) {
        return classify_triangles(batch.triangle(0, i), batch.triangle(3, i), counters);
    }

  protected:
    /// Passes a pair of transformed faces to the phase, unless one is invalid.
    template <class Phase>
    void offer_pair(const face_numbers& pair, const triangle3& a, const triangle3& b,
                    Phase& phase) {
        constexpr double limit = largest_filtered_coordinate;
        constexpr double largest = std::numeric_limits<double>::max();
        if (within(a, limit) && within(b, limit))
            phase.template wait<candidate_classes::separate>(
                pair, [&](std::size_t k) -> const point3& { return k < 3 ? a[k] : b[k - 3]; });
        else if (within(a, largest) && within(b, largest))
            phase.decide(pair, [&](predicate_counters& counters) {
                return classify_triangles(a, b, counters);
            });
        else
            refuse(pair, !within(a, largest), !within(b, largest));
    }

    void refuse(const face_numbers& pair, bool is_bad_a, bool is_bad_b) {
        if (is_bad_a) bad_.in_a = std::min(bad_.in_a, pair.a);
        if (is_bad_b) bad_.in_b = std::min(bad_.in_b, pair.b);
    }

  private:
    /// Whether no coordinate is NaN or larger in magnitude than `limit`.
    [[nodiscard]] static bool within(const triangle3& t, double limit) {
        unsigned all = 1;  // not a bool, to avoid branches
        for (const point3& p : t)
            for (std::size_t k = 0; k < 3; ++k)
                all &= static_cast<unsigned>(std::abs(p[k]) <= limit);
        return all != 0;
    }

    bad_faces& bad_;
};

}  // namespace treeform::detail::intersect
