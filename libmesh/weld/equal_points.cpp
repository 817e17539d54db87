#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/first_bad.hpp>
#include <libmesh/base/flattened.hpp>
#include <libmesh/base/for_numbers.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/resize_all.hpp>
#include <libmesh/weld/equal_points.hpp>
#include <treeform/mesh/weld.hpp>
#include <treeform/tree/detail/buffer.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

namespace treeform::detail::weld {
namespace {

constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// The bits of x, with -0 as +0: equal if and only if the coordinates are. Independent of processor
/// modes: a comparison that flushes denormals would take different ones for equal.
std::uint64_t coordinate_bits(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return bits << 1 == 0 ? 0 : bits;
}

/// Multiplication by an odd number propagates low bits up, and the shift propagates high bits down:
/// coordinates converted from floats differ in their high bits only. Each step is a bijection.
std::uint32_t hash_of(const point3& p, std::uint32_t label = 0) {
    std::uint64_t h = 0x243f6a8885a308d3 + label;
    for (const double x : {p.x, p.y, p.z}) {
        h = (h + coordinate_bits(x)) * 0x9e3779b97f4a7c15;
        h ^= h >> 32;
    }
    return static_cast<std::uint32_t>((h * 0xd1342543de82ef95) >> 32);
}

bool same(const point3& a, const point3& b) {
    return coordinate_bits(a.x) == coordinate_bits(b.x) &&
           coordinate_bits(a.y) == coordinate_bits(b.y) &&
           coordinate_bits(a.z) == coordinate_bits(b.z);
}

void check_count(points_view points) {
    if (points.size() > nobody)
        throw std::invalid_argument("treeform::find_equal_points: more than 2^32 - 1 points");
}

bool has_nan(const point3& p) { return p.x != p.x || p.y != p.y || p.z != p.z; }

struct entry {
    std::uint32_t hash;
    std::uint32_t point;
};

/// The points sorted by the leading bits of their hash, those of one bucket ascending.
class buckets {
  public:
    /// `hashes` is [V].
    explicit buckets(std::span<const std::uint32_t> hashes)
        : bits_(bits_for(hashes.size())), entries_(hashes.size()) {
        // At most 65 chunks: the counts are a table of chunks x buckets.
        const std::size_t large = std::max(light_grain, hashes.size() / 64);
        const std::size_t chunks = chunk_count(hashes.size(), large);
        std::vector<std::size_t> next(chunks * count(), 0);
        for_chunks(hashes.size(), large, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t* const size = next.data() + c * count();
            for (std::size_t i = begin; i < end; ++i) ++size[bucket_of(hashes[i])];
        });
        begin_.reserve(count() + 1);
        std::size_t total = 0;
        for (std::size_t b = 0; b < count(); ++b) {
            begin_.push_back(total);
            for (std::size_t c = 0; c < chunks; ++c) {
                const std::size_t size = next[c * count() + b];
                next[c * count() + b] = total;
                total += size;
            }
        }
        begin_.push_back(total);
        for_chunks(hashes.size(), large, [&](std::size_t begin, std::size_t end, std::size_t c) {
            std::size_t* const at = next.data() + c * count();
            for (std::size_t i = begin; i < end; ++i)
                entries_[at[bucket_of(hashes[i])]++] = {hashes[i], static_cast<std::uint32_t>(i)};
        });
    }

    [[nodiscard]] std::size_t count() const { return std::size_t{1} << bits_; }
    [[nodiscard]] std::span<const entry> operator[](std::size_t b) const {
        return entries_.span().subspan(begin_[b], begin_[b + 1] - begin_[b]);
    }

  private:
    /// 2^12 points a bucket, whose lines of memory then stay in the second cache; at most 2^12
    /// buckets, or the scatter would leave too many lines half-written.
    static int bits_for(std::size_t points) {
        return std::clamp(static_cast<int>(std::bit_width(points)) - 12, 0, 12);
    }
    [[nodiscard]] std::size_t bucket_of(std::uint32_t hash) const {
        return static_cast<std::size_t>(std::uint64_t{hash} << bits_ >> 32);
    }

    int bits_;
    buffer<entry> entries_;
    std::vector<std::size_t> begin_;
};

/// Distinct points by hash: open addressing, at most half full, grown as they come, so that many
/// equal points need little memory.
class distinct_points {
  public:
    distinct_points(points_view points, std::span<const std::uint32_t> label)
        : points_(points), label_(label) {}

    void clear() {
        slots_.assign(std::min<std::size_t>(slots_.size(), largest_kept), empty);
        used_ = 0;
    }

    /// The first point given that equals this one: itself if none does.
    std::uint32_t first_like(const entry& e) {
        if (2 * (used_ + 1) > slots_.size()) grow();
        for (std::size_t at = e.hash & mask();; at = (at + 1) & mask()) {
            entry& slot = slots_[at];
            if (slot.point == nobody) {
                slot = e;
                ++used_;
                return e.point;
            }
            if (slot.hash == e.hash && same(points_[slot.point], points_[e.point]) &&
                (label_.empty() || label_[slot.point] == label_[e.point]))
                return slot.point;
        }
    }

  private:
    static constexpr entry empty{0, nobody};
    static constexpr std::size_t smallest = 64;
    static constexpr std::size_t largest_kept = std::size_t{1} << 15;

    [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }

    void grow() {
        std::vector<entry> old(std::max(2 * slots_.size(), smallest), empty);
        old.swap(slots_);
        for (const entry& e : old) {
            if (e.point == nobody) continue;
            std::size_t at = e.hash & mask();
            while (slots_[at].point != nobody) at = (at + 1) & mask();
            slots_[at] = e;
        }
    }

    points_view points_;
    std::span<const std::uint32_t> label_;
    std::vector<entry> slots_;
    std::size_t used_ = 0;
};

/// Puts the first point like it in the place of each point's hash.
void find_firsts(points_view points, std::span<const std::uint32_t> label,
                 std::vector<std::uint32_t>& hash_then_first) {
    constexpr std::size_t ahead = 16;     // entries whose memory is under way
    constexpr std::size_t per_chunk = 4;  // buckets that share a table
    const buckets parts(hash_then_first);
    for_chunks(parts.count(), per_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
        distinct_points distinct(points, label);
        for (std::size_t b = begin; b < end; ++b) {
            const std::span<const entry> bucket = parts[b];
            distinct.clear();
            for (std::size_t i = 0; i < bucket.size(); ++i) {
                if (i + ahead < bucket.size()) {
                    __builtin_prefetch(&points[bucket[i + ahead].point]);
                    __builtin_prefetch(&hash_then_first[bucket[i + ahead].point], 1);
                }
                const entry& e = bucket[i];
                hash_then_first[e.point] =
                    has_nan(points[e.point]) ? e.point : distinct.first_like(e);
            }
        }
    });
}

/// Marks of hashes, 8 to 16 for each point that there is.
class hash_marks {
  public:
    explicit hash_marks(std::size_t points)
        : shift_(32 - std::clamp(static_cast<int>(std::bit_width(points)) + 3, 6, 32)),
          seen_(std::size_t{1} << (32 - shift_ - 6)),
          again_(seen_.size()) {}

    /// Any number of threads may do so at the same time.
    void set(std::uint32_t hash) {
        if (add(seen_, hash)) add(again_, hash);
    }
    /// Whether the mark was set more than once.
    [[nodiscard]] bool is_shared(std::uint32_t hash) const {
        return (again_[word_of(hash)] & bit_of(hash)) != 0;
    }

  private:
    using words = std::vector<std::uint64_t>;

    [[nodiscard]] std::size_t word_of(std::uint32_t hash) const { return hash >> shift_ >> 6; }
    [[nodiscard]] std::uint64_t bit_of(std::uint32_t hash) const {
        return std::uint64_t{1} << (hash >> shift_ & 63U);
    }
    /// Whether the mark was there.
    bool add(words& marks, std::uint32_t hash) const {
        const std::uint64_t bit = bit_of(hash);
        return (std::atomic_ref(marks[word_of(hash)]).fetch_or(bit, std::memory_order_relaxed) &
                bit) != 0;
    }

    int shift_;
    words seen_;
    words again_;
};

/// The points whose marks are shared, ascending: all that equal another are among them.
std::vector<std::uint32_t> points_in_doubt(points_view points) {
    hash_marks marks(points.size());
    base::for_numbers(points.size(), [&](std::size_t i) { marks.set(hash_of(points[i])); });
    std::vector<std::vector<std::uint32_t>> found(chunk_count(points.size(), light_grain));
    for_chunks(points.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i)
            if (marks.is_shared(hash_of(points[i])))
                found[c].push_back(static_cast<std::uint32_t>(i));
    });
    return base::flattened(std::move(found));
}

}  // namespace

std::vector<std::uint32_t> equal_firsts(points_view points, std::span<const std::uint32_t> label) {
    std::vector<std::uint32_t> hash_then_first;
    base::resize_all(points.size(), hash_then_first);
    base::for_numbers(points.size(), [&](std::size_t i) {
        hash_then_first[i] = hash_of(points[i], label.empty() ? 0 : label[i]);
    });
    find_firsts(points, label, hash_then_first);
    return hash_then_first;
}

std::vector<std::uint32_t> number_groups(std::vector<std::uint32_t>& group_of_point) {
    constexpr std::size_t grain = light_grain;
    std::vector<std::uint32_t>& first = group_of_point;
    std::vector<std::uint32_t> next(chunk_count(first.size(), grain), 0);
    for_chunks(first.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        for (std::size_t i = begin; i < end; ++i) next[c] += first[i] == i ? 1 : 0;
    });
    std::uint32_t total = 0;
    for (std::uint32_t& n : next) {
        const std::uint32_t count = n;
        n = total;
        total += count;
    }
    std::vector<std::uint32_t> first_of_group;
    base::resize_all(total, first_of_group);
    buffer<std::uint32_t> number_of(first.size());
    for_chunks(first.size(), grain, [&](std::size_t begin, std::size_t end, std::size_t c) {
        std::uint32_t n = next[c];
        for (std::size_t i = begin; i < end; ++i) {
            if (first[i] != i) continue;
            first_of_group[n] = static_cast<std::uint32_t>(i);
            number_of[i] = n++;
        }
    });
    base::for_numbers(first.size(), grain, [&](std::size_t i) { first[i] = number_of[first[i]]; });
    return first_of_group;
}

std::optional<point_groups> few_equal_points(points_view points) {
    check_count(points);
    const std::vector<std::uint32_t> doubted = points_in_doubt(points);
    std::vector<point3> at(doubted.size());
    base::for_numbers(at.size(), [&](std::size_t i) { at[i] = points[doubted[i]]; });
    const std::vector<std::uint32_t> first = equal_firsts(at, {});
    const auto is_equal = [&](std::size_t i) { return first[i] != i; };
    if (base::first_bad(first.size(), is_equal) == first.size()) return std::nullopt;
    point_groups result;
    result.group_of_point = base::numbers_below(points.size());
    for (std::size_t i = 0; i < first.size(); ++i)
        result.group_of_point[doubted[i]] = doubted[first[i]];
    result.first_of_group = number_groups(result.group_of_point);
    return result;
}

joined_faces join_faces(mesh_view mesh) {
    joined_faces result;
    const auto equal = few_equal_points(mesh.points);
    if (!equal) return result;
    result.changed = true;
    result.faces.resize(mesh.faces.size());
    constexpr std::size_t grain = std::size_t{1} << 15;
    base::for_numbers(mesh.faces.size(), grain, [&](std::size_t f) {
        for (std::size_t i = 0; i < 3; ++i)
            result.faces[f][i] = equal->first_of_group[equal->group_of_point[mesh.faces[f][i]]];
    });
    return result;
}

const joined_faces& join_faces(const prepared_mesh& mesh) {
    constexpr base::slot<joined_faces> slot{base::slot_name::joined_corners};
    return base::prepared_slots::get(mesh, slot, [&] { return join_faces(mesh.indexed_view()); });
}

}  // namespace treeform::detail::weld

namespace treeform {

point_groups find_equal_points(points_view points) {
    detail::weld::check_count(points);
    point_groups result;
    result.group_of_point = detail::weld::equal_firsts(points, {});
    result.first_of_group = detail::weld::number_groups(result.group_of_point);
    return result;
}

mesh join_equal_points(mesh_view mesh) {
    detail::base::check_faces("join_equal_points", mesh.points.size(), mesh.faces);
    const point_groups joined = find_equal_points(mesh.points);
    treeform::mesh result;
    detail::base::resize_all(joined.first_of_group.size(), result.points);
    detail::base::for_numbers(result.points.size(), [&](std::size_t i) {
        result.points[i] = mesh.points[joined.first_of_group[i]];
    });
    detail::base::resize_all(mesh.faces.size(), result.faces);
    detail::base::for_numbers(result.faces.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k)
            result.faces[i][k] = joined.group_of_point[mesh.faces[i][k]];
    });
    return result;
}

}  // namespace treeform
