#pragma once
/// \file
/// Cubes without limits: from denormals to the largest double, no box and no range of indices. A
/// table from hashes of cubes to numbers.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::weld {

/// The index of the interval, of a fixed width, that a coordinate is in. Indices of points within
/// the tolerance differ by little.
///
/// The position of a coordinate x is x / width up to 2^46, and grows 4096 times slower from there
/// on, so that its rounding error is less than 2^-6 everywhere below x / width = 2^56. The
/// difference of two positions is at most that of the coordinates in widths, plus 2^-5. Beyond,
/// neighboring doubles are more than a width apart: unequal ones exceed any tolerance up to the
/// width, and the index is the 64 bits of the coordinate itself.
class cube_axis {
  public:
    struct range {
        std::int64_t first;
        std::int64_t last;
    };

    /// \pre width > 0
    explicit cube_axis(double width) : width_(width) {}

    /// The intervals that contain everything within `reach` widths of x. \pre reach <= 2
    [[nodiscard]] range around(double x, double reach) const {
        const double at = position(x);
        if (!(std::abs(at) < far)) return {bits_of(x), bits_of(x)};
        return {whole(at - reach - slack), whole(at + reach + slack)};
    }
    /// The intervals within `count` of that of x.
    [[nodiscard]] range neighbors(double x, std::int64_t count) const {
        const double at = position(x);
        if (!(std::abs(at) < far)) return {bits_of(x), bits_of(x)};
        return {whole(at) - count, whole(at) + count};
    }
    [[nodiscard]] std::int64_t index(double x) const {
        const double at = position(x);
        return std::abs(at) < far ? whole(at) : bits_of(x);
    }

  private:
    static constexpr double slack = 0x1p-5;
    static constexpr double straight = 0x1p46;
    static constexpr double far = straight + 0x1p44;  // x / width = 2^56

    [[nodiscard]] double position(double x) const {
        const double at = x / width_;  // infinite where that is beyond all doubles
        if (std::abs(at) < straight) return at;
        return std::copysign(straight + (std::abs(at) - straight) * 0x1p-12, at);
    }
    [[nodiscard]] static std::int64_t whole(double at) {
        return static_cast<std::int64_t>(std::floor(at));
    }
    [[nodiscard]] static std::int64_t bits_of(double x) { return std::bit_cast<std::int64_t>(x); }

    double width_;
};

[[nodiscard]] inline std::uint64_t cube_hash(std::int64_t x, std::int64_t y, std::int64_t z,
                                             std::uint32_t label) {
    std::uint64_t h = label;
    for (const std::int64_t i : {x, y, z}) {
        h = (h + static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15;
        h ^= h >> 32;
    }
    return h * 0xd1342543de82ef95;
}

/// Numbers by hash, with open addressing; grows on demand.
class hashed_ids {
  public:
    hashed_ids() : slots_(256, empty) {}

    void add(std::uint64_t hash, std::uint32_t id) {
        if (2 * (used_ + 1) > slots_.size()) grow();
        const slot added{static_cast<std::uint32_t>(hash), id};
        slots_[free_from(hash)] = added;
        ++used_;
    }

    /// Calls `visit_id(id)` for the numbers added with that hash, and sometimes for others.
    template <class Visit>
    void visit(std::uint64_t hash, const Visit& visit_id) const {
        const auto tag = static_cast<std::uint32_t>(hash);
        for (std::size_t at = home(tag); slots_[at].id != nobody; at = (at + 1) & mask())
            if (slots_[at].tag == tag) visit_id(slots_[at].id);
    }

    void prefetch(std::uint64_t hash) const {
        __builtin_prefetch(&slots_[home(static_cast<std::uint32_t>(hash))]);
    }

  private:
    struct slot {
        std::uint32_t tag;
        std::uint32_t id;
    };
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    static constexpr slot empty{0, nobody};

    [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
    [[nodiscard]] std::size_t home(std::uint32_t tag) const { return tag & mask(); }
    [[nodiscard]] std::size_t free_from(std::uint64_t hash) const {
        std::size_t at = home(static_cast<std::uint32_t>(hash));
        while (slots_[at].id != nobody) at = (at + 1) & mask();
        return at;
    }

    void grow() {
        std::vector<slot> old(2 * slots_.size(), empty);
        old.swap(slots_);
        for (const slot& s : old)
            if (s.id != nobody) slots_[free_from(s.tag)] = s;
    }

    std::vector<slot> slots_;
    std::size_t used_ = 0;
};

}  // namespace treeform::detail::weld
