#pragma once
/// \file
/// The last stages for faces of two meshes: the filter in batches, then the exact one.

#include <libmesh/intersect/pair_filter.hpp>
#include <libmesh/intersect/pair_sieve.hpp>
#include <treeform/mesh/triangle.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace treeform::detail::intersect {

/// A face of each mesh.
struct face_numbers {
    std::uint32_t a, b;
};

/// The lowest faces that cannot be computed with, of those that were met.
struct bad_faces {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t in_a = none;
    std::uint32_t in_b = none;
};

/// Filters pairs in batches, and has the exact stage decide the rest. 10 kB.
class pair_decider {
  public:
    pair_decider(pair_kinds kinds, sieve_output& output, bad_faces& bad)
        : kinds_(kinds), output_(output), bad_(bad) {}

    /// One more pair, its faces where they are moved; decided now or with others.
    void add(const face_numbers& pair, const triangle3& a, const triangle3& b);
    /// Decides what waits.
    void finish();

  private:
    void decide(const face_numbers& pair, const triangle3& a, const triangle3& b);
    void record(const face_numbers& pair, pair_kind kind);
    [[nodiscard]] triangle3 batched(std::size_t i, std::size_t first_corner) const;

    pair_kinds kinds_;
    sieve_output& output_;
    bad_faces& bad_;
    std::size_t count_ = 0;  ///< pairs in the batch
    std::array<face_numbers, pair_batch<6>::capacity> pairs_;
    pair_batch<6> batch_;
};

}  // namespace treeform::detail::intersect
