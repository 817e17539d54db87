#pragma once
/// \file
/// A conservative filter for points near others, with little memory.

#include <libmesh/weld/near_cells.hpp>
#include <treeform/mesh/mesh.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace treeform::detail::weld {

/// A Bloom filter of the cubes near given points: one bit for each cube, sometimes shared.
class near_places {
  public:
    /// Sized for about `count` points.
    near_places(double reach, std::size_t count)
        : cubes_(reach), bits_(std::bit_ceil(count / 4 + 1), 0) {
        // To two times the least edge: most intervals meet one cube then.
        for (int i = 0; i < 2 && cubes_.can_shrink(); ++i) cubes_.shrink();
    }

    void add(const point3& p) {
        cube_map::each(cubes_.around(p), [&](std::int64_t x, std::int64_t y, std::int64_t z) {
            const std::uint64_t h = cube_map::hash(x, y, z);
            bits_[word(h)] |= bit(h);
        });
    }
    /// False only if none of the points is within reach of `p`.
    [[nodiscard]] bool may_have(const point3& p) const {
        const auto cube = cubes_.of(p);
        const std::uint64_t h = cube_map::hash(cube[0], cube[1], cube[2]);
        return (bits_[word(h)] & bit(h)) != 0;
    }

  private:
    [[nodiscard]] std::size_t word(std::uint64_t h) const { return h >> 6 & (bits_.size() - 1); }
    [[nodiscard]] static std::uint64_t bit(std::uint64_t h) { return std::uint64_t{1} << (h & 63); }

    cube_map cubes_;
    std::vector<std::uint64_t> bits_;
};

}  // namespace treeform::detail::weld
