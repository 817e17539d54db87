#include <libmesh/base/point_math.hpp>
#include <libmesh/exact/filter.hpp>
#include <libmesh/intersect/height_field.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace treeform::detail::intersect {
namespace {

constexpr std::uint64_t key_of(std::uint32_t low, std::uint32_t high) {
    return std::uint64_t{low} << 32 | high;
}

}  // namespace

/// The sign of a determinant of three projected points, or `exact::undecided`. Every difference is
/// off by up to 2 `slack_`, so the determinant u v' - v u' by up to 2 `slack_` times the sum of the
/// magnitudes of all four, and 8 `slack_`^2.
int height_field_test::orient(const point2& a, const point2& b, const point2& c) const {
    if (slack_ == 0.0) return exact::orient2d_filter(a, b, c);
    const point2 u{b.x - a.x, b.y - a.y}, v{c.x - a.x, c.y - a.y};
    const double p = u.x * v.y, q = u.y * v.x;
    const double permanent = std::abs(p) + std::abs(q);
    const double sides = std::abs(u.x) + std::abs(u.y) + std::abs(v.x) + std::abs(v.y);
    const double error = exact::error_factor<exact::orient2d_polynomial> * permanent +
                         slack_ * (2.5 * sides + 10.0 * slack_);
    if (permanent < exact::least_permanent || !(std::abs(p - q) > error)) return exact::undecided;
    return p > q ? 1 : -1;
}

/// Whether a coordinate is certainly below another one, seen in the projection.
bool height_field_test::is_below(double x, double y) const { return x + 3.0 * slack_ < y; }

/// Whether c and d are certainly strictly on the same side of the line from a to b.
bool height_field_test::on_one_side(const point2& a, const point2& b, const point2& c,
                                    const point2& d) const {
    const int sign = orient(a, b, c);
    return (sign == 1 || sign == -1) && orient(a, b, d) == sign;
}

/// Whether the segments from v to a and to b certainly have only v in common.
bool height_field_test::part_at(const point2& v, const point2& a, const point2& b) const {
    const auto between = [this](double low, double x, double high) {
        return (is_below(low, x) && is_below(x, high)) || (is_below(high, x) && is_below(x, low));
    };
    if (between(a.x, v.x, b.x) || between(a.y, v.y, b.y)) return true;
    const int sign = orient(v, a, b);
    return sign == 1 || sign == -1;
}

/// Whether a ray that turns counterclockwise about v from a meets c before b; nothing when the
/// filter does not know.
std::optional<bool> height_field_test::is_between(const point2& v, const point2& a, const point2& c,
                                                  const point2& b) const {
    const int b_of_a = orient(v, a, b);
    const int c_of_a = orient(v, a, c);
    const int b_of_c = orient(v, c, b);
    if (b_of_a == exact::undecided || c_of_a == exact::undecided || b_of_c == exact::undecided)
        return std::nullopt;
    if (b_of_a > 0) return c_of_a > 0 && b_of_c > 0;
    if (b_of_a == 0) return c_of_a > 0;  // opposite
    return c_of_a > 0 || b_of_c > 0;
}

/// Along the axis that some faces face most, or else the way that these face on average; nothing
/// when there, too, not all faces turn the same way.
std::optional<height_field_test::view> height_field_test::find_view(
    std::span<const numbered_face> patch) const {
    constexpr std::size_t most_samples = 32;
    std::array<point3, most_samples> samples;
    std::size_t count = 0;
    point3 normal;
    for (std::size_t i = 0; i < patch.size(); i += (patch.size() - 1) / most_samples + 1) {
        const auto& [a, b, c, number] = patch[i];
        samples[count] =
            base::cross(base::minus(points_[b], points_[a]), base::minus(points_[c], points_[a]));
        normal = base::plus(normal, samples[count++]);
    }
    std::size_t most = 0;
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
        if (std::abs(normal[k]) > std::abs(normal[most])) most = k;
    view seen{most, normal[most] < 0 ? -1 : 1};
    const std::size_t next = (most + 1) % 3, last = (most + 2) % 3;
    const auto samples_turn = [&] {  // mostly they suffice
        return std::ranges::all_of(std::span(samples).first(count), [&](const point3& n) {
            return seen.turn * (n[most] + seen.tilt_1 * n[next] + seen.tilt_2 * n[last]) > 0.0;
        });
    };
    if (samples_turn() && all_turn(patch, seen)) return seen;
    seen.tilt_1 = normal[next] / normal[most];
    seen.tilt_2 = normal[last] / normal[most];
    if (samples_turn() && all_turn_tilted(patch, seen)) return seen;
    return std::nullopt;
}

bool height_field_test::all_turn(std::span<const numbered_face> patch, const view& seen) const {
    constexpr std::size_t ahead = 8;  // corners are anywhere in memory
    const auto fetch = [&](const numbered_face& f) {
        for (std::size_t k = 0; k < 3; ++k) __builtin_prefetch(&points_[f[k]]);
    };
    for (std::size_t i = 0; i < std::min(patch.size(), ahead); ++i) fetch(patch[i]);
    for (std::size_t i = 0; i < patch.size(); ++i) {
        fetch(patch[std::min(i + ahead, patch.size() - 1)]);
        const auto& [a, b, c, number] = patch[i];
        if (exact::orient2d_filter(static_cast<int>(seen.axis), points_[a], points_[b],
                                   points_[c]) != seen.turn)
            return false;
    }
    return true;
}

/// By the determinant of two sides of a face and the line that the projection runs along, which is
/// `orient3d` where the last difference is exact.
bool height_field_test::all_turn_tilted(std::span<const numbered_face> patch,
                                        const view& seen) const {
    const std::size_t k = seen.axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    for (const auto& [a, b, c, number] : patch) {
        const point3 u = base::minus(points_[b], points_[a]);
        const point3 v = base::minus(points_[c], points_[a]);
        double value = 0.0, permanent = 0.0;
        const auto add = [&](std::size_t m, std::size_t n, double factor) {
            const double p = u[m] * v[n], q = u[n] * v[m];
            value += (p - q) * factor;
            permanent += (std::abs(p) + std::abs(q)) * std::abs(factor);
        };
        add(k1, k2, 1.0);
        add(k2, k, seen.tilt_1);
        add(k, k1, seen.tilt_2);
        const double error = exact::error_factor<exact::orient3d_polynomial> * permanent;
        if (permanent < exact::least_permanent || !(seen.turn * value > error)) return false;
    }
    return true;
}

bool height_field_test::operator()(std::span<const numbered_face> patch) {
    assert(!patch.empty() && patch.size() <= max_faces);
    const std::optional<view> seen = find_view(patch);
    return seen && find_border(patch, *seen) && !meets_itself() && winds_once();
}

/// The number of a key; a new one gets the next. Whether it is new nobody can predict, so no branch
/// depends on it.
inline std::uint32_t height_field_test::number_of(std::uint64_t key) {
    keys_[0] = key;  // which a free slot, holding 0, then matches, too
    std::size_t i = key * 0x9E3779B97F4A7C15 >> (64 - slot_bits_);
    while (keys_[slots_[i]] != key) i = (i + 1) % (1U << slot_bits_);
    const std::uint32_t is_new = slots_[i] == 0 ? 1 : 0;
    key_count_ += is_new;
    const std::uint32_t number = slots_[i] | (key_count_ & -is_new);
    slots_[i] = static_cast<std::uint16_t>(number);
    keys_[number] = key;
    return number;
}

/// False when there are more edges than fit.
bool height_field_test::find_border(std::span<const numbered_face> patch, const view& seen) {
    // More slots than keys, of which there are at most six a face: three edges and their corners.
    slot_bits_ = std::min(static_cast<int>(std::bit_width(7 * patch.size())), max_slot_bits);
    std::fill_n(slots_.begin(), std::size_t{1} << slot_bits_, std::uint16_t{0});
    std::fill_n(values_.begin(), std::min(values_.size(), 1 + 6 * patch.size()), std::int16_t{0});
    key_count_ = 0;
    const auto add = [this](std::uint32_t from, std::uint32_t to) {
        // Which way an edge runs nobody can predict either.
        const std::uint64_t there = key_of(from, to), back = key_of(to, from);
        const std::uint64_t is_up = -std::uint64_t{there < back};  // all bits, or none
        const std::uint64_t key = back ^ ((there ^ back) & is_up);
        values_[number_of(key)] += static_cast<std::int16_t>(1 - 2 * static_cast<int>(is_up + 1));
    };
    for (const auto& [a, b, c, number] : patch) {
        add(a, b);
        add(b, c);
        add(c, a);
    }
    border_size_ = 0;
    for (std::size_t i = 1; i <= key_count_; ++i) {
        if (values_[i] == 0) continue;
        if (border_size_ == max_border || values_[i] > 1 || values_[i] < -1) return false;
        border_edge& e = border_[border_size_++];
        e.from = static_cast<std::uint32_t>(keys_[i] >> 32);
        e.to = static_cast<std::uint32_t>(keys_[i]);
        if (values_[i] != seen.turn) std::swap(e.from, e.to);
    }
    project_border(seen);
    return true;
}

/// Relative to a point of the border where the line is tilted. With L the largest magnitude of such
/// a difference, u = 2^-52 and tilts of at most 1, a difference is off by up to u L, its product
/// with a tilt by 2 u L, and what is left by 2 u L more: by less than `slack_` in all, where L is
/// not so small that numbers run out. Boxes contain the edges, though their own sums are rounded.
void height_field_test::project_border(const view& seen) {
    const bool is_tilted = seen.tilt_1 != 0.0 || seen.tilt_2 != 0.0;
    const std::size_t k = seen.axis, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
    const point3 origin = is_tilted ? points_[border_[0].from] : point3{};
    double largest = 0.0;
    const auto projection = [&](std::uint32_t corner) -> point2 {
        const point3& at = points_[corner];
        if (!is_tilted) return {at[k1], at[k2]};
        const point3 p = base::minus(at, origin);
        largest = std::max(largest, base::largest_of(p));
        return {p[k1] - seen.tilt_1 * p[k], p[k2] - seen.tilt_2 * p[k]};
    };
    for (border_edge& e : border()) {
        e.a = projection(e.from);
        e.b = projection(e.to);
    }
    slack_ = is_tilted ? std::max(0x1p-49 * largest, 0x1p-500) : 0.0;
    const double wider = 2.0 * slack_;
    for (border_edge& e : border()) {
        e.min = {std::min(e.a.x, e.b.x) - wider, std::min(e.a.y, e.b.y) - wider};
        e.max = {std::max(e.a.x, e.b.x) + wider, std::max(e.a.y, e.b.y) + wider};
    }
}

/// Edges are sorted into columns by where their boxes start, and tested against those that start up
/// to the column in which their own ends.
bool height_field_test::meets_itself() {
    constexpr std::size_t columns = 64;
    const std::span<const border_edge> edges = border();
    double left = edges[0].min.x, right = left;
    for (const border_edge& e : edges) {
        left = std::min(left, e.min.x);
        right = std::max(right, e.max.x);
    }
    // Not quite all columns, so that rounding leaves none beyond the last.
    const double scale = (columns - 0.5) / (right - left);
    if (!std::isfinite(scale)) return true;
    const auto column = [&](double x) { return static_cast<std::size_t>((x - left) * scale); };
    std::array<std::uint16_t, columns> end{};  // of each in `order`
    for (const border_edge& e : edges) ++end[column(e.min.x)];
    std::partial_sum(end.begin(), end.end(), end.begin());
    std::array<std::uint16_t, max_border> order;
    auto begin = end;
    for (std::size_t e = edges.size(); e-- > 0;)
        order[--begin[column(edges[e].min.x)]] = static_cast<std::uint16_t>(e);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const border_edge& e = edges[order[i]];
        for (std::size_t j = i + 1; j < end[column(e.max.x)]; ++j) {
            const border_edge& f = edges[order[j]];
            if (((e.min.y <= f.max.y) & (f.min.y <= e.max.y) & (f.min.x <= e.max.x)) != 0 &&
                !are_apart(e, f))
                return true;
        }
    }
    return false;
}

/// Whether two edges certainly have nothing in common but a corner by number.
bool height_field_test::are_apart(const border_edge& e, const border_edge& f) const {
    if (e.to == f.from) return part_at(e.b, e.a, f.b);
    if (e.from == f.to) return part_at(e.a, e.b, f.a);
    if (e.from == f.from) return part_at(e.a, e.b, f.b);
    if (e.to == f.to) return part_at(e.b, e.a, f.a);
    return on_one_side(e.a, e.b, f.a, f.b) || on_one_side(f.a, f.b, e.a, e.b);
}

/// Given that edges meet only in corners they share. Where two edges leave a corner and two arrive,
/// one by one around it, the winding number on the right is the same at all four. So it is the same
/// along a whole component of the border, and must be 0. It is along the outermost component, since
/// no number of faces is below 0.
bool height_field_test::winds_once() {
    bool branches = false;
    for (std::uint32_t e = 0; e < border_size_; ++e) {
        std::int16_t& leaving = values_[number_of(key_of(border_[e].from, border_[e].from))];
        if (leaving != 0 && !alternates(border_[e].from)) return false;
        branches = branches || leaving != 0;
        leaving = static_cast<std::int16_t>(e + 1);
    }
    std::size_t length = 0;
    std::uint32_t at = 0;
    do at = edge_from(border_[at].to);
    while (++length < border_size_ && at != 0);
    if (!branches && length == border_size_) return true;  // one loop

    find_components();
    for (std::uint32_t e = 0; e < border_size_; ++e)
        if (component_[e] == e && !starts_outside(e)) return false;
    return true;
}

/// An edge from a corner of the border; the same one each time.
std::uint32_t height_field_test::edge_from(std::uint32_t corner) {
    return static_cast<std::uint32_t>(values_[number_of(key_of(corner, corner))] - 1);
}

void height_field_test::find_components() {
    for (std::uint32_t e = 0; e < border_size_; ++e) component_[e] = e;
    const auto root = [&](std::uint32_t e) {
        while (component_[e] != e) e = component_[e];
        return e;
    };
    for (std::uint32_t e = 0; e < border_size_; ++e)
        for (const std::uint32_t corner : {border_[e].from, border_[e].to}) {
            const std::uint32_t x = root(e), y = root(edge_from(corner));
            component_[std::max(x, y)] = std::min(x, y);
        }
    for (std::uint32_t e = 0; e < border_size_; ++e) component_[e] = component_[component_[e]];
}

/// Whether two edges certainly arrive at `corner` and two leave, in turn.
bool height_field_test::alternates(std::uint32_t corner) {
    std::array<point2, 2> in, out;
    std::size_t ins = 0, outs = 0;
    point2 at;
    for (const border_edge& e : border()) {
        if (e.from == corner) {
            if (outs == 2) return false;
            out[outs++] = e.b;
            at = e.a;
        }
        if (e.to == corner) {
            if (ins == 2) return false;
            in[ins++] = e.a;
        }
    }
    const auto first = is_between(at, out[0], in[0], out[1]);
    const auto second = is_between(at, out[0], in[1], out[1]);
    return first && second && *first != *second;
}

/// Whether the winding number on the right of a component is 0. At its lowest point, in the order
/// of x, then y, the component has the outside of itself before it, where only others count.
bool height_field_test::starts_outside(std::uint32_t component) {
    const std::span<const border_edge> edges = border();
    const auto before = [](const point2& p, const point2& q) {
        return p.x != q.x ? p.x < q.x : p.y < q.y;
    };
    const border_edge* out = nullptr;
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (component_[e] == component && (out == nullptr || before(edges[e].a, out->a)))
            out = &edges[e];
    const border_edge* in = nullptr;
    for (const border_edge& e : edges) {
        if (e.from == out->from && &e != out) return false;
        if (e.to == out->from) in = &e;
    }
    if (slack_ != 0.0)
        for (std::size_t e = 0; e < edges.size(); ++e)
            if (component_[e] == component && &edges[e] != out && !is_below(out->a.x, edges[e].a.x))
                return false;
    int outside = 0;  // by the edges that the ray toward lower x crosses
    const point2& p = out->a;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const border_edge& e = edges[i];
        if (slack_ != 0.0 && component_[i] != component && !is_below(e.a.y, p.y) &&
            !is_below(p.y, e.a.y))
            return false;
        if (component_[i] == component || (e.a.y <= p.y) == (e.b.y <= p.y)) continue;
        const int sign = orient(e.a, e.b, p);
        if (sign != 1 && sign != -1) return false;
        const int if_crossed = e.a.y <= p.y ? -1 : 1;
        if (sign == if_crossed) outside += sign;
    }
    const int turn = orient(in->a, p, out->b);
    return turn == 1 ? outside == 0 : turn == -1 && outside == 1;
}

}  // namespace treeform::detail::intersect
