#pragma once
/// \file
/// Recursively halves boxes until they are decided, and tracks the components that reach into each.

#include <libmesh/boolean/component_items.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/boolean/undecided_space.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace treeform::detail::boolean {

/// Halving a box costs its number of items. The budget is `budget_of_face` for each face, shared
/// among the halves; if a half is decided, each face that is only in it adds `pay_of_face`.
constexpr double budget_of_face = 16.0;
constexpr double pay_of_face = 4.0;

struct decided_component {
    std::uint32_t component;
    std::int64_t winding;
};

struct range_change {
    std::uint32_t operand;
    winding_range by;
};

/// A box of the recursion.
struct box_node {
    aabb<double, 3> box;
    items inside;
    /// components that may have unusual winding numbers there; ascending
    std::vector<std::uint32_t> unusual;
    std::size_t faces = 0;  ///< number of faces below its items
    double budget = 0.0;
};

/// A half of a box.
struct half : box_node {
    /// components that reach into the box, but not into this half; ascending
    std::vector<decided_component> gone;
    /// whether `gone` decides the half; other members are then incomplete
    bool is_decided = false;
};

struct halves {
    std::size_t axis = 0;
    double at = 0.0;
    half lower, upper;
};

/// The share of a box that becomes the lower half. Not 0.5, since faces of designed parts often lie
/// at simple fractions of their boxes, and would be in both halves.
constexpr double share_below = 0.4931;

/// Sets the axis and coordinate at which to halve a box; false if the box is too small.
inline bool can_be_halved(const aabb<double, 3>& box, std::size_t& axis, double& at) {
    axis = 0;
    const auto extent = [&](std::size_t k) { return 0.5 * box.max[k] - 0.5 * box.min[k]; };
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
        if (extent(k) > extent(axis)) axis = k;
    at = (1.0 - share_below) * box.min[axis] + share_below * box.max[axis];
    return box.min[axis] < at && at < box.max[axis];
}

/// Halves boxes, and computes what is known about the winding numbers of components in each half.
class divider {
  public:
    divider(const surface_components& components, const division_limits& limits,
            std::vector<std::uint8_t>& is_undecided_face)
        : components_(components),
          limits_(limits),
          items_(components),
          is_undecided_face_(is_undecided_face) {}

    [[nodiscard]] box_node everything() const {
        box_node all;
        for (std::uint32_t c = 0; c < components_.size(); ++c) {
            all.box.include(components_.box(c));
            all.inside.push_back({c, 0, 0});
            if (!components_.unusual_boxes(c).empty()) all.unusual.push_back(c);
        }
        all.faces = components_.mesh().faces.size();
        all.budget = limits_.effort * budget_of_face * static_cast<double>(all.faces);
        return all;
    }

    /// Whether to halve an undecided box.
    [[nodiscard]] bool is_worth_halving(const box_node& p) const {
        if (p.faces <= limits_.faces_not_halved || p.budget < static_cast<double>(p.inside.size()))
            return false;
        // In a box with a single component, nothing can be hidden.
        return p.inside.front().component != p.inside.back().component;
    }

    /// Halves a box; false if it is too small. `decides(gone)` returns whether a half is decided by
    /// the winding numbers of components that do not reach into it.
    template <class Decides>
    [[nodiscard]] bool halve(const box_node& p, halves& result, const Decides& decides) const {
        if (!can_be_halved(p.box, result.axis, result.at)) return false;
        result.lower = {{p.box, {}, {}}, {}};
        result.upper = {{p.box, {}, {}}, {}};
        result.lower.box.max[result.axis] = result.at;
        result.upper.box.min[result.axis] = result.at;
        for (auto i = p.inside.begin(); i != p.inside.end();) {
            const std::uint32_t c = i->component;
            const std::size_t in_lower = result.lower.inside.size();
            const std::size_t in_upper = result.upper.inside.size();
            if (i->level == 0)
                sort_in_root(*i++, result);
            else
                for (const framed_halves box = framed(c, result);
                     i != p.inside.end() && i->component == c; ++i)
                    sort_in_known(*i, box, result);
            if (result.lower.inside.size() == in_lower) leave(c, result.lower, decides);
            if (result.upper.inside.size() == in_upper) leave(c, result.upper, decides);
            if (result.lower.is_decided && result.upper.is_decided) return true;
        }
        const double rest = p.budget - static_cast<double>(p.inside.size());
        const auto weight = [](const half& part) {
            const auto count = static_cast<double>(part.inside.size());
            return count * count;
        };
        const double all = weight(result.lower) + weight(result.upper);
        for (half* part : {&result.lower, &result.upper}) {
            part->budget = all > 0.0 ? rest * weight(*part) / all : 0.0;
            for (const std::uint32_t c : p.unusual)
                if (std::ranges::any_of(components_.unusual_boxes(c),
                                        [&](const aabb<double, 3>& unusual) {
                                            return overlaps(unusual, part->box);
                                        }))
                    part->unusual.push_back(c);
        }
        return true;
    }

    /// The changes of winding ranges in a part of a box, by the components that do not reach into
    /// it.
    [[nodiscard]] std::vector<range_change> changes_by(const std::vector<decided_component>& gone,
                                                       const box_node& above) const {
        std::vector<range_change> result;
        for (const auto& [c, winding] : gone)
            change(c, winding_range::only(winding), above, result);
        return result;
    }

    /// All changes of winding ranges in a part of a box.
    [[nodiscard]] std::vector<range_change> changes_in(const half& part,
                                                       const box_node& above) const {
        std::vector<range_change> result = changes_by(part.gone, above);
        for (const std::uint32_t c : above.unusual)
            if (!std::ranges::binary_search(part.unusual, c) && is_inside(c, part))
                change(c, components_.usual_range(c), above, result);
        return result;
    }

    void mark_faces(const box_node& p) const {
        for (auto i = p.inside.begin(); i != p.inside.end();) {
            const std::uint32_t c = i->component;
            const framed_box box = items_.framed(c, p.box);
            for (; i != p.inside.end() && i->component == c; ++i) mark_faces(*i, box);
        }
    }

    /// Adds the ranges of the components that reach into a box, or subtracts them.
    void assign(partial_expression& state, const box_node& p, bool is_there) const {
        const std::int64_t sign = is_there ? 1 : -1;
        for_components(p.inside, [&](std::uint32_t c) {
            const winding_range& range = range_in(p, c);
            state.add(components_.operand(c), {sign * range.low, sign * range.high});
        });
    }

    /// Whether only few components reach into a box, none of which can decide it alone.
    [[nodiscard]] bool cannot_prune(const box_node& p, partial_expression& state) const {
        std::size_t count = 0;
        bool has_hope = false;
        for_components(p.inside, [&](std::uint32_t c) {
            if (++count > limits_.few_components || has_hope) return;
            const winding_range& range = range_in(p, c);
            const bool is_known = range != winding_range::unknown();
            for (const std::int64_t winding :
                 {is_known ? range.low : 0, is_known ? range.high : 1}) {
                const winding_range by{winding - range.low, winding - range.high};
                state.add(components_.operand(c), by);
                if (state.value()) has_hope = true;
                state.add(components_.operand(c), {-by.low, -by.high});
            }
        });
        return !has_hope && count <= limits_.few_components;
    }

  private:
    void change(std::uint32_t c, const winding_range& now, const box_node& above,
                std::vector<range_change>& result) const {
        const winding_range& before = range_in(above, c);
        if (now != before)
            result.push_back(
                {components_.operand(c), {now.low - before.low, now.high - before.high}});
    }

    /// Records that a component does not reach into a half.
    template <class Decides>
    void leave(std::uint32_t c, half& from, const Decides& decides) const {
        if (from.is_decided) return;
        point3 q;
        for (std::size_t k = 0; k < 3; ++k) q[k] = from.box.min[k];
        const std::int64_t winding = components_.winding_around(c, q);
        from.gone.push_back({c, winding});
        if (winding != 0) from.is_decided = decides(from.gone);
    }

    template <class Visit>
    static void for_components(const items& inside, const Visit& visit) {
        std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
        for (const item& i : inside) {
            if (i.component == last) continue;
            last = i.component;
            visit(last);
        }
    }

    [[nodiscard]] const winding_range& range_in(const box_node& p, std::uint32_t c) const {
        return std::ranges::binary_search(p.unusual, c) ? components_.range(c)
                                                        : components_.usual_range(c);
    }
    [[nodiscard]] static bool is_inside(std::uint32_t c, const box_node& p) {
        return std::ranges::binary_search(p.inside, c, {}, &item::component);
    }

    struct framed_halves {
        framed_box lower, upper;
    };

    [[nodiscard]] framed_halves framed(std::uint32_t c, const halves& parts) const {
        return {items_.framed(c, parts.lower.box), items_.framed(c, parts.upper.box)};
    }

    /// Puts a whole component into the halves into which it reaches, or opens its root.
    void sort_in_root(const item& i, halves& result) const {
        const aabb<double, 3>& own = components_.box(i.component);
        if (is_larger(own, result.lower.box)) {
            const framed_halves box = framed(i.component, result);
            items_.for_children(i, [&](const item& child) { sort_in(child, box, result); });
        } else {
            put(i, overlaps(own, result.lower.box), overlaps(own, result.upper.box), result);
        }
    }

    /// Puts an item into the halves into which it reaches; opens it if it is larger than they are.
    void sort_in(const item& i, const framed_halves& box, halves& result) const {
        const aabb<float, 3> own = items_.box_of(i);
        const bool in_lower = !result.lower.is_decided && items_.reaches(i, own, box.lower);
        const bool in_upper = !result.upper.is_decided && items_.reaches(i, own, box.upper);
        if (!in_lower && !in_upper) return;
        if (items_.is_face(i) || !is_larger(own, box.lower.in_frame))
            put(i, in_lower, in_upper, result);
        else
            items_.for_children(i, [&](const item& child) { sort_in(child, box, result); });
    }

    /// The same for an item that reaches into the box and is not larger: only the halved axis has
    /// to be tested.
    void sort_in_known(const item& i, const framed_halves& box, halves& result) const {
        if (items_.is_face(i)) return sort_in(i, box, result);
        const std::size_t axis = result.axis;
        const aabb<float, 1> own = items_.extent_of(i, axis);
        const aabb<float, 3>& lower = box.lower.in_frame;
        if (0.5F * own.max[0] - 0.5F * own.min[0] > 0.5F * lower.max[axis] - 0.5F * lower.min[axis])
            items_.for_children(i, [&](const item& child) { sort_in(child, box, result); });
        else
            put(i, own.min[0] <= lower.max[axis], own.max[0] >= box.upper.in_frame.min[axis],
                result);
    }

    void put(const item& i, bool in_lower, bool in_upper, halves& result) const {
        in_lower = in_lower && !result.lower.is_decided;
        in_upper = in_upper && !result.upper.is_decided;
        if (!in_lower && !in_upper) return;
        const std::size_t faces = items_.faces_below(i);
        if (in_lower) {
            result.lower.inside.push_back(i);
            result.lower.faces += faces;
        }
        if (in_upper) {
            result.upper.inside.push_back(i);
            result.upper.faces += faces;
        }
    }

    /// \pre the item may reach into the box
    void mark_faces(const item& i, const framed_box& box) const {
        if (items_.is_face(i)) {
            const std::atomic_ref mark(is_undecided_face_[items_.face_of(i)]);
            if (mark.load(std::memory_order_relaxed) == 0)  // else avoid invalidating caches
                mark.store(1, std::memory_order_relaxed);
            return;
        }
        items_.for_children(i, [&](const item& child) {
            if (items_.reaches(child, items_.box_of(child), box)) mark_faces(child, box);
        });
    }

    const surface_components& components_;
    division_limits limits_;
    component_items items_;
    std::vector<std::uint8_t>& is_undecided_face_;
};

}  // namespace treeform::detail::boolean
