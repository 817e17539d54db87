#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/geometry/triangle_distance.hpp>
#include <libmesh/nearness/bounding_cylinders.hpp>
#include <libmesh/nearness/closest_pair.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/tree/detail/near_pair_walk.hpp>
#include <treeform/tree/detail/squared_radius.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace treeform {
namespace {

/// Lengths are multiplied by this power of two, so that squares stay in the range of double.
double unit_for(const transformed<3>& a, const transformed<3>& b) {
    const tree_frame<3> frame =
        detail::common_frame(a.original().frame(), a.map(), b.original().frame(), b.map());
    const double span = std::max(detail::span_in(a.original().frame(), a.map(), frame),
                                 detail::span_in(b.original().frame(), b.map(), frame));
    if (!(span < std::numeric_limits<double>::max())) return 0x1p-1000;
    const int exponent = std::ilogb(span);
    return -400 < exponent && exponent < 400 ? 1.0
                                             : std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

/// The faces of a mesh by their place in its tree, where they count as being: gathered from the
/// mesh, or of blocks of triangles that were gathered before.
class placed_faces {
  public:
    placed_faces(mesh_view mesh, const transformed<3>& tree, double unit)
        : placed_faces(tree, unit) {
        mesh_ = mesh;
    }
    placed_faces(const detail::buffer<detail::nearness::eight_triangles>& blocks,
                 const transformed<3>& tree, double unit)
        : placed_faces(tree, unit) {
        blocks_ = blocks.data();
    }

    [[nodiscard]] std::uint32_t face_at(std::size_t place) const { return ids_[place]; }

    /// The triangles of a block, of those gathered now only the wanted ones; `space` is for them.
    [[nodiscard]] const detail::nearness::eight_triangles& load(
        std::size_t block, unsigned wanted, detail::nearness::eight_triangles& space) const {
        if (blocks_ != nullptr) {
            if (!moves_ && unit_ == 1.0) return blocks_[block];
            detail::nearness::move_triangles(blocks_[block], by_, unit_, space);
            return space;
        }
        space = {};
        for (; wanted != 0; wanted &= wanted - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(wanted));
            triangle3 t;
            for (std::size_t k = 0; k < 3; ++k) {
                const point3& p = mesh_.points[mesh_.faces[ids_[block * 8 + i]][k]];
                t[k] = moves_ ? by_(p) : p;
                if (unit_ != 1.0) t[k] = {t[k].x * unit_, t[k].y * unit_, t[k].z * unit_};
            }
            space.set(i, t);
        }
        return space;
    }

  private:
    placed_faces(const transformed<3>& tree, double unit)
        : ids_(tree.original().ids().data()),
          by_(tree.map()),
          moves_(tree.is_moved()),
          unit_(unit) {}

    mesh_view mesh_;
    const detail::nearness::eight_triangles* blocks_ = nullptr;
    const std::uint32_t* ids_;
    transform<3> by_;
    bool moves_;
    double unit_;
};

/// The nearest pair so far, and the direction between the points of the last pair looked at: of two
/// that are further apart than the nearest, neighbors of theirs often are so along the same line.
struct nearest_so_far {
    double squared;
    bool found = false;
    std::uint32_t a = 0, b = 0;
    closest_between_triangles at{};
    bool has_line = false;
    detail::nearness::sight_line line{};

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
        has_line = true;
        line.origin = one.on_a;
        const double length = std::sqrt(one.squared_distance);
        for (std::size_t k = 0; k < 3; ++k)
            line.direction[k] = (one.on_b[k] - one.on_a[k]) / length;
    }
};

/// The pairs of slots whose boxes are within `bound`.
detail::nearness::slot_pairs pairs_within(const detail::block_pair& blocks, float bound) {
    detail::nearness::slot_pairs pairs{};
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j)
            pairs[i] |= static_cast<unsigned>(blocks.within(i, j, bound)) << j;
    return pairs;
}

/// Takes the pair whose boxes are nearest from `pairs`; false when none is within `bound`.
bool take_nearest(const detail::block_pair& blocks, float bound,
                  detail::nearness::slot_pairs& pairs, std::size_t& a, std::size_t& b) {
    float least = std::numeric_limits<float>::infinity();
    bool found = false;
    for (std::size_t i = 0; i < 8; ++i)
        for (unsigned rest = pairs[i]; rest != 0; rest &= rest - 1) {
            const auto j = static_cast<std::size_t>(std::countr_zero(rest));
            const float squared = blocks.squared[i][j];
            if (!(squared <= bound) || (found && !(squared < least))) continue;
            found = true;
            least = squared;
            a = i;
            b = j;
        }
    if (found) pairs[a] &= ~(1U << b);
    return found;
}

void visit(const placed_faces& a, const placed_faces& b, const detail::block_pair& blocks,
           nearest_so_far& best, double limit) {
    limit = std::min(limit, best.squared);
    float bound = blocks.bound_of(limit);
    detail::nearness::slot_pairs pairs = pairs_within(blocks, bound);
    unsigned rows = 0, columns = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        rows |= static_cast<unsigned>(pairs[i] != 0) << i;
        columns |= pairs[i];
    }
    if (rows == 0) return;

    detail::nearness::eight_triangles space_a, space_b;
    const detail::nearness::eight_triangles& in_a = a.load(blocks.a, rows, space_a);
    const detail::nearness::eight_triangles& in_b = b.load(blocks.b, columns, space_b);
    for (;;) {
        if (best.has_line)
            detail::nearness::drop_separated(in_a, in_b, best.line, std::sqrt(limit), pairs);
        std::size_t i = 0, j = 0;
        if (!take_nearest(blocks, bound, pairs, i, j)) return;
        best.offer(a.face_at(std::size_t{blocks.a} * 8 + i),
                   b.face_at(std::size_t{blocks.b} * 8 + j),
                   closest_pair(in_a.triangle(i), in_b.triangle(j)));
        if (best.done()) return;
        limit = std::min(limit, best.squared);
        bound = blocks.bound_of(limit);
    }
}

void check_tree(mesh_view mesh, const transformed<3>& tree) {
    if (mesh.faces.size() != tree.original().size())
        throw std::invalid_argument(
            "treeform::closest_pair: the tree is not over the faces of the mesh");
}

std::optional<closest_pair_result> search(const placed_faces& a, const placed_faces& b,
                                          detail::pair_walk<3>& walk, double unit, double radius) {
    const nearest_so_far best = detail::walk_pairs(
        walk, nearest_so_far{detail::squared_limit(radius * unit)},
        [&](const detail::block_pair& blocks, nearest_so_far& mine, double limit) {
            visit(a, b, blocks, mine, limit);
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
    return closest_pair_result{best.a, best.b, std::sqrt(best.squared) * per_unit,
                               back(best.at.on_a), back(best.at.on_b)};
}

}  // namespace

std::optional<closest_pair_result> detail::nearness::closest_pair(mesh_view a,
                                                                  const transformed<3>& tree_a,
                                                                  mesh_view b,
                                                                  const transformed<3>& tree_b,
                                                                  double radius) {
    check_tree(a, tree_a);
    check_tree(b, tree_b);
    check_radius("treeform::closest_pair", radius);
    if (a.faces.empty() || b.faces.empty()) return std::nullopt;
    const double unit = unit_for(tree_a, tree_b);
    pair_walk<3> walk(tree_a, tree_b, unit);
    return search({a, tree_a, unit}, {b, tree_b, unit}, walk, unit, radius);
}

const detail::nearness::face_blocks& detail::nearness::face_blocks_of(const prepared_mesh& mesh) {
    constexpr base::slot<face_blocks> slot{base::slot_name::triangle_blocks};
    const tree<3>& faces = build_face_tree(mesh);
    return base::prepared_slots::get(mesh, slot, [&] {
        face_blocks blocks{triangle_blocks(mesh.indexed_view(), faces), {}};
        blocks.cylinders = bounding_cylinders(faces, blocks.triangles);
        return blocks;
    });
}

namespace {

std::optional<closest_pair_result> find(const std::string& function, mesh_view a, mesh_view b,
                                        const mesh_pair_options& options) {
    const tree<3> tree_a = build_face_tree(a, (function + ": a").c_str());
    const tree<3> tree_b = build_face_tree(b, (function + ": b").c_str());
    return detail::nearness::closest_pair(a, {tree_a, options.transform_a}, b,
                                          {tree_b, options.transform_b}, options.radius);
}

std::optional<closest_pair_result> find(const std::string& function, const prepared_mesh& a,
                                        const prepared_mesh& b, const mesh_pair_options& options) {
    detail::check_radius(("treeform::" + function).c_str(), options.radius);
    const transformed<3> tree_a(build_face_tree(a, (function + ": a").c_str()),
                                options.transform_a);
    const transformed<3> tree_b(build_face_tree(b, (function + ": b").c_str()),
                                options.transform_b);
    if (a.indexed_view().faces.empty() || b.indexed_view().faces.empty()) return std::nullopt;
    const auto& in_a = detail::nearness::face_blocks_of(a);
    const auto& in_b = detail::nearness::face_blocks_of(b);
    const double unit = unit_for(tree_a, tree_b);
    detail::pair_walk<3> walk(tree_a, tree_b, unit);
    const detail::nearness::cylinder_pair cylinders{in_a.cylinders, in_b.cylinders, walk.map_a(),
                                                    walk.map_b()};
    const auto by_cylinders = [&](const detail::opened_node& at, unsigned mask, float bound,
                                  float* squared) {
        return cylinders.raise(at, mask, bound, squared);
    };
    const detail::raise_bounds raise = by_cylinders;
    walk.raise_by(raise);
    return search({in_a.triangles, tree_a, unit}, {in_b.triangles, tree_b, unit}, walk, unit,
                  options.radius);
}

std::optional<closest_pair_result> find_between(const char* function, const mesh_ref& a,
                                                const mesh_ref& b,
                                                const mesh_pair_options& options) {
    if (!detail::base::is_prepared_or_cloud(a, b))
        return find(function, a.view(), b.view(), options);
    return find(function, *detail::base::prepared_ref(a), *detail::base::prepared_ref(b), options);
}

}  // namespace

std::optional<closest_pair_result> closest_pair(const mesh_ref& a, const mesh_ref& b,
                                                const mesh_pair_options& options) {
    return find_between("closest_pair", a, b, options);
}

double distance(const mesh_ref& a, const mesh_ref& b, const mesh_pair_options& options) {
    const auto found = find_between("distance", a, b, options);
    return found ? found->distance : std::numeric_limits<double>::infinity();
}

}  // namespace treeform
