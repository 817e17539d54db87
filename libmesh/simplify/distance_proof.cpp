#include <libmesh/simplify/distance_proof.hpp>
#include <libmesh/simplify/seen_along.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace treeform::detail::simplify {
namespace {

constexpr double shrunk_by = 0x1p-36;

[[nodiscard]] aabb<double, 3> box_around(const triangle3& t, double margin) {
    aabb<double, 3> box;
    for (const point3& p : t) box.include(p);
    for (std::size_t axis = 0; axis < 3; ++axis) box.min[axis] -= margin, box.max[axis] += margin;
    return box;
}

[[nodiscard]] bool overlaps(const aabb<double, 3>& a, const triangle3& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (low > a.max[axis] || high < a.min[axis]) return false;
    }
    return true;
}

[[nodiscard]] bool has(const ids& ascending, std::uint32_t value) {
    return std::ranges::binary_search(ascending, value);
}

}  // namespace

distance_proof::distance_proof(mesh_view given, const connected_faces& now, double largest,
                               double limit)
    : mates_(now.mates), limit_(limit), covering_(largest) {
    faces_.resize(now.faces.size());
    near_given_.resize(faces_.size());
    visited_.resize(faces_.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        given_.push_back(base::triangle_of(given, now.source[f]));
        bounded& face = faces_[f];
        face.now = base::triangle_of(now.points, now.faces[f]);
        face.near = near_given_[f] = {f};
        for (std::size_t i = 0; i < 3; ++i) {  // rounded to the precision
            const point3 way = base::minus(face.now[i], given_[f][i]);
            if (way == point3{}) continue;
            face.there = std::max(face.there, (1.0 + 0x1p-50) * std::sqrt(base::dot(way, way)));
            face.back = face.there;
        }
    }
}

void distance_proof::find_affected(const change& c) {
    affected_.clear();
    for (const std::uint32_t f : c.old)
        affected_.insert(affected_.end(), faces_[f].near.begin(), faces_[f].near.end());
    std::ranges::sort(affected_);
    affected_.erase(std::unique(affected_.begin(), affected_.end()), affected_.end());
}

bool distance_proof::holds(const change& c) {
    made_.resize(c.kept.size());
    raised_.clear();
    for (std::size_t i = 0; i < made_.size(); ++i) {
        made_[i].now = c.after[i];
        made_[i].there = made_[i].back = 0.0;
        made_[i].near.clear();
    }
    if (c.same_rim && holds_by_step(c)) {
        find_affected(c);
        for (bounded& made : made_) {
            const auto reach = box_around(made.now, std::max(made.there, made.back));
            for (const std::uint32_t t : affected_)
                if (overlaps(reach, given_[t])) made.near.push_back(t);
        }
        return true;
    }
    return holds_anew(c);
}

/// Old and new disks have one rim, and all faces of both face the eye: of each place in view, they
/// cover it equally often, and where one does, so does the other.
bool distance_proof::holds_by_step(const change& c) {
    point3 along;
    for (const triangle3& t : c.before) along = base::plus(along, normal_of(t));
    if (!(base::dot(along, along) > 0.0)) return false;
    const view_along view(along, c.after[0][0]);
    std::vector<seen_triangle> before, after;
    const auto see = [&](const std::vector<triangle3>& all, std::vector<seen_triangle>& seen) {
        return std::ranges::all_of(all, [&](const triangle3& t) {
            seen.push_back(view.see(t));
            return view.faces_eye(t, seen.back());
        });
    };
    if (!see(c.after, after) || !see(c.before, before)) return false;
    for (std::size_t i = 0; i < made_.size(); ++i)
        for (std::size_t j = 0; j < c.old.size(); ++j)
            if (const std::optional<double> gap = gap_between(before[j], after[i])) {
                made_[i].there = std::max(made_[i].there, faces_[c.old[j]].there + *gap);
                made_[i].back = std::max(made_[i].back, faces_[c.old[j]].back + *gap);
                if (made_[i].there > limit_ || made_[i].back > limit_) return false;
            }
    return true;
}

bool distance_proof::holds_anew(const change& c) {
    find_affected(c);
    for (bounded& made : made_) made.there = made.back = 0.0;
    if (!covers_there(c)) return false;
    for (std::size_t i = 0; i < made_.size(); ++i)
        if (!is_under(i, c.after[i]) && !covers_back(i, c.after[i])) return false;
    for (bounded& made : made_) {
        std::ranges::sort(made.near);
        made.near.erase(std::unique(made.near.begin(), made.near.end()), made.near.end());
    }
    return true;
}

bool distance_proof::covers_there(const change& c) {
    targets_.clear();
    for (const triangle3& t : c.after) targets_.emplace_back(t);
    ids others;
    if (const auto last = std::ranges::find(affected_, too_far_); last != affected_.end())
        std::rotate(affected_.begin(), last, last + 1);
    for (const std::uint32_t t : affected_) {
        too_far_ = t;
        targets_.resize(c.after.size());
        others.clear();
        for (const std::uint32_t f : near_given_[t])
            if (!has(c.old, f)) {
                others.push_back(f);
                targets_.emplace_back(faces_[f].now);
            }
        if (!covering_.cover(given_[t], targets_, limit_)) return false;
        for (const covering::use& use : covering_.used())
            if (use.number < made_.size()) {
                bounded& made = made_[use.number];
                made.there = std::max(made.there, use.at_most);
                made.near.push_back(t);
            } else {
                raised_.push_back({others[use.number - made_.size()], use.at_most});
            }
    }
    return true;
}

/// Whether the input, seen along the face, covers it no further away than the limit. What is seen of
/// it grows from a triangle that covers some of it, across all sides of those that cover more. The
/// face is made smaller by `rim` first, so that what only touches it does not count.
bool distance_proof::is_under(std::size_t i, const triangle3& t) {
    const point3 normal = normal_of(t);
    if (!(base::dot(normal, normal) > 0.0)) return false;
    const view_along view(normal, t[0]);
    seen_triangle seen = view.see(t);
    if (!view.faces_eye(t, seen)) return false;
    const double rim = shrunk_by * extent_of(seen);
    // On no line of a grid, where triangles end.
    const point3 middle =
        base::plus(base::scaled(seen[0], 0.3717),
                   base::plus(base::scaled(seen[1], 0.3391), base::scaled(seen[2], 0.2892)));
    for (point3& p : seen)
        p = base::plus(p, base::scaled(base::minus(middle, p), 0.25 * shrunk_by));
    waiting_.clear();
    ++visit_;
    double worst = 0.0;
    const auto is_start = [&](std::uint32_t g) {
        const seen_triangle at = view.see(given_[g]);
        if (!is_seen_within(at, middle) || !view.faces_eye(given_[g], at)) return false;
        const std::optional<double> gap = gap_between(at, seen);
        return gap && *gap <= limit_;
    };
    const auto start = std::ranges::find_if(affected_, is_start);
    if (start == affected_.end()) return false;
    waiting_.push_back(*start);
    visited_[*start] = visit_;
    const std::size_t before = made_[i].near.size();
    const auto fails = [&] {
        made_[i].near.resize(before);
        return false;
    };
    while (!waiting_.empty()) {
        const std::uint32_t g = waiting_.back();
        waiting_.pop_back();
        const seen_triangle at = view.see(given_[g]);
        const std::optional<double> gap = gap_between(at, seen);
        if (!gap) continue;
        if (*gap + rim > limit_ || !view.faces_eye(given_[g], at)) return fails();
        worst = std::max(worst, *gap);
        made_[i].near.push_back(g);
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t mate = mates_[g][side];
            const point3 &p = at[side], &q = at[(side + 1) % 3];
            if (mate == no_face && gap_between({p, q, q}, seen)) return fails();
            if (mate == no_face || visited_[mate] == visit_) continue;
            visited_[mate] = visit_;
            waiting_.push_back(mate);
        }
    }
    made_[i].back = worst + rim;
    return true;
}

bool distance_proof::covers_back(std::size_t i, const triangle3& t) {
    targets_.clear();
    for (const std::uint32_t g : affected_) targets_.emplace_back(given_[g]);
    if (!covering_.cover(t, targets_, limit_)) return false;
    for (const covering::use& use : covering_.used()) {
        made_[i].back = std::max(made_[i].back, use.at_most);
        made_[i].near.push_back(affected_[use.number]);
    }
    return true;
}

void distance_proof::accept(const change& c) {
    for (const std::uint32_t t : affected_)
        std::erase_if(near_given_[t], [&](std::uint32_t f) { return has(c.old, f); });
    for (const std::uint32_t f : c.old) faces_[f] = {};
    for (const covering::use& other : raised_)
        faces_[other.number].there = std::max(faces_[other.number].there, other.at_most);
    for (std::size_t i = 0; i < made_.size(); ++i) {
        for (const std::uint32_t t : made_[i].near) near_given_[t].push_back(c.kept[i]);
        std::swap(faces_[c.kept[i]], made_[i]);
    }
}

}  // namespace treeform::detail::simplify
