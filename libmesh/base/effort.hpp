#pragma once
/// \file
/// A bound for searches that could go on: counted, so that the same input ends at the same place.

#include <treeform/mesh/certificate.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace treeform::detail::base {

/// What a search may look at, in pairs of faces: all of it, and each question that it asks. A
/// question that takes more than its allowance is cut: nothing is known of it, and the search goes
/// on with another.
class effort {
  public:
    /// What a pair in motion counts for: it takes as long as so many at rest.
    static constexpr std::uint64_t in_motion = 2;

    /// \param bound as options say it: 0 for 20 million and 200 for each of the `faces`
    effort(std::uint64_t bound, std::size_t faces)
        : bound_(bound != 0 ? bound : 20'000'000 + std::uint64_t{200} * faces) {}

    /// For the next question: a 32nd of all, or what is left.
    [[nodiscard]] std::uint64_t allowance() const {
        return std::min(bound_ / 32 + 1, bound_ - std::min(bound_, used_ + held_));
    }
    /// Keeps a share of all, of 1, for later.
    void hold(double share) {
        held_ = static_cast<std::uint64_t>(share * static_cast<double>(bound_));
    }
    /// Of a question that has looked at so many pairs. False when these are more than its
    /// allowance: then its answer does not count.
    bool spend(std::uint64_t pairs) {
        const std::uint64_t allowed = allowance();
        used_ += std::min(pairs, allowed);
        if (pairs <= allowed) return true;
        ++cut_;
        return false;
    }

    /// Nothing is left but what is held: all questions but those without pairs are cut.
    [[nodiscard]] bool spent() const { return used_ + held_ >= bound_; }
    [[nodiscard]] search_effort so_far() const {
        return {.pairs = used_, .bound = bound_, .cut = cut_};
    }

  private:
    std::uint64_t bound_;
    std::uint64_t used_ = 0;
    std::uint64_t held_ = 0;
    std::uint64_t cut_ = 0;
};

}  // namespace treeform::detail::base
