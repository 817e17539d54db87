#include <treeform/tree/detail/bounded_sweep.hpp>
#include <treeform/tree/detail/frame_map.hpp>
#include <treeform/tree/ray.hpp>

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>
// Behind highway.h, which sets the target.
#include <libtree/query/map_node-inl.hpp>

namespace treeform::detail {
namespace {

/// A node in the common frame.
template <std::size_t D>
struct swept_node {
    std::uint32_t index;
    std::uint32_t level;
    std::array<float, D> low;
    std::array<float, D> high;
};

template <std::size_t D>
struct swept_pair {
    double entry;
    swept_node<D> a;
    swept_node<D> b;
};

/// The times at which two boxes may have a common point, from `entry` on; none when it is NaN.
///
/// Sides are floats; a difference of two, taken in double, is off by 2^-53 of itself, a quotient
/// by as much again, and the motion, scaled by a power of two, is as given. So times are right to
/// 2^-50 of themselves, and are widened by 2^-48. Empty slots, [+inf, -inf], give NaN or an entry
/// behind the exit.
template <std::size_t D>
class motion_slabs {
  public:
    explicit motion_slabs(const std::array<double, D>& motion) : motion_(motion) {
        // A component far below the longest one says nothing: its inverse might overflow.
        for (std::size_t k = 0; k < D; ++k)
            inverse_[k] = std::abs(motion[k]) > 0x1p-900 ? 1.0 / motion[k]
                                                         : std::numeric_limits<double>::quiet_NaN();
    }

    /// Of a box of `a`, in motion, with a box of `b`; infinite when they never meet.
    [[nodiscard]] double entry(const std::array<float, D>& low_a,
                               const std::array<float, D>& high_a,
                               const std::array<float, D>& low_b,
                               const std::array<float, D>& high_b) const {
        constexpr double never = std::numeric_limits<double>::infinity();
        double from = 0.0;
        double to = never;
        for (std::size_t k = 0; k < D; ++k) {
            const double low = double{low_b[k]} - double{high_a[k]};
            const double high = double{high_b[k]} - double{low_a[k]};
            if (motion_[k] == 0.0) {
                if (!(low <= 0.0 && 0.0 <= high)) return never;
                continue;
            }
            const double first = (motion_[k] > 0.0 ? low : high) * inverse_[k];
            const double last = (motion_[k] > 0.0 ? high : low) * inverse_[k];
            if (!(first <= never && last >= -never)) continue;  // NaN says nothing
            from = std::max(from, first - 0x1p-48 * std::abs(first));
            to = std::min(to, last + 0x1p-48 * std::abs(last));
        }
        return from <= to ? from : never;
    }

  private:
    std::array<double, D> motion_;
    std::array<double, D> inverse_;
};

template <std::size_t D>
class sweep_walk {
  public:
    sweep_walk(const transformed<D>& a, const transformed<D>& b,
               const std::array<double, D>& motion)
        : a_(a.original()),
          b_(b.original()),
          frame_(common_frame(a_.frame(), a.map(), b_.frame(), b.map())),
          map_a_(map_into(a_.frame(), a.map(), frame_)),
          map_b_(map_into(b_.frame(), b.map(), frame_)),
          slabs_(motion) {}

    /// Returns how many pairs of nodes were opened or visited: `most`, or one more where it ended
    /// for that.
    template <class Visit>
    std::uint64_t run(double latest, std::uint64_t most, const Visit& visit) {
        std::uint64_t opened = 0;
        stack_.push_back({0.0, whole(a_, map_a_), whole(b_, map_b_)});
        while (!stack_.empty()) {
            const swept_pair<D> at = stack_.back();
            stack_.pop_back();
            if (!(at.entry <= latest)) continue;
            if (++opened > most) break;
            const bool last_a = a_.is_leaf_level(at.a.level);
            const bool last_b = b_.is_leaf_level(at.b.level);
            if (last_a && last_b)
                latest = std::min(latest, visit_last(at, latest, visit));
            else if (last_b || (!last_a && extent(at.a) >= extent(at.b)))
                open(a_, map_a_, at, &swept_pair<D>::a, latest);
            else
                open(b_, map_b_, at, &swept_pair<D>::b, latest);
        }
        return opened;
    }

    /// Units of the frame in one of space: times of boxes are those of space when the motion is
    /// scaled alike.
    [[nodiscard]] static double scale(const transformed<D>& a, const transformed<D>& b) {
        return common_frame(a.original().frame(), a.map(), b.original().frame(), b.map()).scale;
    }

  private:
    static double extent(const swept_node<D>& node) {
        float most = 0.0F;
        for (std::size_t k = 0; k < D; ++k) most = std::max(most, node.high[k] - node.low[k]);
        return most;
    }

    static const wide_node<D>& in_frame(const frame_map<D>& map, const wide_node<D>& node,
                                        wide_node<D>& space) {
        if (map.identity) return node;
        HWY_NAMESPACE::map_node(map, node, space);
        return space;
    }

    static swept_node<D> child(const wide_node<D>& node, std::size_t slot, std::size_t index,
                               std::uint32_t level) {
        swept_node<D> box{static_cast<std::uint32_t>(index), level, {}, {}};
        for (std::size_t k = 0; k < D; ++k) {
            box.low[k] = node.min[k][slot];
            box.high[k] = node.max[k][slot];
        }
        return box;
    }

    static swept_node<D> whole(const tree<D>& t, const frame_map<D>& map) {
        wide_node<D> space;
        const wide_node<D>& node = in_frame(map, t.level(0)[0], space);
        swept_node<D> box = child(node, 0, 0, 0);
        for (std::size_t i = 1; i < t.child_count(0, 0); ++i)
            for (std::size_t k = 0; k < D; ++k) {
                box.low[k] = std::min(box.low[k], node.min[k][i]);
                box.high[k] = std::max(box.high[k], node.max[k][i]);
            }
        return box;
    }

    [[nodiscard]] double entry(const swept_node<D>& a, const swept_node<D>& b) const {
        return slabs_.entry(a.low, a.high, b.low, b.high);
    }

    /// The children that may meet the other node, the earliest on top of the stack.
    void open(const tree<D>& t, const frame_map<D>& map, const swept_pair<D>& at,
              swept_node<D> swept_pair<D>::*opened, double latest) {
        wide_node<D> space;
        const swept_node<D>& of = at.*opened;
        const wide_node<D>& node = in_frame(map, t.level(of.level)[of.index], space);
        const std::size_t begin = stack_.size();
        for (std::size_t i = 0; i < t.child_count(of.level, of.index); ++i) {
            swept_pair<D> below = at;
            below.*opened = child(node, i, std::size_t{of.index} * 8 + i, of.level + 1);
            below.entry = std::max(at.entry, entry(below.a, below.b));
            if (below.entry <= latest && below.entry < never) stack_.push_back(below);
        }
        std::stable_sort(stack_.begin() + static_cast<std::ptrdiff_t>(begin), stack_.end(),
                         [](const auto& x, const auto& y) { return x.entry > y.entry; });
    }

    template <class Visit>
    double visit_last(const swept_pair<D>& at, double latest, const Visit& visit) {
        struct meeting {
            double entry;
            std::uint32_t a, b;
        };
        wide_node<D> space_a, space_b;
        const wide_node<D>& node_a = in_frame(map_a_, a_.level(at.a.level)[at.a.index], space_a);
        const wide_node<D>& node_b = in_frame(map_b_, b_.level(at.b.level)[at.b.index], space_b);
        std::array<meeting, 64> meetings;
        std::size_t count = 0;
        for (std::size_t i = 0; i < a_.child_count(at.a.level, at.a.index); ++i) {
            const auto one = child(node_a, i, std::size_t{at.a.index} * 8 + i, 0);
            if (!(entry(one, at.b) <= latest)) continue;
            for (std::size_t j = 0; j < b_.child_count(at.b.level, at.b.index); ++j) {
                const auto other = child(node_b, j, std::size_t{at.b.index} * 8 + j, 0);
                const double from = entry(one, other);
                if (from <= latest && from < never)
                    meetings[count++] = {from, a_.ids()[one.index], b_.ids()[other.index]};
            }
        }
        std::sort(meetings.begin(), meetings.begin() + static_cast<std::ptrdiff_t>(count),
                  [](const meeting& x, const meeting& y) {
                      if (x.entry != y.entry) return x.entry < y.entry;
                      return x.a != y.a ? x.a < y.a : x.b < y.b;
                  });
        for (std::size_t i = 0; i < count && meetings[i].entry <= latest; ++i)
            latest = std::min(latest, visit(meetings[i].a, meetings[i].b));
        return latest;
    }

    static constexpr double never = std::numeric_limits<double>::infinity();

    const tree<D>& a_;
    const tree<D>& b_;
    tree_frame<D> frame_;
    frame_map<D> map_a_;
    frame_map<D> map_b_;
    motion_slabs<D> slabs_;
    std::vector<swept_pair<D>> stack_;
};

}  // namespace

template <std::size_t D>
void sweep(const transformed<D>& a, const transformed<D>& b, const std::array<double, D>& motion,
           double latest, function_ref<double(std::uint32_t, std::uint32_t)> visit) {
    sweep_within<D>(a, b, motion, latest, std::numeric_limits<std::uint64_t>::max(), visit);
}

template <std::size_t D>
std::uint64_t sweep_within(const transformed<D>& a, const transformed<D>& b,
                           const std::array<double, D>& motion, double latest, std::uint64_t most,
                           function_ref<double(std::uint32_t, std::uint32_t)> visit) {
    double longest = 0.0;
    for (const double component : motion) {
        if (!std::isfinite(component))
            throw std::invalid_argument("treeform::visit_swept: the motion is not finite");
        longest = std::max(longest, std::abs(component));
    }
    if (longest == 0.0) throw std::invalid_argument("treeform::visit_swept: the motion is zero");
    if (!(latest >= 0.0))
        throw std::invalid_argument("treeform::visit_swept: the latest time is negative or NaN");
    if (a.original().empty() || b.original().empty()) return 0;

    // Times are measured in units of 2^exponent, so that the motion has a length near 1 in the
    // frame, and no quotient leaves the range of double before the time itself does.
    const int shift = std::ilogb(sweep_walk<D>::scale(a, b));
    const int exponent = -(std::ilogb(longest) + shift);
    std::array<double, D> unit;
    for (std::size_t k = 0; k < D; ++k) {
        unit[k] = std::ldexp(motion[k], shift + exponent);
        if (unit[k] == 0.0 && motion[k] != 0.0) unit[k] = 0x1p-1000;
    }
    sweep_walk<D> walk(a, b, unit);
    const auto in_units = [&](double time) { return std::ldexp(time, -exponent); };
    return walk.run(
        in_units(latest) * (1.0 + 0x1p-50), most,
        [&](std::uint32_t i, std::uint32_t j) { return in_units(visit(i, j)) * (1.0 + 0x1p-50); });
}

template std::uint64_t sweep_within(const transformed<2>&, const transformed<2>&,
                                    const std::array<double, 2>&, double, std::uint64_t,
                                    function_ref<double(std::uint32_t, std::uint32_t)>);
template std::uint64_t sweep_within(const transformed<3>&, const transformed<3>&,
                                    const std::array<double, 3>&, double, std::uint64_t,
                                    function_ref<double(std::uint32_t, std::uint32_t)>);
template void sweep(const transformed<2>&, const transformed<2>&, const std::array<double, 2>&,
                    double, function_ref<double(std::uint32_t, std::uint32_t)>);
template void sweep(const transformed<3>&, const transformed<3>&, const std::array<double, 3>&,
                    double, function_ref<double(std::uint32_t, std::uint32_t)>);

}  // namespace treeform::detail
