#pragma once
/// \file
/// The narrow phase: from candidate pairs, whose boxes overlap, to classified pairs, for the
/// candidates of one chunk of a search.

#include <libmesh/intersect/pair_filter.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/predicates.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tree/answers.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace treeform::detail::intersect {

/// Two faces: of one mesh, or one of each of two.
struct face_numbers {
    std::uint32_t a, b;
};

/// The output of one chunk.
struct narrow_phase_output {
    std::vector<face_pair> pairs;  ///< in the order found
    std::array<std::uint64_t, pair_kind_count> counts{};
    std::uint64_t box_pairs = 0;
    std::uint64_t exact_pairs = 0;
    predicate_counters predicates;
};

/// The lowest invalid faces, of those that were tested, of two meshes.
struct bad_faces {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t in_a = none;
    std::uint32_t in_b = none;
};

/// Filters pairs in batches, and decides the rest exactly. `Source` provides the triangles; it
/// identifies a pair by a number for each face:
/// - `source.offer(block, phase)` passes the candidates of a block to the phase, class by class: by
///   `wait`, and `finish` after each class; by `put` and `filter`; or by `decide`.
/// - `source.faces(pair)` returns the face numbers of a pair to report.
/// - `source.classify(pair, batch, i, counters)` classifies the pair at place i of a batch exactly.
///
/// Size: 10 kB plus the source; create one for each chunk, not for each block.
template <class Source>
class narrow_phase {
  public:
    template <class... Args>
    narrow_phase(pair_kinds kinds, narrow_phase_output& output, Args&&... of_source)
        : kinds_(kinds), output_(output), source_(of_source...) {}

    void add(const candidate_block& block) {
        output_.box_pairs += block.first.size();
        source_.offer(block, *this);
    }

    /// Adds a pair of a class to the batch: `corner(k)` returns its points in the order of the
    /// filter. No coordinate may exceed `largest_filtered_coordinate`.
    template <candidate_classes::name Class, class Corner>
    void wait(const face_numbers& pair, const Corner& corner) {
        put<Class>(count_, pair, corner);
        if (++count_ == pair_batch::capacity) finish<Class>();
    }
    /// Decides the pairs in the batch.
    template <candidate_classes::name Class>
    void finish() {
        if (count_ != 0) filter<Class>(std::exchange(count_, 0));
    }

    /// Writes a pair to place i < `pair_batch::capacity` of the batch, for callers that count pairs
    /// themselves.
    template <candidate_classes::name Class, class Corner>
    void put(std::size_t i, const face_numbers& pair, const Corner& corner) {
        pairs_[i] = pair;
        for (std::size_t k = 0; k < filtered_corners<Class>; ++k) {
            const point3& p = corner(k);
            batch_.at[k][0][i] = p.x;
            batch_.at[k][1][i] = p.y;
            batch_.at[k][2][i] = p.z;
        }
    }
    /// Decides the pairs at places below `count`, which is not 0.
    template <candidate_classes::name Class>
    void filter(std::size_t count) {
        constexpr std::size_t vector_pairs = 8;                  // at most, in the filter
        for (std::size_t i = count; i % vector_pairs != 0; ++i)  // the last vector, to its end
            for (std::size_t k = 0; k < filtered_corners<Class>; ++k)
                for (auto& axis : batch_.at[k]) axis[i] = axis[0];
        const batch_verdict verdict = filter_pairs<Class>(batch_, count);
        const std::uint64_t in_use = ~std::uint64_t{0} >> (pair_batch::capacity - count);
        for (std::uint64_t rest = verdict.pierce & in_use; rest != 0; rest &= rest - 1)
            record(pairs_[static_cast<std::size_t>(std::countr_zero(rest))],
                   Class == candidate_classes::separate ? pair_kind::crossing : pair_kind::pierce);
        const std::uint64_t open = ~(verdict.apart | verdict.pierce) & in_use;
        for (std::uint64_t rest = open; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            decide(pairs_[i], [&](predicate_counters& counters) {
                return source_.classify(pairs_[i], batch_, i, counters);
            });
        }
    }

    /// Decides a pair exactly, by `classify(counters)`.
    template <class Classify>
    void decide(const face_numbers& pair, const Classify& classify) {
        ++output_.exact_pairs;
        if (const std::optional<pair_kind> kind = classify(output_.predicates)) record(pair, *kind);
    }

  private:
    void record(const face_numbers& pair, pair_kind kind) {
        const auto k = static_cast<std::size_t>(kind);
        if (!kinds_.contains(kind)) return;
        const face_numbers faces = source_.faces(pair);
        ++output_.counts[k];
        output_.pairs.push_back({faces.a, faces.b, kind});
    }

    pair_kinds kinds_;
    narrow_phase_output& output_;
    Source source_;
    std::size_t count_ = 0;  ///< pairs in the batch
    std::array<face_numbers, pair_batch::capacity> pairs_;
    pair_batch batch_;
};

}  // namespace treeform::detail::intersect
