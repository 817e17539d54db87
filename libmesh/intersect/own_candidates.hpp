#pragma once
/// \file
/// Candidates of self-intersections of a mesh, for the narrow phase.

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

/// Data shared by all chunks.
struct own_faces {
    points_view points;
    std::span<const numbered_face> faces;  ///< [F] in leaf order
    const face_pair_options* options;
    bool filtered;  ///< whether all coordinates are in the range of the filter
};

/// Candidates of one mesh, sorted into classes by the corners that they share by number, each with
/// its filter. Pairs are identified by places in leaf order. Size: 24 kB.
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
    candidate_block block_;  ///< the current candidates
    candidate_classes classes_;
    std::array<std::uint32_t, max_candidates> wanted_first_;
    std::array<std::uint32_t, max_candidates> wanted_second_;
};

}  // namespace treeform::detail::intersect
