#pragma once
/// \file
/// A budget for open-ended searches, counted in tested pairs instead of time, so that results are
/// reproducible.

#include <treeform/mesh/certificate.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::base {

/// The number of pairs of faces that a search may test: in total, and for each query. A query that
/// exceeds its allowance is skipped: its result is unknown, and the search continues with the next.
class effort {
  public:
    /// A pair in motion counts as this many pairs, since it takes that much longer.
    static constexpr std::uint64_t in_motion = 2;

    /// \param bound as in options; 0: 20 million plus 200 for each of the `faces`
    effort(std::uint64_t bound, std::size_t faces)
        : bound_(bound != 0 ? bound : 20'000'000 + std::uint64_t{200} * faces) {}

    /// The limit of the next query: 1/32 of the total, or what is left.
    [[nodiscard]] std::uint64_t allowance() const {
        return std::min(bound_ / 32 + 1, bound_ - std::min(bound_, used_ + held_));
    }
    /// Reserves a share of the total, in [0, 1], for later.
    void hold(double share) {
        held_ = static_cast<std::uint64_t>(share * static_cast<double>(bound_));
    }
    /// Records a query that tested `pairs` pairs. Returns false if these exceed its allowance; its
    /// answer must then be ignored.
    bool spend(std::uint64_t pairs) {
        const std::uint64_t allowed = allowance();
        used_ += std::min(pairs, allowed);
        if (pairs <= allowed) return true;
        ++skipped_;
        return false;
    }

    /// Whether only the reserve is left, so that all queries with any pairs are skipped.
    [[nodiscard]] bool spent() const { return used_ + held_ >= bound_; }
    [[nodiscard]] search_effort so_far() const {
        return {.pairs = used_, .bound = bound_, .skipped_candidates = skipped_};
    }

  private:
    std::uint64_t bound_;
    std::uint64_t used_ = 0;
    std::uint64_t held_ = 0;
    std::uint64_t skipped_ = 0;
};

}  // namespace treeform::detail::base
