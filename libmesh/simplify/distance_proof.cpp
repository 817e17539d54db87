#include <libmesh/simplify/distance_proof.hpp>
#include <treeform/tree/search.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace treeform::detail::simplify {
namespace {

constexpr double rim_share = 0x1p-6;  ///< of the limit

[[nodiscard]] aabb<double, 3> box_around(const triangle3& t, double margin) {
    aabb<double, 3> box;
    for (const point3& p : t) box.include(p);
    for (std::size_t axis = 0; axis < 3; ++axis) box.min[axis] -= margin, box.max[axis] += margin;
    return box;
}

/// Around what is within a margin of a triangle: a box, and planes along its sides.
class surroundings {
  public:
    /// \param margin with 2^-48 of the largest coordinate for rounding: whatever directions come to,
    ///        planes are where corners and margin put them, to 17 u of that
    surroundings(const triangle3& t, double margin) : box_(box_around(t, margin)) {
        const point3 normal = normal_of(t);
        for (std::size_t i = 0; i < 3; ++i) {
            out_[i] = unit_of(base::cross(base::minus(t[(i + 1) % 3], t[i]), normal));
            limit_[i] = margin + std::ranges::max(along(t, out_[i]));
        }
    }
    [[nodiscard]] bool may_meet(const triangle3& t, const aabb<double, 3>& box) const {
        bool may = overlaps(box_, box);
        for (std::size_t i = 0; i < 3 && may; ++i)
            may = !(std::ranges::min(along(t, out_[i])) > limit_[i]);
        return may;
    }

  private:
    [[nodiscard]] static std::array<double, 3> along(const triangle3& t, const point3& way) {
        return {base::dot(t[0], way), base::dot(t[1], way), base::dot(t[2], way)};
    }

    aabb<double, 3> box_;
    std::array<point3, 3> out_{};
    std::array<double, 3> limit_{};
};

[[nodiscard]] bool has(const ids& ascending, std::uint32_t value) {
    return std::ranges::binary_search(ascending, value);
}

}  // namespace

distance_proof::distance_proof(mesh_view given, const connected_faces& now, double largest,
                               double limit)
    : limit_(limit), rounding_(0x1p-48 * largest), covering_(largest) {
    faces_.resize(now.faces.size());
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        const triangle3 corners = base::triangle_of(given, now.source[f]);
        given_.push_back({corners, box_around(corners, 0.0), now.mates[f]});
        bounded& face = faces_[f];
        face.now = base::triangle_of(now.points, now.faces[f]);
        face.near = {f};
        for (std::size_t i = 0; i < 3; ++i) {  // rounded to the precision
            const point3 way = base::minus(face.now[i], corners[i]);
            if (way == point3{}) continue;
            face.there = std::max(face.there, (1.0 + 0x1p-50) * std::sqrt(base::dot(way, way)));
            face.back = face.there;
        }
    }
}

void distance_proof::make_room(const change& c) {
    made_.resize(c.kept.size());
    for (std::size_t i = 0; i < made_.size(); ++i) {
        made_[i].now = c.after[i];
        made_[i].there = made_[i].back = 0.0;
        made_[i].near.clear();
    }
}

/// Triangles of the input in lists of old faces.
void distance_proof::find_affected(const change& c) {
    raised_.clear();
    affected_.clear();
    ++visit_;
    for (const std::uint32_t f : c.old)
        for (const std::uint32_t t : faces_[f].near)
            if (std::exchange(given_[t].visited, visit_) != visit_) affected_.push_back(t);
}

/// Old and new disks have one rim, and all faces of both face the eye: of each place in view, they
/// cover it equally often, and where one does, so does the other.
bool distance_proof::holds_by_step(const change& c) {
    make_room(c);
    if (!c.same_rim) return false;
    point3 along;
    for (const auto* all : {&c.before, &c.after})
        for (const triangle3& t : *all) along = base::plus(along, unit_of(normal_of(t)));
    if (!(base::dot(along, along) > 0.0)) return false;
    const view_along view(along, c.after[0][0]);
    const auto see = [&](const std::vector<triangle3>& all, std::vector<seen_triangle>& seen) {
        seen.clear();
        return std::ranges::all_of(all, [&](const triangle3& t) {
            seen.push_back(view.see(t));
            return view.faces_eye(t, seen.back());
        });
    };
    if (!see(c.after, seen_after_) || !see(c.before, seen_before_)) return false;
    for (std::size_t i = 0; i < made_.size(); ++i)
        for (std::size_t j = 0; j < c.old.size(); ++j)
            if (const std::optional<double> gap = gap_between(seen_before_[j], seen_after_[i])) {
                made_[i].there = std::max(made_[i].there, faces_[c.old[j]].there + *gap);
                made_[i].back = std::max(made_[i].back, faces_[c.old[j]].back + *gap);
                if (made_[i].there > limit_ || made_[i].back > limit_) return false;
            }
    find_affected(c);
    for (bounded& made : made_) {
        const surroundings reach(made.now, std::max(made.there, made.back) + rounding_);
        for (const std::uint32_t t : affected_)
            if (reach.may_meet(given_[t].corners, given_[t].box)) made.near.push_back(t);
    }
    return true;
}

bool distance_proof::holds_anew(const change& c, const dynamic_tree<3>& tree) {
    make_room(c);
    find_affected(c);
    find_targets(c, tree);
    if (!covers_there(c)) return false;
    for (std::size_t i = 0; i < made_.size(); ++i)
        if (!is_under(i, c.after[i]) && !covers_back(i, c.after[i])) return false;
    for (bounded& made : made_) {
        std::ranges::sort(made.near);
        made.near.erase(std::unique(made.near.begin(), made.near.end()), made.near.end());
    }
    return true;
}

/// New faces, and what others there are within the limit of triangles of the input.
void distance_proof::find_targets(const change& c, const dynamic_tree<3>& tree) {
    targets_.clear();
    others_.clear();
    for (const triangle3& t : c.after) targets_.emplace_back(t);
    aabb<double, 3> around;
    for (const std::uint32_t t : affected_) around.include(given_[t].box);
    for (std::size_t axis = 0; axis < 3; ++axis)
        around.min[axis] -= limit_, around.max[axis] += limit_;
    search(tree, around, [&](std::uint32_t f) {
        if (!has(c.old, f)) others_.push_back(f);
    });
    std::ranges::sort(others_);
    for (const std::uint32_t f : others_) targets_.emplace_back(faces_[f].now);
}

bool distance_proof::covers_there(const change& c) {
    if (const auto last = std::ranges::find(affected_, too_far_); last != affected_.end())
        std::iter_swap(affected_.begin(), last);
    for (const std::uint32_t t : affected_) {
        too_far_ = t;
        if (!covering_.cover(given_[t].corners, targets_, limit_)) return false;
        for (const covering::use& use : covering_.used())
            if (use.number < c.kept.size()) {
                bounded& made = made_[use.number];
                made.there = std::max(made.there, use.at_most);
                made.near.push_back(t);
            } else {
                raised_.push_back({others_[use.number - c.kept.size()], t, use.at_most});
            }
    }
    return true;
}

/// Whether the input, seen along the face, covers it no further away than the limit. What is seen
/// of it grows from a triangle that covers some of it, across all sides of those that cover more.
/// The face is made smaller by `rim` first, so that what hardly meets it does not count.
bool distance_proof::is_under(std::size_t i, const triangle3& t) {
    const point3 normal = normal_of(t);
    if (!(base::dot(normal, normal) > 0.0)) return false;
    const view_along view(normal, t[0]);
    seen_triangle seen = view.see(t);
    if (!view.faces_eye(t, seen)) return false;
    // On no line of a grid, where triangles end.
    const point3 middle =
        base::plus(base::scaled(seen.at[0], 0.3717),
                   base::plus(base::scaled(seen.at[1], 0.3391), base::scaled(seen.at[2], 0.2892)));
    double widest = 0.0;
    for (const point3& p : seen.at) {
        const point3 way = base::minus(middle, p);
        widest = std::max(widest, std::sqrt(base::dot(way, way)));
    }
    const double rim = std::min(rim_share * limit_, 0.5 * widest);
    for (point3& p : seen.at) p = base::plus(p, base::scaled(base::minus(middle, p), rim / widest));
    waiting_.clear();
    ++visit_;
    double worst = 0.0;
    const auto is_start = [&](std::uint32_t g) {
        const seen_triangle at = view.see(given_[g].corners);
        if (!is_seen_within(at, middle) || !view.faces_eye(given_[g].corners, at)) return false;
        const std::optional<double> gap = gap_between(at, seen);
        return gap && *gap <= limit_;
    };
    const auto start = std::ranges::find_if(affected_, is_start);
    if (start == affected_.end()) return false;
    waiting_.push_back(*start);
    given_[*start].visited = visit_;
    const std::size_t before = made_[i].near.size();
    const auto fails = [&] {
        made_[i].near.resize(before);
        return false;
    };
    while (!waiting_.empty()) {
        const std::uint32_t g = waiting_.back();
        waiting_.pop_back();
        const seen_triangle at = view.see(given_[g].corners);
        const std::optional<double> gap = gap_between(at, seen);
        if (!gap) continue;
        if (*gap + rim > limit_ || !view.faces_eye(given_[g].corners, at)) return fails();
        worst = std::max(worst, *gap);
        made_[i].near.push_back(g);
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t mate = given_[g].mates[side];
            const point3 &p = at.at[side], &q = at.at[(side + 1) % 3];
            if (mate == no_face && gap_between({{p, q, q}, at.extent}, seen)) return fails();
            if (mate == no_face || given_[mate].visited == visit_) continue;
            given_[mate].visited = visit_;
            waiting_.push_back(mate);
        }
    }
    made_[i].back = worst + rim;
    return true;
}

bool distance_proof::covers_back(std::size_t i, const triangle3& t) {
    targets_.clear();
    for (const std::uint32_t g : affected_) targets_.emplace_back(given_[g].corners);
    if (!covering_.cover(t, targets_, limit_)) return false;
    for (const covering::use& use : covering_.used()) {
        made_[i].back = std::max(made_[i].back, use.at_most);
        made_[i].near.push_back(affected_[use.number]);
    }
    return true;
}

void distance_proof::accept(const change& c) {
    for (const std::uint32_t f : c.old) faces_[f].near.clear();
    for (const auto& [other, t, there] : raised_) {
        bounded& face = faces_[other];
        face.there = std::max(face.there, there);
        if (std::ranges::find(face.near, t) == face.near.end()) face.near.push_back(t);
    }
    for (std::size_t i = 0; i < made_.size(); ++i) std::swap(faces_[c.kept[i]], made_[i]);
}

}  // namespace treeform::detail::simplify
