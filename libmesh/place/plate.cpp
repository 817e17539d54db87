#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <libmesh/place/plate.hpp>
#include <libmesh/place/relation_of.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/distance.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace treeform::detail::place {
namespace {

/// Cosine and sine of `turn` times 15 degrees, the same on every machine; quarters are exact.
std::array<double, 2> cosine_and_sine(unsigned turn) {
    constexpr double cosine[] = {1.0,
                                 0.96592582628906828675,
                                 0.86602540378443864676,
                                 0.70710678118654752440,
                                 0.5,
                                 0.25881904510252076235,
                                 0.0};
    const auto of = [&](unsigned t) {
        t %= 24;
        if (t > 12) t = 24 - t;
        return t <= 6 ? cosine[t] : -cosine[12 - t];
    };
    return {of(turn), of(turn + 18)};
}

/// \pre it has faces
box3 box_of(mesh_view mesh) { return *box_of_faces(mesh); }

/// Whether `high` - `low` is `least` or more, exactly; so is one that is `least` or less.
int compare_difference(double high, double low, double least) {
    const double difference = high - low;
    if (difference != least) return difference > least ? 1 : -1;
    const double shift = difference - high;
    const double rest = (high - (difference - shift)) + (-low - shift);
    return (rest > 0.0) - (rest < 0.0);
}

bool boxes_apart(const box3& a, const box3& b, double spacing) {
    for (std::size_t k = 0; k < 3; ++k)
        if (compare_difference(a.min[k], b.max[k], spacing) >= 0 ||
            compare_difference(b.min[k], a.max[k], spacing) >= 0)
            return true;
    return false;
}

/// With some cells beyond the plate, from which the gaps of the raster may let a part be moved in.
raster_size raster_of(const pack_options& o, double cell) {
    const auto cells = [cell](double length) {
        return static_cast<std::uint32_t>(length / cell) + 8;
    };
    return {o.stack ? cells(o.size.z) : 1, cells(o.size.y), cells(o.size.x)};
}

/// In cells; what is wider than the plate is as good as that.
double spacing_of(const pack_options& o, double cell) {
    const raster_size size = raster_of(o, cell);
    return std::min(o.spacing / cell,
                    static_cast<double>(std::max({size.layers, size.rows, size.columns})));
}

/// Whether `a` is within the open box `b`.
bool strictly_within(const box3& a, const box3& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(b.min[k] < a.min[k] && a.max[k] < b.max[k])) return false;
    return true;
}

}  // namespace

turned_part::turned_part(mesh_view part, unsigned turn)
    : turn_(turn), faces_(part.faces), axis_(cosine_and_sine(turn)) {
    const box3 box = box_of(part);
    for (std::size_t k = 0; k < 3; ++k) center_[k] = 0.5 * box.min[k] + 0.5 * box.max[k];
    const auto [c, s] = axis_;
    points_.reserve(part.points.size());
    for (const point3& p : part.points) {
        const double x = p.x - center_.x, y = p.y - center_.y;
        points_.push_back({c * x - s * y, s * x + c * y, p.z});
    }
    lowest_ = box_of(mesh()).min;
    for (point3& p : points_) p = {p.x - lowest_.x, p.y - lowest_.y, p.z - lowest_.z};
    const point3 highest = box_of(mesh()).max;
    size_ = highest;
    // Of infinite coordinates the box is not to be relied on.
    for (const face& f : faces_)
        for (const std::uint32_t i : f)
            for (std::size_t k = 0; k < 3; ++k)
                if (!std::isfinite(points_[i][k]))
                    size_[k] = std::numeric_limits<double>::quiet_NaN();
}

transform<3> turned_part::matrix(const point3& by) const {
    const auto [c, s] = axis_;
    transform<3> m;
    m.rows[0] = {c, -s, 0.0, (by.x - lowest_.x) - (c * center_.x - s * center_.y)};
    m.rows[1] = {s, c, 0.0, (by.y - lowest_.y) - (s * center_.x + c * center_.y)};
    m.rows[2] = {0.0, 0.0, 1.0, by.z - lowest_.z};
    return m;
}

turned::turned(mesh_view mesh, unsigned turn)
    : part(mesh, turn), faces(build_face_tree(part.mesh())) {}

plate::plate(const pack_options& options, double cell, bool square)
    : options_(options),
      single_(options.precision == precision::float32),
      corner_{options.corner.x, options.corner.y, not_below(options.corner.z, options.precision)},
      grid_{corner_, cell, options.stack},
      unit_(0.0),
      raster_(raster_of(options, cell), spacing_of(options, cell), square) {
    double largest = 0.0;
    for (std::size_t k = 0; k < (options.stack ? 3U : 2U); ++k)
        largest = std::max(largest, std::abs(options.corner[k]) + options.size[k]);
    unit_ = std::ldexp(largest, options.precision == precision::float32 ? -23 : -52);
}

plate::resident plate::at(std::uint32_t number, const prepared_mesh& whose, const turned_part& part,
                          const point3& by) const {
    resident one{number, {}, &whose, {}, {}};
    one.part.placed = true;
    one.part.matrix = part.matrix(by);
    one.part.points.reserve(part.mesh().points.size());
    for (const point3& p : part.mesh().points) {
        point3 q{p.x + by.x, p.y + by.y, p.z + by.z};
        if (single_)
            for (std::size_t k = 0; k < 3; ++k) q[k] = base::nearest_float(q[k]);
        one.part.points.push_back(q);
    }
    one.box = box_of(one.mesh());
    return one;
}

bool plate::inside(const box3& box) const {
    for (std::size_t k = 0; k < 3; ++k) {
        const double corner = k == 2 && !options_.stack ? box.min.z : options_.corner[k];
        if (box.min[k] < (k == 2 ? corner_.z : corner) || !std::isfinite(box.max[k])) return false;
        if (compare_difference(box.max[k], corner, options_.size[k]) > 0) return false;
    }
    return true;
}

/// Either the boxes are apart, exactly; or the faces are by what `distance` says less its
/// error, 2^-49 of a length that is no more than the diagonal of the box around both, and neither
/// is inside the other, which takes a box inside the other's box.
bool plate::apart(const resident& a, const resident& b) {
    const double spacing = options_.spacing;
    if (boxes_apart(a.box, b.box, spacing)) return true;
    ++measured_;
    box3 both = a.box;
    for (std::size_t k = 0; k < 3; ++k) {
        both.min[k] = std::min(both.min[k], b.box.min[k]);
        both.max[k] = std::max(both.max[k], b.box.max[k]);
    }
    const double error = 0x1p-48 * both.diagonal();
    const auto found = nearness::closest_pair(a.mesh(), a.faces_tree, b.mesh(), b.faces_tree,
                                              spacing + 2.0 * error);
    if (found && !(found->distance > 0.0 && found->distance - error >= spacing)) return false;
    if (!strictly_within(a.box, b.box) && !strictly_within(b.box, a.box)) return true;
    return relation_of(shape(*a.whose, a.part.points, a.faces_tree),
                       shape(*b.whose, b.part.points, b.faces_tree))
               .relation == mesh_relation::disjoint;
}

bool plate::fits(const resident& one) {
    return inside(one.box) && std::all_of(residents_.begin(), residents_.end(),
                                          [&](const resident& r) { return apart(one, r); });
}

/// The least distance of the part, moved by `by`, to these; `most` when it is more.
double plate::distance_to(const std::vector<const resident*>& others, const turned& part,
                          const point3& by, double most) const {
    const transformed<3> moved(part.faces, transform<3>::translation(by));
    for (const resident* r : others) {
        const auto found =
            nearness::closest_pair(part.part.mesh(), moved, r->mesh(), r->faces_tree, most);
        if (found) most = std::min(most, found->distance);
    }
    return most;
}

/// How far the part may move against the direction of `axis`: steps of what it is still away from
/// all that is in the way, beyond the spacing, in which it passes nothing. Where it is as near as
/// it may be to something that it only moves along, so that this step is 0, it goes on from the
/// nearest place that is free again: by less than its own length, so that it passes no wall either.
double plate::free_travel(const turned& part, const point3& by, std::size_t axis) const {
    const double spacing = options_.spacing;
    const point3& size = part.part.size();
    const double limit = by[axis] - corner_[axis];
    box3 swept;
    for (std::size_t k = 0; k < 3; ++k) {
        swept.min[k] = by[k];
        swept.max[k] = by[k] + size[k];
    }
    swept.min[axis] = corner_[axis];
    std::vector<const resident*> in_the_way;
    for (const resident& r : residents_)
        if (!boxes_apart(swept, r.box, spacing)) in_the_way.push_back(&r);

    double travel = 0.0;
    const auto room_at = [&](double t, double most) {
        point3 there = by;
        there[axis] -= t;
        return distance_to(in_the_way, part, there, most + spacing) - spacing;
    };
    for (unsigned step = 0; step < 60 && travel < limit; ++step) {
        double room = std::max(room_at(travel, limit - travel), 0.0);
        if (room <= 1e-4 * grid_.cell) {
            room = std::min(0.5 * size[axis], limit - travel);
            while (room > 1e-3 * grid_.cell && room_at(travel + room, unit_) < -8.0 * unit_)
                room *= 0.5;
            if (room <= 1e-3 * grid_.cell) break;
        }
        travel += room;
    }
    return std::min(travel, limit);
}

/// The least coordinate to be written that is `spacing` above `below`, exactly.
double plate::next_above(double below) const {
    const auto written = [&](double x) { return single_ ? base::nearest_float(x) : x; };
    double at = written(below + options_.spacing);
    while (compare_difference(at, below, options_.spacing) < 0)
        at = single_ ? static_cast<double>(std::nextafter(static_cast<float>(at),
                                                          std::numeric_limits<float>::infinity()))
                     : std::nextafter(at, std::numeric_limits<double>::infinity());
    return at;
}

/// A slide ends where rounding has it. Where that is, except for rounding, the spacing above the
/// box of a part, it is to be that exactly: so that rows of boxes are as long as they should be.
double plate::snapped(double at, std::size_t axis) const {
    for (const resident& r : residents_) {
        const double exact = next_above(r.box.max[axis]);
        if (std::abs(exact - at) <= 64.0 * unit_) return exact;
    }
    return at;
}

/// Down z (when it may be stacked), y and x, for as long as it brings something.
void plate::slide(const turned& part, point3& by) const {
    for (unsigned round = 0; round < 4; ++round) {
        double moved = 0.0;
        for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
            if (axis == 2 && !options_.stack) continue;
            const double travel = free_travel(part, by, axis);
            by[axis] = travel < by[axis] - corner_[axis] ? snapped(by[axis] - travel, axis)
                                                         : corner_[axis];
            moved += travel;
        }
        if (moved <= 1e-3 * grid_.cell) break;
    }
}

bool plate::put(std::uint32_t number, const prepared_mesh& whose, const turned& part,
                cell_place place) {
    const point3 raster_place{corner_.x + place.column * grid_.cell,
                              corner_.y + place.row * grid_.cell,
                              corner_.z + place.layer * grid_.cell};
    const auto settle = [&](const point3& by) {
        resident one = this->at(number, whose, part.part, by);
        if (!inside(one.box)) return false;
        one.faces_tree = build_face_tree(one.mesh());
        if (!fits(one)) return false;
        raster_.take(cells_covered(one.mesh(), grid_));
        for (std::size_t k = 0; k < 3; ++k)
            reached_[k] = std::max(reached_[k], one.box.max[k] - corner_[k]);
        residents_.push_back(std::move(one));
        return true;
    };
    if (options_.tighten) {
        point3 tight = raster_place;
        slide(part, tight);
        // What rounding has brought too near is moved away again by units in the last place.
        if (settle(tight)) return true;
        for (double back = unit_; back < 100.0 * unit_; back *= 4.0)
            for (unsigned axes = 1; axes < (options_.stack ? 8U : 4U); ++axes) {
                point3 there = tight;
                for (std::size_t k = 0; k < 3; ++k)
                    if ((axes >> k & 1U) != 0) there[k] += back;
                if (settle(there)) return true;
            }
    }
    return settle(raster_place);
}

void plate::take_parts(std::vector<packed_part>& result) {
    for (resident& r : residents_) result[r.number] = std::move(r.part);
    residents_.clear();
}

}  // namespace treeform::detail::place
