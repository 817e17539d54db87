#include <libmesh/base/union_find.hpp>
#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/group_points.hpp>
#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/linked.hpp>
#include <libmesh/weld/reach.hpp>
#include <libmesh/weld/sort_by_key.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <utility>

namespace treeform::detail::weld {
namespace {

/// Cubes stand in cells of 8 x 8 x 8, so that what is near in space is near in memory.
constexpr int cell_bits = 3;
constexpr std::size_t cell_side = std::size_t{1} << cell_bits;
/// Cubes whose points may be within the tolerance of each other are at most so far apart.
constexpr std::size_t cubes_around = 2;

using cube = std::array<std::int64_t, 3>;

cube cell_of(cube at) {
    for (std::int64_t& i : at) i >>= cell_bits;
    return at;
}
std::uint64_t cell_hash(const cube& cell, std::uint32_t label) {
    return cube_hash(cell[0], cell[1], cell[2], label) >> 3 * cell_bits;
}
std::uint64_t cell_hash(std::uint64_t hash) { return hash >> 3 * cell_bits; }

/// Of a cube: the hash of its cell above, its place in the cell below.
std::uint64_t hash_by_cell(const cube& at, std::uint32_t label) {
    std::uint64_t hash = cell_hash(cell_of(at), label);
    for (const std::int64_t i : at)
        hash = hash << cell_bits | (static_cast<std::uint64_t>(i) & (cell_side - 1));
    return hash;
}
std::array<std::size_t, 3> place_in_cell(std::uint64_t hash) {
    constexpr std::uint64_t mask = cell_side - 1;
    return {hash >> 2 * cell_bits & mask, hash >> cell_bits & mask, hash & mask};
}

/// The way to half of the cells around one; to the others it is the way back.
constexpr std::array<cube, 13> half_around{{{0, 0, 1},
                                            {0, 1, -1},
                                            {0, 1, 0},
                                            {0, 1, 1},
                                            {1, -1, -1},
                                            {1, -1, 0},
                                            {1, -1, 1},
                                            {1, 0, -1},
                                            {1, 0, 0},
                                            {1, 0, 1},
                                            {1, 1, -1},
                                            {1, 1, 0},
                                            {1, 1, 1}}};

struct member {
    std::uint64_t hash;  ///< of its cell and label, and its place in the cell
    std::uint32_t id;
};

/// Members of one cube that are one set already; places [begin, end) in the sorted members, of
/// which the first is the earliest point.
struct block {
    std::uint32_t begin;
    std::uint32_t end;
    point3 first;
};

/// The blocks of a cell and around it.
class neighborhood {
  public:
    void clear() { row_.fill(0); }

    /// Notes a block of the cube at `place`, which counts from the cell in the middle. Those of one
    /// cube follow each other.
    void add(const std::array<std::ptrdiff_t, 3>& place, std::uint32_t b) {
        std::array<std::size_t, 3> at;
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = static_cast<std::size_t>(place[k] + static_cast<std::ptrdiff_t>(cubes_around));
            if (at[k] >= side) return;
        }
        const std::size_t row = at[0] * side + at[1];
        const auto bit = static_cast<std::uint16_t>(1U << at[2]);
        places& there = blocks_[row * side + at[2]];
        if ((row_[row] & bit) == 0) there = {b, b};
        row_[row] |= bit;
        ++there.end;
    }

    /// Calls `meet(b)` for the blocks of the cubes around the one at `place`, and of itself.
    template <class Meet>
    void visit(const std::array<std::size_t, 3>& place, const Meet& meet) const {
        constexpr std::size_t width = 2 * cubes_around + 1;
        for (std::size_t x = place[0]; x < place[0] + width; ++x)
            for (std::size_t y = place[1]; y < place[1] + width; ++y) {
                const std::size_t row = x * side + y;
                for (std::uint32_t bits = row_[row] >> place[2] & ((1U << width) - 1); bits != 0;
                     bits &= bits - 1) {
                    const places& there = blocks_[row * side + place[2] +
                                                  static_cast<std::size_t>(std::countr_zero(bits))];
                    for (std::uint32_t b = there.begin; b < there.end; ++b) meet(b);
                }
            }
    }

  private:
    struct places {
        std::uint32_t begin;
        std::uint32_t end;
    };
    static constexpr std::size_t side = cell_side + 2 * cubes_around;

    std::array<std::uint16_t, side * side> row_{};   ///< which cubes of a row have blocks
    std::array<places, side * side * side> blocks_;  ///< of the cubes that have some
};

class chain_finder {
  public:
    chain_finder(points_view points, const weld_options& options)
        : points_(points),
          options_(&options),
          match_(points, options),
          axis_(options.tolerance / cubes_per_tolerance) {}

    std::vector<std::uint32_t> run() {
        sort();
        if (!may_continue(0)) return {};
        find_cells();
        base::union_find sets(blocks_.size());
        for (std::size_t first = 0; first < cells(); first += cells_a_call) {
            if (!may_continue(first)) return {};
            const std::size_t count = std::min(cells_a_call, cells() - first);
            for_chunks(count, 4, [&](std::size_t begin, std::size_t end, std::size_t) {
                scratch space;
                for (std::size_t c = begin; c < end; ++c) join_around(first + c, space, sets);
            });
        }
        return roots(sets.take_roots().span());
    }

  private:
    static constexpr std::size_t cells_a_call = std::size_t{1} << 12;

    /// A cell beside another.
    struct beside {
        std::uint32_t number;
        cube away;
    };
    /// What is used again for each cell of a chunk.
    struct scratch {
        neighborhood near{};
        std::vector<beside> found{};
        std::vector<std::pair<std::uint32_t, std::uint32_t>> unsure{};
        std::vector<std::uint32_t> of_one{};
        std::vector<std::uint32_t> of_other{};
    };

    [[nodiscard]] bool may_continue(std::size_t cells_done) const {
        return !options_->progress || options_->progress(static_cast<double>(cells_done) /
                                                         static_cast<double>(cells_.size() + 1));
    }
    [[nodiscard]] std::uint32_t label_of(std::uint32_t i) const {
        return options_->label.empty() ? 0 : options_->label[i];
    }
    [[nodiscard]] cube cube_of(const point3& p) const {
        return {axis_.index(p.x), axis_.index(p.y), axis_.index(p.z)};
    }
    [[nodiscard]] cube cell(const block& b) const { return cell_of(cube_of(b.first)); }
    [[nodiscard]] std::uint64_t hash(const block& b) const {
        return members_.records[b.begin].hash;
    }
    [[nodiscard]] std::uint32_t id(const block& b) const { return members_.records[b.begin].id; }

    void sort() {
        const key_bits bits(points_.size());
        const auto key = [&](const member& m) {
            return static_cast<std::uint32_t>(m.hash >> (64 - bits.all()));
        };
        members_ = distribute<member>(
            points_.size(), bits,
            [&](std::size_t i, member& m) {
                if (!base::is_finite(points_[i])) return false;
                m.id = static_cast<std::uint32_t>(i);
                m.hash = hash_by_cell(cube_of(points_[i]), label_of(m.id));
                return true;
            },
            key);
        std::vector<std::vector<block>> blocks(bits.buckets());
        sort_buckets(
            members_, bits, key,
            [](const member& a, const member& b) {
                return a.hash != b.hash ? a.hash < b.hash : a.id < b.id;
            },
            [&](std::size_t b, std::span<member> bucket) {
                for (std::size_t i = 0; i < bucket.size();) {
                    std::size_t end = i + 1;
                    while (end < bucket.size() && bucket[end].hash == bucket[i].hash) ++end;
                    add_blocks(bucket.subspan(i, end - i), members_.begin[b] + i, blocks[b]);
                    i = end;
                }
                return bucket.size();
            });
        std::size_t count = 0;
        for (const std::vector<block>& part : blocks) count += part.size();
        blocks_.reserve(count);
        for (std::vector<block>& part : blocks) {
            blocks_.insert(blocks_.end(), part.begin(), part.end());
            part = {};
        }
    }

    /// Cuts the members of one hash into blocks: all are one unless `may_merge` says no, they are
    /// of several cubes or labels, or so far out that cubes are wide.
    void add_blocks(std::span<member> members, std::size_t place, std::vector<block>& blocks) {
        std::vector<std::vector<member>> apart;
        std::size_t together = 1;
        for (std::size_t i = 1; i < members.size(); ++i) {
            const member m = members[i];
            if (joins(m, members.first(together)))
                members[together++] = m;
            else
                add_apart(m, apart);
        }
        const auto add = [&](std::size_t begin, std::size_t size) {
            blocks.push_back({static_cast<std::uint32_t>(place + begin),
                              static_cast<std::uint32_t>(place + begin + size),
                              points_[members[begin].id]});
        };
        add(0, together);
        for (const std::vector<member>& one : apart) {
            std::copy(one.begin(), one.end(),
                      members.begin() + static_cast<std::ptrdiff_t>(together));
            add(together, one.size());
            together += one.size();
        }
    }
    void add_apart(const member& m, std::vector<std::vector<member>>& apart) {
        for (std::vector<member>& one : apart)
            if (joins(m, one)) {
                one.push_back(m);
                return;
            }
        apart.push_back({m});
    }
    /// Where only distance matters, one look is enough; what it overlooks, neighbors find.
    [[nodiscard]] bool joins(const member& m, std::span<const member> set) const {
        if (cube_of(points_[m.id]) != cube_of(points_[set[0].id])) return false;
        if (!options_->may_merge) set = set.first(1);
        return std::any_of(set.begin(), set.end(),
                           [&](const member& other) { return match_(m.id, other.id); });
    }

    /// Blocks of one cell and label are cells_[c] .. cells_[c + 1].
    [[nodiscard]] std::size_t cells() const { return cells_.size() - 1; }
    void find_cells() {
        for (std::size_t begin = 0; begin < blocks_.size();) {
            const std::uint64_t first = cell_hash(hash(blocks_[begin]));
            std::size_t end = begin + 1;
            while (end < blocks_.size() && cell_hash(hash(blocks_[end])) == first) ++end;
            add_cells(begin, end);
            begin = end;
        }
        cells_.push_back(static_cast<std::uint32_t>(blocks_.size()));
    }
    /// Blocks of one hash of cells are nearly always of one cell.
    void add_cells(std::size_t begin, std::size_t end) {
        const std::span<block> blocks = std::span(blocks_).subspan(begin, end - begin);
        const auto key = [&](const block& b) { return std::pair(cell(b), label_of(id(b))); };
        const auto less = [&](const block& a, const block& b) { return key(a) < key(b); };
        if (std::any_of(blocks.begin(), blocks.end(),
                        [&](const block& b) { return key(b) != key(blocks[0]); }))
            std::stable_sort(blocks.begin(), blocks.end(), less);
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            if (b > 0 && key(blocks[b - 1]) == key(blocks[b])) continue;
            by_hash_.add(cell_hash(hash(blocks[b])), static_cast<std::uint32_t>(cells_.size()));
            cells_.push_back(static_cast<std::uint32_t>(begin + b));
        }
    }

    /// Notes the blocks of a cell that is `away` cells from the one in the middle.
    void note(std::size_t c, const cube& away, neighborhood& near) const {
        for (std::uint32_t b = cells_[c]; b < cells_[c + 1]; ++b) {
            const std::array<std::size_t, 3> at = place_in_cell(hash(blocks_[b]));
            std::array<std::ptrdiff_t, 3> place;
            for (std::size_t k = 0; k < 3; ++k)
                place[k] =
                    static_cast<std::ptrdiff_t>(away[k] * static_cast<std::int64_t>(cell_side)) +
                    static_cast<std::ptrdiff_t>(at[k]);
            near.add(place, b);
        }
    }

    /// Notes the blocks of half of the cells around one, which are of its label.
    void note_half_around(const block& any, scratch& space) const {
        const std::uint32_t label = label_of(id(any));
        const cube middle = cell(any);
        const auto at = [&](const cube& away) {
            return cube{middle[0] + away[0], middle[1] + away[1], middle[2] + away[2]};
        };
        std::array<std::uint64_t, half_around.size()> hashes;
        for (std::size_t k = 0; k < half_around.size(); ++k) {
            hashes[k] = cell_hash(at(half_around[k]), label);
            by_hash_.prefetch(hashes[k]);
        }
        // Each turn asks memory for what the next one reads.
        space.found.clear();
        for (std::size_t k = 0; k < half_around.size(); ++k)
            by_hash_.visit(hashes[k], [&](std::uint32_t c) {
                space.found.push_back({c, half_around[k]});
                __builtin_prefetch(&cells_[c]);
            });
        for (const beside& one : space.found) __builtin_prefetch(&blocks_[cells_[one.number]]);
        for (const beside& one : space.found)
            __builtin_prefetch(&members_.records[blocks_[cells_[one.number]].begin]);
        for (const beside& one : space.found) {
            const block& of = blocks_[cells_[one.number]];
            if (cell(of) == at(one.away) && label_of(id(of)) == label)
                note(one.number, one.away, space.near);
        }
    }

    /// Joins the blocks of a cell with each other and with those in half of the cells around it;
    /// the other half looks from there.
    void join_around(std::size_t c, scratch& space, base::union_find& sets) const {
        constexpr std::size_t many = std::size_t{1} << 16;
        space.near.clear();
        note(c, {0, 0, 0}, space.near);
        note_half_around(blocks_[cells_[c]], space);
        for (std::uint32_t b = cells_[c]; b < cells_[c + 1]; ++b)
            space.near.visit(place_in_cell(hash(blocks_[b])), [&](std::uint32_t other) {
                const bool looks_from_there = other >= cells_[c] && other <= b;
                if (looks_from_there || sets.root(b) == sets.root(other)) return;
                const block& one = blocks_[b];
                const block& two = blocks_[other];
                if (match_.near(one.first, two.first) &&
                    (match_.by_distance() || match_(id(one), id(two)))) {
                    sets.join(b, other);
                } else if (one.end - one.begin > 1 || two.end - two.begin > 1) {
                    space.unsure.emplace_back(b, other);
                    if (space.unsure.size() == many) settle(space, sets);
                }
            });
        settle(space, sets);
    }
    /// Asks of all members of blocks whose firsts do not match; most have been joined by then.
    void settle(scratch& space, base::union_find& sets) const {
        for (const auto& [b, other] : space.unsure) {
            if (sets.root(b) == sets.root(other)) continue;
            list(blocks_[b], space.of_one);
            list(blocks_[other], space.of_other);
            if (any_match(match_, space.of_one, space.of_other)) sets.join(b, other);
        }
        space.unsure.clear();
    }
    void list(const block& b, std::vector<std::uint32_t>& ids) const {
        ids.clear();
        for (std::size_t i = b.begin; i < b.end; ++i) ids.push_back(members_.records[i].id);
    }

    /// The earliest point of each point's set, given the sets of the blocks.
    [[nodiscard]] std::vector<std::uint32_t> roots(std::span<const std::uint32_t> set_of) const {
        std::vector<std::uint32_t> earliest(blocks_.size(), ~std::uint32_t{0});
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            earliest[set_of[b]] = std::min(earliest[set_of[b]], id(blocks_[b]));
        std::vector<std::uint32_t> root_of(points_.size());
        std::iota(root_of.begin(), root_of.end(), 0U);
        for_chunks(blocks_.size(), 4096, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t b = begin; b < end; ++b)
                for (std::size_t i = blocks_[b].begin; i < blocks_[b].end; ++i)
                    root_of[members_.records[i].id] = earliest[set_of[b]];
        });
        return root_of;
    }

    points_view points_;
    const weld_options* options_;
    matcher match_;
    cube_axis axis_;
    sorted_records<member> members_{};
    std::vector<block> blocks_{};         ///< by cell, then by cube
    std::vector<std::uint32_t> cells_{};  ///< [cells + 1] the first block of each
    hashed_ids by_hash_{};                ///< cells
};

}  // namespace

std::vector<std::uint32_t> dense_chains(points_view points, const weld_options& options) {
    return chain_finder(points, options).run();
}

}  // namespace treeform::detail::weld
