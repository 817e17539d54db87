#pragma once
/// \file
/// Incremental search for points near a position.

#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::weld {

/// Cubes with an edge that is a multiple of an eighth of a power of two, and at least 2.0833 times
/// a reach. An interval of the reach to both sides, rounded outward, meets at most two cubes along
/// an axis, those of its ends:
/// - For |x| below 2^44 edges, positions in edges are computed by multiplication. The interval is 2
///   / 2.0833 edges wide, plus 2^-6 for the slack, 2^-7 for the rounding of its ends, and 2^-7 for
///   that of the two positions: less than 1.
/// - Beyond, the side of a cube is a fixed number of neighboring doubles: 1024 at first, which are
///   at least two edges, half as many with each further power of two, and finally 32. There an edge
///   is less than 16 doubles, and the interval less than an edge plus 10 doubles.
/// - Where the two schemes or two of these numbers meet, at multiples of 1024 doubles, new cubes
///   begin: no position below 2^44 is rounded up to it, and the lower cube is at least 1 - 2^-8
///   edges wide.
class cube_map {
  public:
    explicit cube_map(double reach)
        : half_(reach),
          exact_(reach == 0.0),
          least_edge_(edge_over(2.0833 * std::max(reach, 0x1p-900))) {
        set_edge(8.0 * least_edge_);
    }

    [[nodiscard]] bool can_shrink() const { return !exact_ && edge_ > least_edge_; }
    void shrink() { set_edge(0.5 * edge_); }

    using cube = std::array<std::int64_t, 3>;
    /// With a reach of 0, a cube is a single point.
    [[nodiscard]] cube of(const point3& p) const { return {index(p.x), index(p.y), index(p.z)}; }
    /// The lowest and the highest cube within reach of `p`.
    [[nodiscard]] std::array<cube, 2> around(const point3& p) const {
        std::array<cube, 2> ends;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = p[axis];
            const double slack = exact_ ? 0.0 : std::abs(x) * 0x1p-51 + half_ * 0x1p-51;
            ends[0][axis] = index(std::max(x - half_ - slack, -greatest));
            ends[1][axis] = index(std::min(x + half_ + slack, greatest));
        }
        return ends;
    }

    /// Calls `meet(x, y, z)` for each cube between the two ends, once.
    template <class Meet>
    static void each(const std::array<cube, 2>& ends, const Meet& meet) {
        const auto& [low, high] = ends;
        for (const std::int64_t x : {low[0], high[0]}) {
            for (const std::int64_t y : {low[1], high[1]}) {
                for (const std::int64_t z : {low[2], high[2]}) {
                    meet(x, y, z);
                    if (low[2] == high[2]) break;
                }
                if (low[1] == high[1]) break;
            }
            if (low[0] == high[0]) break;
        }
    }

    [[nodiscard]] static std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
        std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15;
        h = (h ^ h >> 32 ^ static_cast<std::uint64_t>(y)) * 0xd1342543de82ef95;
        h = (h ^ h >> 32 ^ static_cast<std::uint64_t>(z)) * 0xaf251af3b0f025b5;
        return h ^ h >> 32;
    }

  private:
    static constexpr double greatest = std::numeric_limits<double>::max();

    /// If the edge would be close to overflow, there is only one cube.
    [[nodiscard]] static double edge_over(double least) {
        if (!(least < 0x1p1000)) return std::numeric_limits<double>::infinity();
        int exponent = 0;
        const double part = std::frexp(least, &exponent);
        return std::ldexp(std::ceil(16.0 * part), exponent - 4);
    }
    void set_edge(double edge) {
        edge_ = edge;
        per_edge_ = 1.0 / edge;
        limit_ = std::ldexp(edge, straight_bits);
        limit_exponent_ = exponent_of(std::bit_cast<std::int64_t>(limit_));
    }

    [[nodiscard]] std::int64_t index(double x) const {
        if (!exact_ && std::abs(x) < limit_) {
            const double steps = x * per_edge_;
            const auto cut = static_cast<std::int64_t>(steps);
            return static_cast<double>(cut) > steps ? cut - 1 : cut;
        }
        const auto bits = std::bit_cast<std::int64_t>(x + 0.0);  // -0 becomes +0
        return exact_ ? bits : bits >> (10 - std::min(exponent_of(bits) - limit_exponent_, 5));
    }

    [[nodiscard]] static int exponent_of(std::int64_t bits) {
        return static_cast<int>(bits >> 52 & 0x7ff);
    }

    static constexpr int straight_bits = 44;

    double half_;
    bool exact_;
    double least_edge_;
    double edge_ = 0.0;
    double per_edge_ = 1.0;
    double limit_ = 0.0;
    int limit_exponent_ = 0;
};

/// Points by cube. Cubes start wide, so that a search mostly visits one of them, and shrink when
/// they have many points. Points with a different salt are mostly skipped, as if they were in other
/// cubes.
template <class Entry>  // with a member `point3 at`
class near_cells {
  public:
    explicit near_cells(double reach, bool salted = false)
        : cubes_(reach), heads_(least_heads, nobody), salted_(salted) {}

    void reserve(std::size_t count) {
        reserve_entries(count);
        if (2 * count <= heads_.size()) return;
        heads_.assign(std::bit_ceil(2 * count), nobody);
        hang_all();
    }
    /// Reserves entries only, if few of them are expected; the hash table stays small.
    void reserve_entries(std::size_t count) {
        entries_.reserve(count);
        next_.reserve(count);
    }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    [[nodiscard]] Entry& operator[](std::size_t number) { return entries_[number]; }

    /// Adds an entry; entries are numbered in this order. \pre `salt` is 0 unless salted
    void add(const Entry& entry, std::uint64_t salt = 0) {
        entries_.push_back(entry);
        if (salted_) salts_.push_back(salt);
        next_.push_back(nobody);
        if (2 * entries_.size() > heads_.size()) {
            heads_.assign(2 * heads_.size(), nobody);
            hang_all();
        } else {
            hang(static_cast<std::uint32_t>(entries_.size() - 1));
        }
    }

    /// Calls `meet(entry, number)` for all entries within reach of `p` and for some others; for
    /// some repeatedly.
    template <class Meet>
    void visit(const point3& p, std::uint64_t salt, const Meet& meet) {
        std::size_t met = 0;
        cube_map::each(cubes_.around(p), [&](std::int64_t x, std::int64_t y, std::int64_t z) {
            for (std::uint32_t i = head(x, y, z, salt); i != nobody; i = next_[i], ++met)
                meet(entries_[i], i);
        });
        count(met);
    }

    /// Prefetches what `visit` reads first.
    void prefetch(const point3& p, std::uint64_t salt = 0) const {
        const auto cube = cubes_.of(p);
        __builtin_prefetch(&heads_[slot(cube[0], cube[1], cube[2], salt)]);
    }
    /// Prefetches what `visit` reads next; call it later than `prefetch`.
    void prefetch_entry(const point3& p, std::uint64_t salt = 0) const {
        const auto cube = cubes_.of(p);
        const std::uint32_t i = head(cube[0], cube[1], cube[2], salt);
        if (i == nobody) return;
        __builtin_prefetch(&entries_[i]);
        __builtin_prefetch(&next_[i]);
    }

  private:
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::size_t least_heads = 1024;

    [[nodiscard]] std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z,
                                   std::uint64_t salt) const {
        return (cube_map::hash(x, y, z) ^ salt) & (heads_.size() - 1);
    }
    [[nodiscard]] std::uint32_t head(std::int64_t x, std::int64_t y, std::int64_t z,
                                     std::uint64_t salt) const {
        return heads_[slot(x, y, z, salt)];
    }
    void hang(std::uint32_t i) {
        const auto cube = cubes_.of(entries_[i].at);
        std::uint32_t& first = heads_[slot(cube[0], cube[1], cube[2], salted_ ? salts_[i] : 0)];
        next_[i] = first;
        first = i;
    }
    void hang_all() {
        for (std::uint32_t i = 0; i < entries_.size(); ++i) hang(i);
    }

    void count(std::size_t met) {
        constexpr std::size_t searches_a_turn = 4096;
        constexpr std::size_t crowd = 16;
        met_ += met;
        if (++searches_ < searches_a_turn) return;
        if (met_ > crowd * searches_ && cubes_.can_shrink()) {
            cubes_.shrink();
            std::fill(heads_.begin(), heads_.end(), nobody);
            hang_all();
        }
        met_ = searches_ = 0;
    }

    cube_map cubes_;
    std::vector<Entry> entries_{};
    std::vector<std::uint32_t> next_{};
    std::vector<std::uint32_t> heads_;
    bool salted_;
    std::vector<std::uint64_t> salts_{};
    std::size_t searches_ = 0;
    std::size_t met_ = 0;
};

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
