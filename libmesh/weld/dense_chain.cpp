#include <libmesh/base/union_find.hpp>
#include <libmesh/weld/cube_index.hpp>
#include <libmesh/weld/dense.hpp>
#include <libmesh/weld/hashed_ids.hpp>
#include <libmesh/weld/lattice.hpp>
#include <libmesh/weld/linked.hpp>
#include <libmesh/weld/sort_by_key.hpp>
#include <libmesh/weld/tolerance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace treeform::detail::weld {
namespace {

struct member {
    std::uint64_t hash;  ///< of its cube and label
    std::uint32_t id;
};

/// Members of one cube that are one set already; places [begin, end) in the sorted members.
struct block {
    std::size_t begin;
    std::size_t end;
};

using cube_key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

class chain_finder {
  public:
    chain_finder(points_view points, const weld_options& options)
        : points_(points),
          options_(&options),
          match_(points, options),
          axis_(options.tolerance / cubes_per_tolerance),
          sets_(points.size()) {}

    std::vector<std::uint32_t> run() {
        sort();
        for (std::size_t b = 0; b < blocks_.size(); ++b)
            by_hash_.add(members_.records[blocks_[b].begin].hash, static_cast<std::uint32_t>(b));
        for_chunks(blocks_.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t b = begin; b < end; ++b) join_neighbors(static_cast<std::uint32_t>(b));
        });
        std::vector<std::uint32_t> root_of(points_.size());
        for_chunks(points_.size(), 65536, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t i = begin; i < end; ++i)
                root_of[i] = sets_.root(static_cast<std::uint32_t>(i));
        });
        return root_of;
    }

  private:
    [[nodiscard]] std::uint32_t label_of(std::uint32_t i) const {
        return options_->label.empty() ? 0 : options_->label[i];
    }
    [[nodiscard]] cube_key cube_of(std::uint32_t i) const {
        const point3& p = points_[i];
        return {axis_.index(p.x), axis_.index(p.y), axis_.index(p.z)};
    }

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
                const auto [x, y, z] = cube_of(m.id);
                m.hash = cube_hash(x, y, z, label_of(m.id));
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
        for (const std::vector<block>& part : blocks)
            blocks_.insert(blocks_.end(), part.begin(), part.end());
    }

    /// Joins what matches among the members of one cube: all of them unless `may_merge` says no,
    /// and for points of two cubes of one hash, which become blocks of their own.
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
        blocks.push_back({place, place + together});
        for (const std::vector<member>& one : apart) {
            std::copy(one.begin(), one.end(),
                      members.begin() + static_cast<std::ptrdiff_t>(together));
            blocks.push_back({place + together, place + together + one.size()});
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
    bool joins(const member& m, std::span<const member> set) {
        if (cube_of(m.id) != cube_of(set[0].id)) return false;  // of one hash only
        if (!options_->may_merge) set = set.first(1);
        for (const member& other : set)
            if (match_(m.id, other.id)) {
                sets_.join(m.id, other.id);
                return true;
            }
        return false;
    }

    /// Looks from each pair of cubes, and of blocks in one cube, once: from the lower.
    void join_neighbors(std::uint32_t b) {
        const std::uint32_t first = members_.records[blocks_[b].begin].id;
        const cube_key own = cube_of(first);
        const point3& p = points_[first];
        std::array<cube_axis::range, 3> ranges;
        for (std::size_t k = 0; k < 3; ++k) ranges[k] = axis_.neighbors(p[k], 2);
        std::array<std::uint64_t, 125> hashes;
        std::size_t count = 0;
        for (std::int64_t x = std::get<0>(own); x <= ranges[0].last; ++x)
            for (std::int64_t y = ranges[1].first; y <= ranges[1].last; ++y)
                for (std::int64_t z = ranges[2].first; z <= ranges[2].last; ++z) {
                    if (cube_key(x, y, z) <= own) continue;
                    hashes[count] = cube_hash(x, y, z, label_of(first));
                    by_hash_.prefetch(hashes[count++]);
                }
        by_hash_.visit(
            cube_hash(std::get<0>(own), std::get<1>(own), std::get<2>(own), label_of(first)),
            [&](std::uint32_t c) {
                if (c > b) join_if_linked(b, c);
            });
        for (std::size_t k = 0; k < count; ++k)
            by_hash_.visit(hashes[k], [&](std::uint32_t c) {
                if (c != b) join_if_linked(b, c);
            });
    }

    void join_if_linked(std::uint32_t b, std::uint32_t c) {
        const auto ids = [&](const block& from) {
            std::vector<std::uint32_t> result;
            for (std::size_t i = from.begin; i < from.end; ++i)
                result.push_back(members_.records[i].id);
            return result;
        };
        const std::uint32_t i = members_.records[blocks_[b].begin].id;
        const std::uint32_t j = members_.records[blocks_[c].begin].id;
        if (label_of(i) != label_of(j) || sets_.root(i) == sets_.root(j)) return;
        if (!match_(i, j)) {
            std::vector<std::uint32_t> of_b = ids(blocks_[b]);
            std::vector<std::uint32_t> of_c = ids(blocks_[c]);
            if (!any_match(match_, of_b, of_c)) return;
        }
        sets_.join(i, j);
    }

    points_view points_;
    const weld_options* options_;
    matcher match_;
    cube_axis axis_;
    base::union_find sets_;
    sorted_records<member> members_;
    std::vector<block> blocks_;
    hashed_ids by_hash_;
};

}  // namespace

std::vector<std::uint32_t> dense_chains(points_view points, const weld_options& options) {
    return chain_finder(points, options).run();
}

}  // namespace treeform::detail::weld
