#include <libmesh/base/point_math.hpp>
#include <libmesh/wrap/tetrahedralization.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace treeform::detail::wrap {

using base::cross;
using base::dot;
using base::minus;

tetrahedralization::tetrahedralization(const box3& around) {
    for (std::uint32_t i = 0; i < 8; ++i)
        points_.push_back({(i & 1) != 0 ? around.max.x : around.min.x,
                           (i & 2) != 0 ? around.max.y : around.min.y,
                           (i & 4) != 0 ? around.max.z : around.min.z});
    // Each goes from corner 0 to corner 7 along the three axes, in one of the six orders.
    constexpr std::array<std::array<std::uint32_t, 4>, 6> paths{
        {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
    for (const auto& path : paths) {
        all_.push_back({path, {none, none, none, none}});
        births_.push_back(1);
        part_.push_back(part::none);
    }
    // Neighbors in this order share corners 0, 7 and the one that both name.
    for (std::uint32_t t = 0; t < 6; ++t) {
        all_[t].neighbors[1] = (t + 1) % 6;  // without its own first corner
        all_[t].neighbors[2] = (t + 5) % 6;
    }
}

int tetrahedralization::side(std::uint32_t t, std::size_t i, const point3& p) const {
    const auto [a, b, c] = face(t, i);
    return orient3d(points_[a], points_[b], points_[c], p);
}

/// Rounded. A margin above 0, in shares of what rounding adds up, counts points on the sphere, too.
bool tetrahedralization::is_in_sphere(std::uint32_t t, const point3& p, double margin) const {
    const auto [a, b, c, d] = corners(t);
    const point3 pa = minus(a, p), pb = minus(b, p), pc = minus(c, p), pd = minus(d, p);
    const point3 ab = cross(pa, pb), cd = cross(pc, pd);
    // The determinant of the four rows (v, v . v), by its last column.
    const double by_d = dot(pd, pd) * dot(ab, pc), by_c = dot(pc, pc) * dot(ab, pd);
    const double by_b = dot(pb, pb) * dot(cd, pa), by_a = dot(pa, pa) * dot(cd, pb);
    const double most = std::max({std::abs(by_a), std::abs(by_b), std::abs(by_c), std::abs(by_d)});
    return by_d - by_c + by_b - by_a < margin * most;
}

bool tetrahedralization::holds(std::uint32_t t, const point3& p) const {
    for (std::size_t i = 0; i < 4; ++i)
        if (side(t, i, p) < 0) return false;
    return true;
}

std::uint32_t tetrahedralization::locate(const point3& p, std::uint32_t near) const {
    std::uint32_t t = near;
    std::uint32_t from = none;
    // Tetrahedra that are not quite Delaunay's may lead around in a circle.
    for (std::size_t steps = 0; steps <= count(); ++steps) {
        std::size_t way = 4;
        for (std::size_t k = 0; k < 4 && way == 4; ++k) {
            const std::size_t i = (k + steps) & 3;
            const std::uint32_t next = all_[t].neighbors[i];
            if ((next != from || next == none) && side(t, i, p) < 0) way = i;
        }
        if (way == 4) return t;
        from = t;
        t = all_[t].neighbors[way];
        if (t == none) return none;
    }
    for (t = 0; t < all_.size(); ++t)
        if (is_used(t) && holds(t, p)) return t;
    return none;
}

std::size_t tetrahedralization::face_towards(std::uint32_t t, std::uint32_t neighbor) const {
    const auto& n = all_[t].neighbors;
    return static_cast<std::size_t>(std::find(n.begin(), n.end(), neighbor) - n.begin());
}

/// The tetrahedra that hold `p`, their faces, edges and corners included. Every face of all of
/// them together has `p` strictly inside. False where `p` is on the box.
bool tetrahedralization::find_core(const point3& p, std::uint32_t first) {
    room_.assign(1, first);
    part_[first] = part::core;
    for (std::size_t k = 0; k < room_.size(); ++k)
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t next = all_[room_[k]].neighbors[i];
            if ((next != none && part_[next] != part::none) || side(room_[k], i, p) != 0) continue;
            if (next == none) return false;
            part_[next] = part::core;
            room_.push_back(next);
        }
    return true;
}

void tetrahedralization::grow(const point3& p) {
    for (std::size_t k = 0; k < room_.size(); ++k)
        for (const std::uint32_t next : all_[room_[k]].neighbors)
            if (next != none && part_[next] == part::none && is_in_sphere(next, p, 0.0)) {
                part_[next] = part::room;
                room_.push_back(next);
            }
}

/// Until `p` sees every face of the room strictly from inside. Then the tetrahedra between `p` and
/// these faces fill the room exactly: they are all oriented, and their signed sum is the room.
///
/// Where it does not see a face, `p` is on a sphere: that of the tetrahedron behind, which makes
/// room, too, or that of the one in front, which does not have to.
void tetrahedralization::make_star(const point3& p) {
    constexpr double on_sphere = 0x1p-30;
    const auto settle = [&](std::uint32_t t) {
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t next = all_[t].neighbors[i];
            const bool is_wall = next == none || part_[next] < part::room;
            if (!is_wall || side(t, i, p) > 0) continue;
            if (next != none && part_[next] == part::none && is_in_sphere(next, p, on_sphere)) {
                part_[next] = part::room;
                room_.push_back(next);
                continue;
            }
            part_[t] = part::dropped;
            return false;
        }
        return true;
    };
    for (bool is_done = false; !is_done;) {
        is_done = true;
        for (std::size_t k = 0; k < room_.size(); ++k)
            if (const std::uint32_t t = room_[k]; part_[t] == part::room && !settle(t))
                is_done = false;
    }
}

bool tetrahedralization::is_near_corner(const point3& p, double apart) const {
    const auto is_near = [&](std::uint32_t corner) {
        const point3 way = minus(points_[corner], p);
        return !(dot(way, way) > 0.0) || dot(way, way) < apart * apart;
    };
    return std::any_of(room_.begin(), room_.end(), [&](std::uint32_t t) {
        return part_[t] >= part::room &&
               std::any_of(all_[t].corners.begin(), all_[t].corners.end(), is_near);
    });
}

void tetrahedralization::find_walls() {
    walls_.clear();
    for (const std::uint32_t t : room_)
        for (std::size_t i = 0; i < 4 && part_[t] >= part::room; ++i) {
            const std::uint32_t next = all_[t].neighbors[i];
            if (next != none && part_[next] >= part::room) continue;
            walls_.push_back({face(t, i), next, next == none ? 0 : face_towards(next, t)});
        }
}

std::uint32_t tetrahedralization::take_number() {
    if (!unused_.empty()) {
        const std::uint32_t t = unused_.back();
        unused_.pop_back();
        ++births_[t];
        return t;
    }
    if (all_.size() >= none) throw std::length_error("treeform::wrap: too many tetrahedra");
    all_.emplace_back();
    births_.push_back(1);
    part_.push_back(part::none);
    return static_cast<std::uint32_t>(all_.size() - 1);
}

void tetrahedralization::fill_room(std::uint32_t p) {
    for (std::size_t k = room_.size(); k-- > 0;) {
        ++births_[room_[k]];
        unused_.push_back(room_[k]);
    }
    made_.clear();
    edges_.clear();
    for (const wall& w : walls_) {
        const std::uint32_t t = take_number();
        const auto [a, b, c] = w.corners;
        all_[t] = {{a, b, c, p}, {none, none, none, w.behind}};
        if (w.behind != none) all_[w.behind].neighbors[w.face_behind] = t;
        made_.push_back(t);
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint64_t u = w.corners[(i + 1) % 3];
            const std::uint64_t v = w.corners[(i + 2) % 3];
            edges_.push_back({u < v ? u << 32 | v : v << 32 | u, t, i});
        }
    }
    link_made();
}

/// Every edge of the room is of two of its faces, since each direction from the new corner ends in
/// one of them.
void tetrahedralization::link_made() {
    std::sort(edges_.begin(), edges_.end(),
              [](const edge_of_made& a, const edge_of_made& b) { return a.ends < b.ends; });
    for (std::size_t k = 0; k + 1 < edges_.size(); k += 2) {
        all_[edges_[k].of].neighbors[edges_[k].opposite] = edges_[k + 1].of;
        all_[edges_[k + 1].of].neighbors[edges_[k + 1].opposite] = edges_[k].of;
    }
}

bool tetrahedralization::insert(const point3& p, std::uint32_t near, double apart) {
    const std::uint32_t first = locate(p, near);
    if (first == none) return false;
    bool is_possible = find_core(p, first);
    if (is_possible) {
        grow(p);
        make_star(p);
        is_possible = !is_near_corner(p, apart);
    }
    if (is_possible) find_walls();
    std::erase_if(room_, [&](std::uint32_t t) {
        return std::exchange(part_[t], part::none) == part::dropped;
    });
    if (!is_possible) return false;
    points_.push_back(p);
    fill_room(static_cast<std::uint32_t>(points_.size() - 1));
    return true;
}

}  // namespace treeform::detail::wrap
