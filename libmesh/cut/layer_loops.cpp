#include <libmesh/cut/layer_loops.hpp>
#include <libmesh/exact/plane_predicates.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace treeform::detail::cut {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

std::uint64_t key_of(const crossing& c) { return std::uint64_t{c.low} << 32 | c.high; }

/// What a face has in the plane: it runs from where the face's outline goes down to where it goes
/// up, so that the outside is to the right, seen from above.
struct side {
    crossing from;
    crossing to;
};

/// Sides that leave and that arrive at each crossing, by a table over those that leave.
class side_table {
  public:
    explicit side_table(const std::vector<side>& sides)
        : sides_(sides),
          slots_(std::bit_ceil(2 * sides.size() + 1), none),
          shift_(64 - std::countr_zero(slots_.size())),
          next_leaving_(sides.size(), none),
          first_arriving_(sides.size(), none),
          next_arriving_(sides.size(), none) {
        for (std::uint32_t i = static_cast<std::uint32_t>(sides.size()); i-- > 0;) {
            std::uint32_t& slot = slots_[place_of(key_of(sides[i].from))];
            next_leaving_[i] = std::exchange(slot, i);
        }
        for (std::uint32_t i = static_cast<std::uint32_t>(sides.size()); i-- > 0;)
            if (const std::uint32_t first = slots_[place_of(key_of(sides[i].to))]; first != none)
                next_arriving_[i] = std::exchange(first_arriving_[first], i);
    }

    /// Calls `visit(leaving, arriving)` with the sides at each crossing that any leaves.
    template <class Visit>
    void for_each(const Visit& visit) const {
        std::vector<std::uint32_t> leaving, arriving;
        for (std::uint32_t i = 0; i < sides_.size(); ++i) {
            if (slots_[place_of(key_of(sides_[i].from))] != i) continue;
            leaving.clear(), arriving.clear();
            for (std::uint32_t j = i; j != none; j = next_leaving_[j]) leaving.push_back(j);
            for (std::uint32_t j = first_arriving_[i]; j != none; j = next_arriving_[j])
                arriving.push_back(j);
            visit(leaving, arriving);
        }
    }

  private:
    /// Where that crossing is, or may be put.
    [[nodiscard]] std::size_t place_of(std::uint64_t key) const {
        std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> shift_);
        while (slots_[at] != none && key_of(sides_[slots_[at]].from) != key)
            at = (at + 1) & (slots_.size() - 1);
        return at;
    }

    const std::vector<side>& sides_;
    std::vector<std::uint32_t> slots_;  ///< the lowest side that leaves there
    int shift_;
    std::vector<std::uint32_t> next_leaving_;
    std::vector<std::uint32_t> first_arriving_;  ///< of the lowest side that leaves
    std::vector<std::uint32_t> next_arriving_;
};

class layer_tracer {
  public:
    layer_tracer(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                 std::span<const std::uint32_t> faces)
        : mesh_(mesh), levels_(levels), k_(k), faces_(faces), sides_(faces.size()) {
        for (std::size_t i = 0; i < faces.size(); ++i) sides_[i] = side_of(mesh.faces[faces[i]]);
        next_.assign(faces.size(), none);
        previous_.assign(faces.size(), none);
    }

    layer_loops trace() {
        side_table(sides_).for_each(
            [&](std::vector<std::uint32_t>& leaving, std::vector<std::uint32_t>& arriving) {
                if (leaving.size() == 1 && arriving.size() == 1)
                    link(arriving[0], leaving[0]);
                else if (!arriving.empty())
                    link_about(leaving, arriving);
            });
        std::vector<chain> all;
        std::vector<std::uint8_t> seen(sides_.size(), 0);
        for (std::uint32_t i = 0; i < sides_.size(); ++i)
            if (seen[i] == 0) all.push_back(chain_at(i, seen));
        if (std::ranges::any_of(all, [](const chain& c) { return !c.closed; })) join_ends(all);
        for (chain& c : all) add(c);
        return std::move(made_);
    }

  private:
    struct chain {
        std::vector<crossing> points;      ///< open: one more than faces
        std::vector<std::uint32_t> faces;  ///< of the side behind each point
        bool closed = false;
        bool oriented = true;
    };

    [[nodiscard]] bool is_above(std::uint32_t point) const { return levels_.level[point] > k_; }

    [[nodiscard]] side side_of(const face& f) const {
        side result{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = f[i], b = f[i == 2 ? 0 : i + 1];
            if (is_above(a) == is_above(b)) continue;
            if (is_above(a))
                result.from = {b, a};
            else
                result.to = {a, b};
        }
        return result;
    }

    void link(std::uint32_t arriving, std::uint32_t leaving) {
        next_[arriving] = leaving;
        previous_[leaving] = arriving;
    }

    /// At an edge of more than two faces: a side that arrives goes on in the one that leaves and is
    /// next to it clockwise, across a wedge of what is inside; what is left over, in any order.
    void link_about(const std::vector<std::uint32_t>& leaving,
                    const std::vector<std::uint32_t>& arriving) {
        struct ray {
            std::uint32_t side;
            std::uint32_t apex;
            bool leaves;
        };
        const crossing edge = sides_[leaving[0]].from;
        std::vector<ray> rays;
        for (const auto* some : {&leaving, &arriving})
            for (const std::uint32_t i : *some)
                for (const std::uint32_t corner : mesh_.faces[faces_[i]])
                    if (corner != edge.low && corner != edge.high)
                        rays.push_back({i, corner, some == &leaving});
        const auto point = [&](std::uint32_t v) -> const point3& { return mesh_.points[v]; };
        const auto turn = [&](std::uint32_t c, std::uint32_t d) {
            return orient3d(point(edge.low), point(edge.high), point(c), point(d));
        };
        const std::uint32_t zero = rays[0].apex;
        const auto half = [&](std::uint32_t c) {  // of a turn, from the first one on, and which
            const int way = turn(zero, c);
            if (way != 0) return way > 0 ? 1 : 3;
            const plane_points p{point(edge.low), point(edge.high), point(zero)};
            return normal_dot(p, {p.a, p.b, point(c)}) > 0 ? 0 : 2;
        };
        std::ranges::stable_sort(rays, [&](const ray& a, const ray& b) {
            const int first = half(a.apex), second = half(b.apex);
            return first != second ? first < second : first % 2 == 1 && turn(a.apex, b.apex) > 0;
        });
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (const ray& next = rays[(i + 1) % rays.size()]; rays[i].leaves && !next.leaves)
                link(next.side, rays[i].side);
        auto in = arriving.begin();
        for (const std::uint32_t out : leaving) {
            if (previous_[out] != none) continue;
            in =
                std::find_if(in, arriving.end(), [&](std::uint32_t i) { return next_[i] == none; });
            if (in != arriving.end()) link(*in, out);
        }
    }

    chain chain_at(std::uint32_t i, std::vector<std::uint8_t>& seen) const {
        chain result;
        std::uint32_t first = i;
        while (previous_[first] != none && previous_[first] != i) first = previous_[first];
        result.closed = previous_[first] == i;
        if (result.closed) first = i;
        std::uint32_t at = first;
        do {
            seen[at] = 1;
            result.points.push_back(sides_[at].from);
            result.faces.push_back(faces_[at]);
            if (next_[at] == none) result.points.push_back(sides_[at].to);
            at = next_[at];
        } while (at != none && at != first);
        return result;
    }

    /// Open chains that end at one edge, which neighbors that disagree have, become one.
    static void join_ends(std::vector<chain>& all) {
        struct free_end {
            std::uint64_t key;
            std::uint32_t chain;
            bool last;
        };
        std::vector<free_end> ends;
        for (std::uint32_t c = 0; c < all.size(); ++c) {
            if (all[c].closed) continue;
            ends.push_back({key_of(all[c].points.front()), c, false});
            ends.push_back({key_of(all[c].points.back()), c, true});
        }
        std::ranges::stable_sort(ends, {}, &free_end::key);
        constexpr std::array<std::uint32_t, 2> no_end{none, none};
        std::vector<std::array<std::uint32_t, 2>> mate(all.size(), no_end);  // end it is joined to
        for (std::uint32_t i = 0; i + 1 < ends.size(); ++i) {
            if (ends[i].key != ends[i + 1].key) continue;
            mate[ends[i].chain][ends[i].last ? 1 : 0] = i + 1;
            mate[ends[i + 1].chain][ends[i + 1].last ? 1 : 0] = i;
            ++i;
        }
        std::vector<std::uint8_t> seen(all.size(), 0);
        std::vector<chain> joined;
        for (std::uint32_t c = 0; c < all.size(); ++c) {
            if (seen[c] != 0) continue;
            if (all[c].closed || mate[c] == no_end) {
                joined.push_back(std::move(all[c]));
                continue;
            }
            // Back to a free end, or around.
            free_end at{0, c, false};
            for (std::uint32_t other = mate[c][0]; other != none;) {
                at = {0, ends[other].chain, !ends[other].last};
                if (at.chain == c && !at.last) break;
                other = mate[at.chain][at.last ? 1 : 0];
            }
            chain made;
            made.oriented = false;
            for (std::uint32_t other = 0; other != none;) {  // from end `at` to the other one
                seen[at.chain] = 1;
                append(made, all[at.chain], at.last);
                other = mate[at.chain][at.last ? 0 : 1];
                if (other == none) break;
                at = {0, ends[other].chain, ends[other].last};
                if (seen[at.chain] != 0) {
                    made.closed = true;
                    made.points.pop_back();
                    break;
                }
            }
            joined.push_back(std::move(made));
        }
        all = std::move(joined);
    }

    static void append(chain& to, chain& more, bool backward) {
        if (backward) {
            std::ranges::reverse(more.points);
            std::ranges::reverse(more.faces);
        }
        if (!to.points.empty()) to.points.pop_back();
        to.points.insert(to.points.end(), more.points.begin(), more.points.end());
        to.faces.insert(to.faces.end(), more.faces.begin(), more.faces.end());
    }

    /// Adds a loop, without points that are the one before, and without sides there and back.
    void add(chain& c) {
        if (!c.closed) c.faces.push_back(c.faces.back());
        std::vector<crossing> points;
        std::vector<std::uint32_t> faces;
        for (std::size_t i = 0; i < c.points.size(); ++i) {
            crossing p = c.points[i];
            if (levels_.is_on(p.high, k_)) p.low = p.high;
            if (points.size() > 1 && points[points.size() - 2] == p)
                points.pop_back(), faces.pop_back();
            if (!points.empty() && points.back() == p) {
                faces.back() = c.faces[i];
                continue;
            }
            points.push_back(p);
            faces.push_back(c.faces[i]);
        }
        std::size_t first = 0, last = points.size();
        const auto at = [&](std::size_t i) -> const crossing& { return points[i]; };
        while (c.closed && last - first > 1) {
            if (at(first) == at(last - 1))
                --last;
            else if (last - first > 2 && at(first) == at(last - 2))
                last -= 2;
            else if (last - first > 2 && at(first + 1) == at(last - 1))
                ++first, --last;
            else
                break;
        }
        if (last - first < (c.closed ? 3U : 2U)) return;
        made_.loops.push_back({made_.points.size(), last - first, c.closed, c.oriented});
        made_.points.insert(made_.points.end(), points.begin() + static_cast<std::ptrdiff_t>(first),
                            points.begin() + static_cast<std::ptrdiff_t>(last));
        made_.faces.insert(made_.faces.end(), faces.begin() + static_cast<std::ptrdiff_t>(first),
                           faces.begin() + static_cast<std::ptrdiff_t>(last));
    }

    mesh_view mesh_;
    const plane_levels& levels_;
    std::uint32_t k_;
    std::span<const std::uint32_t> faces_;
    std::vector<side> sides_;
    std::vector<std::uint32_t> next_, previous_;
    layer_loops made_;
};

}  // namespace

layer_loops loops_of(mesh_view mesh, const plane_levels& levels, std::uint32_t k,
                     std::span<const std::uint32_t> faces) {
    return layer_tracer(mesh, levels, k, faces).trace();
}

}  // namespace treeform::detail::cut
