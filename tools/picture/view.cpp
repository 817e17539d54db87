#include "tools/picture/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tools {
namespace {

using view_rows = std::array<std::array<double, 3>, 3>;  // right, up, toward the eye

view_rows rows_of(view from) {
    switch (from) {
        case view::top:
            return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        case view::bottom:
            return {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
        case view::front:
            return {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
        case view::back:
            return {{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}};
        case view::left:
            return {{{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}}};
        case view::right:
            return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
        case view::iso:
            break;
    }
    const double two = std::sqrt(0.5), three = std::sqrt(1.0 / 3.0), six = std::sqrt(1.0 / 6.0);
    return {{{two, two, 0}, {-six, six, 2.0 * six}, {three, -three, three}}};
}

/// A box that grows.
struct growing {
    static constexpr double huge = std::numeric_limits<double>::infinity();
    tf::box3 box{{huge, huge, huge}, {-huge, -huge, -huge}};
    void add(const tf::point3& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.min[axis] = std::min(box.min[axis], p[axis]);
            box.max[axis] = std::max(box.max[axis], p[axis]);
        }
    }
    [[nodiscard]] bool empty() const { return !(box.min.x <= box.max.x); }
};

/// Boxes in shares of the longest side of all, and the area of faces.
struct extents {
    growing faces{}, marks{};  // of what was found
    double area = 0.0;
};

tf::point3 difference(const tf::point3& a, const tf::point3& b, double share) {
    return {a.x * share - b.x * share, a.y * share - b.y * share, a.z * share - b.z * share};
}

double length(const tf::point3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

double area_of(const std::array<tf::point3, 3>& corners) {
    const tf::point3 u = difference(corners[1], corners[0], 1.0);
    const tf::point3 v = difference(corners[2], corners[0], 1.0);
    return 0.5 * length({u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x});
}

extents extents_of(const scene& shown, double share) {
    extents e;
    for (const scene_mesh& m : shown.meshes)
        for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
            const scene_class& own = class_of(shown, m.kind, f);
            if (!own.shown) continue;
            std::array<tf::point3, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = difference(m.mesh.points[m.mesh.faces[f][i]], {}, share);
                if (!own.context && !m.ghost) e.faces.add(corners[i]);
            }
            e.area += area_of(corners);
        }
    for (const scene_lines& l : shown.lines)
        for (const auto& ends : l.ends)
            for (const tf::point3& p : ends)
                if (!shown.classes[l.kind].context) e.marks.add(difference(p, {}, share));
    for (const scene_dots& d : shown.dots)
        for (std::size_t i = 0; i < d.points.size(); ++i)
            if (is_finite(d.points[i]) && !class_of(shown, d.kind, i).context)
                e.marks.add(difference(d.points[i], {}, share));
    return e;
}

}  // namespace

eye::eye(view from, bool y_is_up, const tf::box3& box) : rows_(rows_of(from)), low_(box.min) {
    if (y_is_up)  // y and -z stand where z and y do
        for (auto& row : rows_) row = {row[0], row[2], -row[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
        quarter_ = std::max(axis > 0 ? quarter_ : 0.0, 0.25 * box.max[axis] - 0.25 * box.min[axis]);
    if (!(quarter_ > 0.0)) quarter_ = 1.0;
}

std::array<double, 3> eye::operator()(const tf::point3& p) const {
    tf::point3 share;
    for (std::size_t axis = 0; axis < 3; ++axis)
        share[axis] = (0.25 * p[axis] - 0.25 * low_[axis]) / quarter_;
    return turned(share);
}

std::array<double, 3> eye::turned(const tf::point3& v) const {
    std::array<double, 3> result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = rows_[i][0] * v.x + rows_[i][1] * v.y + rows_[i][2] * v.z;
    return result;
}

tf::box3 box_that_matters(const scene& shown, const tf::box3& all) {
    double quarter = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        quarter = std::max(quarter, 0.25 * all.max[axis] - 0.25 * all.min[axis]);
    if (!(quarter > 1e-290)) return all;
    const double share = 0.25 / quarter;
    const extents e = extents_of(shown, share);
    // Faces that meet may be long; where they meet is what one looks for.
    const growing& findings = e.marks.empty() ? e.faces : e.marks;
    const tf::box3 shrunk{difference(all.min, {}, share), difference(all.max, {}, share)};
    const double whole = shrunk.diagonal();
    if (findings.empty() || std::sqrt(e.area) > 0.25 * whole) return all;
    const double room = std::max(findings.box.diagonal(), e.area / whole);
    if (room > 0.25 * whole) return all;
    tf::box3 box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = (findings.box.min[axis] - room) / share;
        box.max[axis] = (findings.box.max[axis] + room) / share;
    }
    return box;
}

}  // namespace tools
