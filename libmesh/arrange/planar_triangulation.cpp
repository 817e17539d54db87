#include <libmesh/arrange/planar_triangulation.hpp>
#include <libmesh/exact/implicit_filter.hpp>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace treeform::detail::arrange {
namespace {

std::array<double, 2> plan_of(const implicit_point& p, int axis) {
    const point3& c = p.center();
    return axis == 0   ? std::array{c.y, c.z}
           : axis == 1 ? std::array{c.z, c.x}
                       : std::array{c.x, c.y};
}

}  // namespace

planar_triangulation::planar_triangulation(
    std::pmr::vector<implicit_point> points,
    std::pmr::vector<std::pmr::vector<std::uint32_t>> lines_of, int axis, int orientation,
    crossing cross)
    : points_(std::move(points)),
      plan_(points_.get_allocator()),
      lines_of_(std::move(lines_of)),
      made_by_(points_.get_allocator()),
      origin_(points_.get_allocator()),
      twin_(points_.get_allocator()),
      line_(points_.get_allocator()),
      leaving_(points_.size(), none, points_.get_allocator()),
      opposite_(points_.get_allocator()),
      given_(points_.size()),
      axis_(axis),
      orientation_(orientation),
      cross_(std::move(cross)) {
    plan_.reserve(points_.size());
    // Each point splits a triangle in three, or two in four.
    for (auto* const of_half_edge : {&origin_, &twin_, &line_})
        of_half_edge->reserve(6 * points_.size());
    for (const implicit_point& p : points_) plan_.push_back(plan_of(p, axis_));
    add_triangle();
    for (std::uint32_t i = 0; i < 3; ++i) set(i, i, none, none);
}

void planar_triangulation::note_line(std::uint32_t p, std::uint32_t line) {
    auto& lines = lines_of_[p];
    const auto at = std::lower_bound(lines.begin(), lines.end(), line);
    if (at == lines.end() || *at != line) lines.insert(at, line);
}

bool planar_triangulation::known_collinear(std::uint32_t a, std::uint32_t b,
                                           std::uint32_t c) const {
    // Hundreds of lines may pass through a corner of a fan, and two through a point that was made.
    std::array of = {&lines_of_[a], &lines_of_[b], &lines_of_[c]};
    if (of[1]->size() < of[0]->size()) std::swap(of[0], of[1]);
    if (of[2]->size() < of[0]->size()) std::swap(of[0], of[2]);
    return std::ranges::any_of(*of[0], [&](std::uint32_t line) {
        return std::ranges::binary_search(*of[1], line) && std::ranges::binary_search(*of[2], line);
    });
}

int planar_triangulation::turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const implicit_point &p = points_[a], &q = points_[b], &r = points_[c];
    const int sign =
        exact::orient2d_filter(axis_, exact::ball_of(p), exact::ball_of(q), exact::ball_of(r));
    if (sign != exact::undecided) return orientation_ * sign;
    return known_collinear(a, b, c) ? 0 : orientation_ * orient2d(axis_, p, q, r);
}

bool planar_triangulation::is_ahead(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == axis_) continue;
        const int to_b = compare(axis, points_[b], points_[a]);
        if (to_b != 0) return compare(axis, points_[c], points_[a]) == to_b;
    }
    return false;
}

void planar_triangulation::set(half_edge h, std::uint32_t origin, half_edge twin,
                               std::uint32_t line) {
    origin_[h] = origin;
    twin_[h] = twin;
    line_[h] = line;
    if (twin != none) twin_[twin] = h;
    leaving_[origin] = h;
}

std::uint32_t planar_triangulation::add_triangle() {
    const std::size_t size = origin_.size();
    origin_.resize(size + 3);
    twin_.resize(size + 3, none);
    line_.resize(size + 3, none);
    return static_cast<std::uint32_t>(size / 3);
}

/// The half-edges that begin at a vertex, each once.
class planar_triangulation::star {
  public:
    star(const planar_triangulation& of, std::uint32_t vertex)
        : of_(of), start_(of.leaving_[vertex]), at_(start_) {}

    /// None after the last.
    half_edge next() {
        const half_edge now = at_;
        if (now == none) return none;
        at_ = is_back_ ? before(now) : of_.twin_[previous(now)];
        if (is_back_) return now;
        if (at_ == start_)
            at_ = none;          // all around
        else if (at_ == none) {  // the rim: on the other way round
            is_back_ = true;
            at_ = before(start_);
        }
        return now;
    }

  private:
    [[nodiscard]] half_edge before(half_edge h) const {
        const half_edge twin = of_.twin_[h];
        return twin == none ? none : planar_triangulation::next(twin);
    }

    const planar_triangulation& of_;
    half_edge start_;
    half_edge at_;
    bool is_back_ = false;
};

/// Calls `visit` with the half-edges that begin at the vertex until it returns true.
template <class Visit>
void planar_triangulation::around(std::uint32_t vertex, const Visit& visit) const {
    star of(*this, vertex);
    for (half_edge h = of.next(); h != none; h = of.next())
        if (visit(h)) return;
}

/// In the stars of both at the same time: one may be a thousand times as large as the other.
planar_triangulation::half_edge planar_triangulation::find(std::uint32_t from,
                                                           std::uint32_t to) const {
    star of_from(*this, from), of_to(*this, to);
    for (;;) {
        const half_edge leaving = of_from.next();
        if (leaving == none || target(leaving) == to) return leaving;
        const half_edge after = of_to.next();
        if (after == none) return none;
        if (origin_[previous(after)] == from) return previous(after);
    }
}

planar_triangulation::half_edge planar_triangulation::side_between(std::uint32_t u,
                                                                   std::uint32_t v) const {
    const half_edge h = find(u, v);
    return h != none ? h : find(v, u);
}

std::uint32_t planar_triangulation::left_of(std::uint32_t from, std::uint32_t to) const {
    const half_edge h = find(from, to);
    if (h == none) throw std::logic_error("treeform::planar_triangulation: no such side");
    return h / 3;
}

/// The first side of triangle t, from its `first` on, that p lies beyond; none when p is in the
/// closed triangle, and then `found` says where. p is known not to be beyond side `from`.
planar_triangulation::half_edge planar_triangulation::side_toward(std::uint32_t t, std::uint32_t p,
                                                                  std::uint32_t first,
                                                                  half_edge from,
                                                                  place& found) const {
    found = {3 * t, 0};
    half_edge zeros[3];
    for (std::uint32_t i = 0; i < 3; ++i) {
        const half_edge h = 3 * t + (first + i) % 3;
        if (h == from) continue;
        const int sign = turn(origin_[h], target(h), p);
        if (sign < 0) return h;
        if (sign == 0) zeros[found.on_sides++] = h;
    }
    if (found.on_sides == 1) found.at = zeros[0];
    if (found.on_sides == 2) found.at = next(zeros[0]) == zeros[1] ? zeros[1] : zeros[0];
    return none;
}

planar_triangulation::place planar_triangulation::locate(std::uint32_t p) {
    // A walk that turns to a side p lies beyond. In a triangulation that is not Delaunay it may
    // run in circles: then every triangle is looked at.
    std::uint32_t t = last_;
    std::uint32_t first = 0;
    half_edge from = none;
    place found{};
    for (std::size_t steps = 4 * triangle_count() + 16; steps > 0; --steps) {
        first = (first + 1) % 3;
        const half_edge beyond = side_toward(t, p, first, from, found);
        if (beyond == none) return found;
        from = twin_[beyond];
        if (from == none) break;
        t = from / 3;
    }
    for (t = 0; t < triangle_count(); ++t)
        if (side_toward(t, p, 0, none, found) == none) return found;
    throw std::logic_error("treeform::planar_triangulation: point " + std::to_string(p) +
                           " is outside of the triangulation");
}

std::uint32_t planar_triangulation::insert(std::uint32_t point) {
    if (leaving_[point] != none) return point;
    const place at = locate(point);
    last_ = at.at / 3;
    if (at.on_sides == 2) {
        for (const std::uint32_t line : lines_of_[point]) note_line(origin_[at.at], line);
        return origin_[at.at];
    }
    if (at.on_sides == 1) {
        if (line_[at.at] != none) note_line(point, line_[at.at]);
        split_side(at.at, point);
    } else {
        split_triangle(at.at / 3, point);
    }
    improve_around(point);
    return point;
}

void planar_triangulation::split_triangle(std::uint32_t t, std::uint32_t p) {
    const half_edge ab = 3 * t, bc = ab + 1, ca = ab + 2;
    const std::uint32_t a = origin_[ab], b = origin_[bc], c = origin_[ca];
    const half_edge u = 3 * add_triangle();
    const half_edge v = 3 * add_triangle();
    set(u, b, twin_[bc], line_[bc]);
    set(v, c, twin_[ca], line_[ca]);
    set(bc, b, none, none);
    set(ca, p, none, none);
    set(u + 1, c, none, none);
    set(u + 2, p, bc, none);
    set(v + 1, a, ca, none);
    set(v + 2, p, u + 1, none);
}

void planar_triangulation::split_side(half_edge h, std::uint32_t p) {
    const half_edge g = twin_[h];
    const std::uint32_t line = line_[h];
    const half_edge hn = next(h), hp = previous(h);
    const std::uint32_t b = origin_[hn], c = origin_[hp];
    const half_edge u = 3 * add_triangle();
    // a b c becomes a p c and p b c.
    set(u, p, none, line);
    set(u + 1, b, twin_[hn], line_[hn]);
    set(hn, p, none, none);
    set(u + 2, c, hn, none);
    if (g == none) return;
    // b a d becomes b p d and p a d.
    const half_edge gn = next(g), gp = previous(g);
    const std::uint32_t a = origin_[gn], d = origin_[gp];
    const half_edge v = 3 * add_triangle();
    set(v, p, h, line);
    set(v + 1, a, twin_[gn], line_[gn]);
    set(gn, p, none, none);
    set(v + 2, d, gn, none);
    set(g, b, u, line);
}

/// a b c and b a d, with h from a to b, become d b c and c a d, with h from c to d.
void planar_triangulation::flip(half_edge h) {
    const half_edge g = twin_[h];
    const half_edge hn = next(h), hp = previous(h), gn = next(g), gp = previous(g);
    const std::uint32_t a = origin_[h], b = origin_[g], c = origin_[hp], d = origin_[gp];
    const half_edge bc = twin_[hn], ca = twin_[hp], ad = twin_[gn], db = twin_[gp];
    const std::uint32_t on_bc = line_[hn], on_ca = line_[hp], on_ad = line_[gn], on_db = line_[gp];
    set(h, c, g, none);
    set(g, d, h, none);
    set(hn, d, db, on_db);
    set(hp, b, bc, on_bc);
    set(gn, c, ca, on_ca);
    set(gp, a, ad, on_ad);
}

/// Whether both triangles at the side can be exchanged for the other two of their quadrilateral.
bool planar_triangulation::can_flip(half_edge h) const {
    const half_edge g = twin_[h];
    const std::uint32_t a = origin_[h], b = origin_[g], c = apex(h), d = apex(g);
    return turn(d, b, c) > 0 && turn(c, a, d) > 0;
}

/// Whether the other diagonal makes better triangles, as far as doubles tell.
bool planar_triangulation::wants_flip(half_edge h) const {
    if (line_[h] != none || twin_[h] == none) return false;
    const auto& d = plan_[apex(twin_[h])];
    const auto relative = [&](std::uint32_t v) {
        return std::array{plan_[v][0] - d[0], plan_[v][1] - d[1]};
    };
    const auto a = relative(origin_[h]), b = relative(target(h)), c = relative(apex(h));
    const auto square = [](const std::array<double, 2>& v) { return v[0] * v[0] + v[1] * v[1]; };
    const auto cross = [](const std::array<double, 2>& v, const std::array<double, 2>& w) {
        return v[0] * w[1] - v[1] * w[0];
    };
    const double inside =
        square(a) * cross(b, c) + square(b) * cross(c, a) + square(c) * cross(a, b);
    // Well inside only: four points near a circle are left as they are.
    const double size = square(a) * std::abs(cross(b, c)) + square(b) * std::abs(cross(c, a)) +
                        square(c) * std::abs(cross(a, b));
    return orientation_ * inside > 1e-10 * size;
}

/// Each flip adds a side at p, so there are no more of them than points.
void planar_triangulation::improve_around(std::uint32_t p) {
    std::pmr::vector<half_edge>& opposite = opposite_;
    around(p, [&](half_edge h) {
        opposite.push_back(next(h));
        return false;
    });
    while (!opposite.empty()) {
        const half_edge h = opposite.back();
        opposite.pop_back();
        if (apex(h) != p || !wants_flip(h) || !can_flip(h)) continue;
        const half_edge g = twin_[h];
        flip(h);
        opposite.push_back(next(h));
        opposite.push_back(previous(g));
    }
}

void planar_triangulation::mark(half_edge h, std::uint32_t line) {
    if (line_[h] != none) return;
    line_[h] = line;
    if (twin_[h] != none) line_[twin_[h]] = line;
}

std::uint32_t planar_triangulation::make_crossing(half_edge side, std::uint32_t line) {
    const std::uint32_t other = line_[side];
    const auto p = static_cast<std::uint32_t>(points_.size());
    points_.push_back(cross_(line, other));
    plan_.push_back(plan_of(points_.back(), axis_));
    lines_of_.emplace_back(
        std::initializer_list<std::uint32_t>{std::min(line, other), std::max(line, other)});
    made_by_.emplace_back(line, other);
    leaving_.push_back(none);
    split_side(side, p);
    return p;
}

planar_triangulation::star_exit planar_triangulation::leave(std::uint32_t from,
                                                            std::uint32_t to) const {
    star_exit out;
    around(from, [&](half_edge h) {
        const std::uint32_t right = target(h), left = apex(h);
        const int of_right = turn(from, to, right);
        if (of_right == 0 && is_ahead(from, to, right)) out.met = right;
        if (out.met != none || of_right > 0) return out.met != none;
        const int of_left = turn(from, to, left);
        if (of_left == 0 && is_ahead(from, to, left)) out.met = left;
        if (of_right < 0 && of_left > 0) out.crossed = next(h);
        return out.met != none || out.crossed != none;
    });
    if (out.met == none && out.crossed == none)
        throw std::logic_error("treeform::planar_triangulation: a segment leads out of the plane");
    return out;
}

std::uint32_t planar_triangulation::advance(std::uint32_t from, std::uint32_t to,
                                            std::uint32_t line) {
    if (const half_edge h = side_between(from, to); h != none) {
        mark(h, line);
        return to;
    }
    auto [met, crossed] = leave(from, to);
    if (met != none) {
        mark(side_between(from, met), line);
        return met;
    }
    // The sides between here and the next vertex on the way.
    side_queue sides(points_.get_allocator());
    for (;;) {
        if (line_[crossed] != none) {
            const std::uint32_t made = make_crossing(crossed, line);
            return advance(from, made, line);
        }
        sides.push_back({origin_[crossed], target(crossed)});
        const half_edge beyond = twin_[crossed];
        if (beyond == none)
            throw std::logic_error(
                "treeform::planar_triangulation: a segment leads out of the plane");
        const std::uint32_t v = apex(beyond);
        if (v == to) break;
        const int of_v = turn(from, to, v);
        if (of_v == 0) {
            to = v;
            break;
        }
        crossed = of_v > 0 ? next(beyond) : previous(beyond);
    }
    std::pmr::vector<std::array<std::uint32_t, 2>> fresh = flip_away(from, to, sides);
    const half_edge h = side_between(from, to);
    if (h == none) throw std::logic_error("treeform::planar_triangulation: a segment was not made");
    mark(h, line);
    improve(fresh);
    return to;
}

std::pmr::vector<std::array<std::uint32_t, 2>> planar_triangulation::flip_away(std::uint32_t from,
                                                                               std::uint32_t to,
                                                                               side_queue& sides) {
    std::pmr::vector<std::array<std::uint32_t, 2>> fresh(points_.get_allocator());
    std::size_t steps = 0;
    const std::size_t most = 16 + 16 * sides.size() * sides.size();
    while (!sides.empty()) {
        const auto [u, v] = sides.front();
        sides.pop_front();
        if (++steps > most)
            throw std::logic_error("treeform::planar_triangulation: no end of flips");
        const half_edge h = find(u, v);
        if (!can_flip(h)) {
            sides.push_back({u, v});
            continue;
        }
        flip(h);
        const std::uint32_t c = origin_[h], d = target(h);
        const bool crosses = c != from && c != to && d != from && d != to &&
                             turn(from, to, c) * turn(from, to, d) < 0;
        if (crosses)
            sides.push_back({c, d});
        else
            fresh.push_back({c, d});
    }
    return fresh;
}

/// Flips among the sides that forcing a segment has made, a bounded number of times.
void planar_triangulation::improve(std::pmr::vector<std::array<std::uint32_t, 2>>& sides) {
    for (int rounds = 0; rounds < 4; ++rounds) {
        bool changed = false;
        for (auto& [u, v] : sides) {
            const half_edge h = find(u, v);
            if (h == none || !wants_flip(h) || !can_flip(h)) continue;
            flip(h);
            u = origin_[h];
            v = target(h);
            changed = true;
        }
        if (!changed) return;
    }
}

std::pmr::vector<std::uint32_t> planar_triangulation::constrain(std::uint32_t from,
                                                                std::uint32_t to,
                                                                std::uint32_t line) {
    std::pmr::vector<std::uint32_t> way(1, from, points_.get_allocator());
    note_line(from, line);
    note_line(to, line);
    while (way.back() != to) {
        way.push_back(advance(way.back(), to, line));
        note_line(way.back(), line);
    }
    return way;
}

}  // namespace treeform::detail::arrange
