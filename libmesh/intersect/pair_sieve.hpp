#pragma once
/// \file
/// From candidate pairs to classified pairs, for the candidates of one chunk of the search.

#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/search_self.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace treeform::detail::intersect {

/// What all chunks share.
struct sieve_input {
    points_view points;
    std::span<const numbered_face> faces;  ///< [F] in leaf order
    const self_intersection_options* options;
    bool filtered;  ///< coordinates lie in the range of the filter
};

/// What one chunk finds.
struct sieve_output {
    std::vector<face_pair> pairs;  ///< as met
    std::array<std::uint64_t, pair_kind_count> counts{};
    std::uint64_t box_pairs = 0;
    std::uint64_t exact_pairs = 0;
    predicate_counters predicates;
};

/// Sorts candidates by the corners they share, filters each class in batches, and has the exact
/// stage decide the rest. 30 kB: one a chunk, not one a block.
class pair_sieve {
  public:
    pair_sieve(const sieve_input& input, sieve_output& output) : input_(input), output_(output) {}

    void add(const candidate_block& block);

  private:
    [[nodiscard]] candidate_block wanted(const candidate_block& block);
    template <std::size_t Corners, class CornersOf, class Filter>
    void filter_class(std::size_t which, const CornersOf& corners_of, const Filter& filter);
    [[nodiscard]] const numbered_face& face_a(const candidate& pair) const;
    [[nodiscard]] const numbered_face& face_b(const candidate& pair) const;
    void decide(const candidate& pair);
    void record(const candidate& pair, pair_kind kind);

    sieve_input input_;
    sieve_output& output_;
    candidate_block block_;  ///< the candidates at hand
    candidate_classes classes_;
    std::array<std::uint32_t, max_candidates> wanted_first_;
    std::array<std::uint32_t, max_candidates> wanted_second_;
};

}  // namespace treeform::detail::intersect
