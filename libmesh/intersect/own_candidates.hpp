#pragma once
/// \file
/// Candidates of a mesh with itself, for the narrow phase.

#include <libmesh/intersect/narrow_phase.hpp>
#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/answers.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace treeform::detail::intersect {

/// What all chunks share.
struct own_faces {
    points_view points;
    std::span<const numbered_face> faces;  ///< [F] in leaf order
    const intersection_options* options;
    bool filtered;  ///< coordinates lie in the range of the filter
};

/// The faces of one mesh, sorted by the corners they share by number: a filter for each class.
/// Pairs are known by places in leaf order. 24 kB.
class own_candidates {
  public:
    explicit own_candidates(const own_faces& own) : own_(own) {}

    void offer(const candidate_block& block, narrow_phase<own_candidates>& phase);
    [[nodiscard]] face_numbers faces(const face_numbers& places) const;
    [[nodiscard]] std::optional<pair_kind> classify(const face_numbers& places, const pair_batch&,
                                                    std::size_t,
                                                    predicate_counters& counters) const {
        return classify(places, counters);
    }

  private:
    [[nodiscard]] candidate_block wanted(const candidate_block& block);
    [[nodiscard]] face_numbers places(const candidate& by) const {
        return {block_.first[by.index()], block_.second[by.index()]};
    }
    template <candidate_classes::name Class>
    void offer_class(narrow_phase<own_candidates>& phase);
    void decide_class(candidate_classes::name which, narrow_phase<own_candidates>& phase) const;
    [[nodiscard]] std::optional<pair_kind> classify(const face_numbers& places,
                                                    predicate_counters& counters) const;

    own_faces own_;
    candidate_block block_;  ///< the candidates at hand
    candidate_classes classes_;
    std::array<std::uint32_t, max_candidates> wanted_first_;
    std::array<std::uint32_t, max_candidates> wanted_second_;
};

}  // namespace treeform::detail::intersect
