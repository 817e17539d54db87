#include <libmesh/detail/check_faces.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/nearness/mesh_distance.hpp>
#include <libtree/build.hpp>
#include <libtree/detail/near_pair_walk.hpp>
#include <libtree/detail/squared_radius.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace tf {
namespace {

/// Lengths are multiplied by this power of two, so that squares stay in the range of double.
double unit_for(const transformed<3>& a, const transformed<3>& b) {
    const tree_frame<3> frame =
        detail::common_frame(a.original().frame(), a.by(), b.original().frame(), b.by());
    const double span = std::max(detail::span_in(a.original().frame(), a.by(), frame),
                                 detail::span_in(b.original().frame(), b.by(), frame));
    if (!(span < std::numeric_limits<double>::max())) return 0x1p-1000;
    const int exponent = std::ilogb(span);
    return -400 < exponent && exponent < 400 ? 1.0
                                             : std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

/// A mesh with its tree, where it counts as being.
class placed_mesh {
  public:
    placed_mesh(mesh_view mesh, const transformed<3>& tree, double unit)
        : mesh_(mesh),
          ids_(tree.original().ids().data()),
          by_(tree.by()),
          moves_(tree.moves()),
          unit_(unit) {}

    [[nodiscard]] std::uint32_t face_at(std::size_t place) const { return ids_[place]; }
    [[nodiscard]] triangle3 triangle(std::uint32_t face) const {
        triangle3 t;
        for (std::size_t i = 0; i < 3; ++i) {
            const point3& p = mesh_.points[mesh_.faces[face][i]];
            t[i] = moves_ ? by_(p) : p;
            if (unit_ != 1.0) t[i] = {t[i].x * unit_, t[i].y * unit_, t[i].z * unit_};
        }
        return t;
    }

  private:
    mesh_view mesh_;
    const std::uint32_t* ids_;
    transform<3> by_;
    bool moves_;
    double unit_;
};

/// The nearest pair so far, and the direction between the points of the last pair looked at: of two
/// that are further apart than the nearest, neighbours of theirs often are so along the same line.
struct nearest_so_far {
    double squared;
    bool found = false;
    std::uint32_t a = 0, b = 0;
    closest_between_triangles at{};
    bool has_direction = false;
    point3 origin{}, direction{};

    [[nodiscard]] double bound() const { return squared; }
    [[nodiscard]] bool done() const { return found && squared == 0.0; }

    void offer(std::uint32_t face_a, std::uint32_t face_b, const closest_between_triangles& one) {
        if (one.squared_distance > 0.0) direct(one);
        if (!(one.squared_distance < squared ||
              (one.squared_distance == squared &&
               (!found || face_a < a || (face_a == a && face_b < b)))))
            return;
        squared = one.squared_distance;
        found = true;
        a = face_a;
        b = face_b;
        at = one;
    }

  private:
    void direct(const closest_between_triangles& one) {
        has_direction = true;
        origin = one.on_a;
        const double length = std::sqrt(one.squared_distance);
        for (std::size_t k = 0; k < 3; ++k) direction[k] = (one.on_b[k] - one.on_a[k]) / length;
    }
};

/// Eight triangles, those of a leaf block that matter.
struct eight_triangles {
    std::array<triangle3, 8> of;
    double at[3][3][8] = {};  ///< corner, axis, triangle

    eight_triangles(const placed_mesh& mesh, std::size_t block, unsigned wanted) {
        for (; wanted != 0; wanted &= wanted - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(wanted));
            of[i] = mesh.triangle(mesh.face_at(block * 8 + i));
            for (std::size_t corner = 0; corner < 3; ++corner)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    at[corner][axis][i] = of[i][corner][axis];
        }
    }
};

/// How far eight triangles reach along a direction n from an origin, and, at most, from there.
struct spans_along {
    double least[8], most[8], reach[8];

    void look(const eight_triangles& t, const point3& n, const point3& origin) {
        for (std::size_t i = 0; i < 8; ++i) {
            least[i] = std::numeric_limits<double>::infinity();
            most[i] = -least[i];
            reach[i] = 0.0;
        }
        for (const auto& corner : t.at)
            for (std::size_t i = 0; i < 8; ++i) {
                const double x = corner[0][i] - origin.x;
                const double y = corner[1][i] - origin.y;
                const double z = corner[2][i] - origin.z;
                const double along = n.x * x + n.y * y + n.z * z;
                least[i] = along < least[i] ? along : least[i];
                most[i] = most[i] < along ? along : most[i];
                reach[i] += std::abs(x) + std::abs(y) + std::abs(z);
            }
    }
};

/// The pairs of slots within `bound`: bit j of element i.
std::array<unsigned, 8> pairs_within(const detail::block_pair& blocks, float bound) {
    std::array<unsigned, 8> pairs{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j)
            pairs[i] |= static_cast<unsigned>(blocks.within(i, j, bound)) << j;
    return pairs;
}

void visit(const placed_mesh& a, const placed_mesh& b, const detail::block_pair& blocks,
           nearest_so_far& best, double limit) {
    limit = std::min(limit, best.squared);
    float bound = blocks.bound_of(limit);
    double distance = std::sqrt(limit);
    const std::array<unsigned, 8> pairs = pairs_within(blocks, bound);
    unsigned rows = 0, columns = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        rows |= static_cast<unsigned>(pairs[i] != 0) << i;
        columns |= pairs[i];
    }
    if (rows == 0) return;

    const eight_triangles in_a(a, blocks.a, rows);
    const eight_triangles in_b(b, blocks.b, columns);
    spans_along along_a, along_b;
    const auto look_along = [&] {
        along_a.look(in_a, best.direction, best.origin);
        along_b.look(in_b, best.direction, best.origin);
    };
    // Whether two are further apart than `distance` along the direction, whose length is 1 to
    // 2^-50; products are off by less than that in proportion to `reach`.
    const auto beyond = [&](std::size_t i, std::size_t j) {
        return along_b.least[j] - along_a.most[i] >
               distance * (1.0 + 0x1p-40) + 0x1p-45 * (along_a.reach[i] + along_b.reach[j]);
    };
    if (best.has_direction) look_along();
    for (; rows != 0; rows &= rows - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rows));
        for (unsigned rest = pairs[i]; rest != 0; rest &= rest - 1) {
            const auto j = static_cast<std::size_t>(std::countr_zero(rest));
            if (!(blocks.squared[i][j] <= bound)) continue;
            if (best.has_direction && beyond(i, j)) continue;
            best.offer(a.face_at(std::size_t{blocks.a} * 8 + i),
                       b.face_at(std::size_t{blocks.b} * 8 + j),
                       closest_points(in_a.of[i], in_b.of[j]));
            if (best.done()) return;
            if (best.has_direction) look_along();
            limit = std::min(limit, best.squared);
            bound = blocks.bound_of(limit);
            distance = std::sqrt(limit);
        }
    }
}

void check_tree(mesh_view mesh, const transformed<3>& tree) {
    if (mesh.faces.size() != tree.original().size())
        throw std::invalid_argument("tf::mesh_distance: the tree is not one over the mesh's faces");
}

tree<3> tree_of(mesh_view mesh) {
    detail::check_faces("mesh_distance", mesh.points.size(), mesh.faces);
    return build(mesh.faces, [&](const face& f) {
        aabb<double, 3> box;
        bool finite = true;
        for (const std::uint32_t corner : f) {
            const point3& p = mesh.points[corner];
            box.include(p);
            finite &= std::isfinite(p.x) & std::isfinite(p.y) & std::isfinite(p.z);
        }
        return finite ? box : aabb<double, 3>();  // `include` overlooks NaN
    });
}

}  // namespace

std::optional<mesh_pair> mesh_distance(mesh_view a, const transformed<3>& tree_a, mesh_view b,
                                       const transformed<3>& tree_b, double radius) {
    check_tree(a, tree_a);
    check_tree(b, tree_b);
    detail::check_radius("tf::mesh_distance", radius);
    if (a.faces.empty() || b.faces.empty()) return std::nullopt;
    const double unit = unit_for(tree_a, tree_b);
    const placed_mesh placed_a(a, tree_a, unit);
    const placed_mesh placed_b(b, tree_b, unit);
    const nearest_so_far best = detail::walk_pairs(
        tree_a, tree_b, unit, nearest_so_far{detail::squared_limit(radius * unit)},
        [&](const detail::block_pair& blocks, nearest_so_far& mine, double limit) {
            visit(placed_a, placed_b, blocks, mine, limit);
        },
        [](const nearest_so_far& all) {
            nearest_so_far part = all;
            part.found = false;
            return part;
        },
        [](nearest_so_far& all, const nearest_so_far& part) {
            if (part.found) all.offer(part.a, part.b, part.at);
        });
    if (!best.found) return std::nullopt;
    const double per_unit = 1.0 / unit;
    const auto back = [&](const point3& p) {
        return point3{p.x * per_unit, p.y * per_unit, p.z * per_unit};
    };
    return mesh_pair{best.a, best.b, std::sqrt(best.squared) * per_unit, back(best.at.on_a),
                     back(best.at.on_b)};
}

std::optional<mesh_pair> mesh_distance(mesh_view a, mesh_view b, double radius) {
    const tree<3> tree_a = tree_of(a);
    const tree<3> tree_b = tree_of(b);
    return mesh_distance(a, tree_a, b, tree_b, radius);
}

}  // namespace tf
