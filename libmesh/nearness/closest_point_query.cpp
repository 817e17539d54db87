#include <libmesh/base/build_face_tree.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/geometry/based_triangle.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/nearness/closest_point_query.hpp>
#include <treeform/tree/detail/morton_order.hpp>
#include <treeform/tree/detail/near_query.hpp>
#include <treeform/tree/detail/squared_radius.hpp>
#include <treeform/tree/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libmesh/nearness/closest_point_query.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Behind the two, as they are compiled for each target.
#include <libmesh/geometry/closest_lanes-inl.hpp>
#include <libtree/query/near_walk-inl.hpp>

#ifndef TREEFORM_CLOSEST_POINT_QUERY_ONCE
#define TREEFORM_CLOSEST_POINT_QUERY_ONCE
namespace treeform::detail::nearness {
namespace {

/// Rows of a block: the members of eight `based_triangle`s.
enum row : std::size_t {
    corner = 0,
    base = 3,
    height = 6,
    apex = 9,
    per_base = 10,
    per_height = 11,
    rows = 12
};

struct triangle_blocks {
    const tree<3>* nodes;
    const double* triangles;

    [[nodiscard]] geometry::based_triangle at(std::size_t place) const {
        const double* const slot = triangles + place / 8 * rows * 8 + place % 8;
        geometry::based_triangle t;
        for (std::size_t k = 0; k < 3; ++k) {
            t.corner[k] = slot[(corner + k) * 8];
            t.base[k] = slot[(base + k) * 8];
            t.height[k] = slot[(height + k) * 8];
        }
        t.apex = slot[apex * 8];
        t.per_base = slot[per_base * 8];
        t.per_height = slot[per_height * 8];
        return t;
    }
};

/// The nearest so far.
struct closest_so_far {
    double squared;  ///< nothing further is of interest
    std::uint32_t place = 0;
    bool found = false;
    double s = 0.0, t = 0.0;  ///< where on the triangle at `place`
};

}  // namespace
}  // namespace treeform::detail::nearness
#endif

HWY_BEFORE_NAMESPACE();
namespace treeform::detail::nearness::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace trees = detail::HWY_NAMESPACE;
namespace triangles = geometry::HWY_NAMESPACE;

struct closest_in_block {
    alignas(64) double s[8];
    alignas(64) double t[8];
    alignas(64) double squared[8];
};

HWY_INLINE void closest_to_eight(const double* block, const point3& p, closest_in_block& found) {
    const hn::CappedTag<double, 8> d;
    using lanes = hn::Vec<decltype(d)>;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
        triangles::based_lanes<lanes> of;
        for (std::size_t k = 0; k < 3; ++k) {
            of.from[k] = hn::Sub(hn::Set(d, p[k]), hn::Load(d, block + (corner + k) * 8 + i));
            of.base[k] = hn::Load(d, block + (base + k) * 8 + i);
            of.height[k] = hn::Load(d, block + (height + k) * 8 + i);
        }
        of.apex = hn::Load(d, block + apex * 8 + i);
        of.per_base = hn::Load(d, block + per_base * 8 + i);
        of.per_height = hn::Load(d, block + per_height * 8 + i);
        const auto closest = triangles::closest_on(d, of);
        hn::Store(closest.s, d, found.s + i);
        hn::Store(closest.t, d, found.t + i);
        hn::Store(closest.squared, d, found.squared + i);
    }
}

void search_closest(const triangle_blocks& blocks, const point3& p, const near_query<3>& framed,
                    closest_so_far& best) {
    strategy::depth_first::frontier<near_entry, near_depth> frontier;
    const tree<3>& t = *blocks.nodes;
    const std::uint32_t* const ids = t.ids().data();
    const wide_node<3>* const boxes = t.level(t.levels() - 1).data();
    const auto leaf = [&](std::uint32_t block, float& bound) {
        alignas(64) float lower[8];
        unsigned mask = trees::near_mask(boxes[block], framed.low, framed.high, bound, lower);
        if (mask == 0) return;
        closest_in_block found;
        closest_to_eight(blocks.triangles + std::size_t{block} * rows * 8, p, found);
        for (; mask != 0; mask &= mask - 1) {
            const auto slot = static_cast<std::uint32_t>(std::countr_zero(mask));
            const double squared = found.squared[slot];
            const std::uint32_t place = block * 8 + slot;
            const bool nearer =
                squared < best.squared ||
                (squared == best.squared && (!best.found || ids[place] < ids[best.place]));
            if (nearer) best = {squared, place, true, found.s[slot], found.t[slot]};
        }
        bound = framed.bound_of(best.squared);
    };
    trees::walk_near(t, framed, framed.bound_of(best.squared), frontier, leaf);
}

}  // namespace
}  // namespace treeform::detail::nearness::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace treeform::detail::nearness {
namespace {

HWY_EXPORT(search_closest);

/// With the largest coordinate below 2^300, a query whose coordinates exceed 2^500 is as far from
/// every point of the mesh, to 2^-200 of the distance.
constexpr int largest_exponent = 300;
constexpr double far_off = 0x1p500;

double unit_for(double scale, double largest) {
    if (largest == 0.0) return 1.0;
    const int exponent = std::ilogb(largest);
    const int at = exponent + std::ilogb(scale);
    if (at < -largest_exponent) return std::ldexp(1.0, std::min(-exponent, 1000));
    return at < largest_exponent ? scale : std::ldexp(1.0, largest_exponent - 1 - exponent);
}

using base::largest_of;
using base::scaled;

double largest_in(mesh_view mesh) {
    std::vector<double> largest(chunk_count(mesh.faces.size(), light_grain));
    for_chunks(
        mesh.faces.size(), light_grain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
            for (std::size_t i = begin; i < end; ++i)
                for (const std::uint32_t corner : mesh.faces[i])
                    largest[chunk] = std::max(largest[chunk], largest_of(mesh.points[corner]));
        });
    return largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
}

double distance_between(const point3& a, const point3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

void check_query(const point3& query, const std::string& which) {
    if (!detail::base::is_finite(query))
        throw std::invalid_argument("treeform::closest_point: " + which + " is not finite");
}

/// A search with all lengths multiplied by a power of two.
class closest_searcher {
  public:
    closest_searcher(const triangle_blocks& blocks, double unit) : blocks_(blocks), unit_(unit) {}

    /// `limit`: a distance, inclusive.
    [[nodiscard]] std::optional<closest_point_result> operator()(const point3& query,
                                                                 double limit) const {
        if (blocks_.nodes->size() == 0) return std::nullopt;
        const point3 p = scaled(query, unit_);
        if (!(largest_of(p) < far_off)) return as_good_as_any(query, limit);
        const double reach = limit * unit_;
        closest_so_far best{squared_limit(reach)};
        const aabb<double, 3> at{{query.x, query.y, query.z}, {query.x, query.y, query.z}};
        HWY_DYNAMIC_DISPATCH(search_closest)
        (blocks_, p, near_query<3>(blocks_.nodes->frame(), at, unit_), best);
        if (!best.found) return std::nullopt;
        const double per_unit = 1.0 / unit_;
        return closest_point_result{blocks_.nodes->ids()[best.place],
                                    std::sqrt(best.squared) * per_unit,
                                    scaled(blocks_.at(best.place).at(best.s, best.t), per_unit)};
    }

  private:
    [[nodiscard]] std::optional<closest_point_result> as_good_as_any(const point3& query,
                                                                     double limit) const {
        const auto ids = blocks_.nodes->ids();
        const auto lowest = std::min_element(ids.begin(), ids.end());
        const point3 p =
            scaled(blocks_.at(static_cast<std::size_t>(lowest - ids.begin())).corner, 1.0 / unit_);
        const double distance = distance_between(p, query);
        if (!(distance <= limit)) return std::nullopt;
        return closest_point_result{*lowest, distance, p};
    }

    triangle_blocks blocks_;
    double unit_;
};

/// Queries that one thread answers in a row.
constexpr std::size_t queries_per_chunk = 256;

}  // namespace

closest_point_query::closest_point_query(mesh_view mesh, const char* function) {
    tree_ = build_face_tree(mesh, function);
    const std::size_t blocks = chunk_count(tree_.size(), 8);
    triangles_.resize(blocks * rows * 8);
    largest_ = largest_in(mesh);
    unit_ = unit_for(tree_.frame().scale, largest_);
    for_chunks(blocks, 512, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t place = begin * 8; place < end * 8; ++place) {
            double* const slot = triangles_.data() + place / 8 * rows * 8 + place % 8;
            if (place >= tree_.size()) {
                for (std::size_t row = 0; row < rows; ++row) slot[row * 8] = 0.0;
                continue;
            }
            const face& f = mesh.faces[tree_.ids()[place]];
            const geometry::based_triangle t({scaled(mesh.points[f[0]], unit_),
                                              scaled(mesh.points[f[1]], unit_),
                                              scaled(mesh.points[f[2]], unit_)});
            for (std::size_t k = 0; k < 3; ++k) {
                slot[(corner + k) * 8] = t.corner[k];
                slot[(base + k) * 8] = t.base[k];
                slot[(height + k) * 8] = t.height[k];
            }
            slot[apex * 8] = t.apex;
            slot[per_base * 8] = t.per_base;
            slot[per_height * 8] = t.per_height;
        }
    });
}

std::optional<closest_point_result> closest_point_query::nearest(const point3& query,
                                                                 double radius) const {
    check_radius("treeform::closest_point", radius);
    check_query(query, "the query");
    return closest_searcher({&tree_, triangles_.data()}, unit_)(query, radius);
}

template <class NumberOf, class RadiusOf>
std::vector<std::optional<closest_point_result>> closest_point_query::answers(
    std::span<const point3> queries, const NumberOf& number_of, const RadiusOf& radius_of) const {
    for (std::size_t i = 0; i < queries.size(); ++i)
        if (!detail::base::is_finite(queries[i]))
            check_query(queries[i], "point " + std::to_string(i));
    std::vector<std::optional<closest_point_result>> found(queries.size());
    const closest_searcher search({&tree_, triangles_.data()}, unit_);
    for_chunks(
        queries.size(), queries_per_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
            // What was nearest to the query before is not far from this one. It was
            // rounded, and distances are: by some 2^-50 of the largest coordinate.
            const double slack = 0x1p-44 * largest_;
            std::optional<point3> near;
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t number = number_of(i);
                const point3& query = queries[number];
                double limit = radius_of(number);
                if (near)
                    limit =
                        std::min(limit, distance_between(*near, query) * (1.0 + 0x1p-40) + slack);
                found[number] = search(query, limit);
                if (found[number]) near = found[number]->point;
            }
        });
    return found;
}

std::vector<std::optional<closest_point_result>> closest_point_query::nearest(
    std::span<const point3> queries, double radius) const {
    check_radius("treeform::closest_point", radius);
    const std::vector<std::uint32_t> order = morton_order<3>(queries.size(), [&](std::size_t i) {
        return std::array<double, 3>{queries[i].x, queries[i].y, queries[i].z};
    });
    return answers(
        queries, [&](std::size_t i) { return std::size_t{order[i]}; },
        [&](std::size_t) { return radius; });
}

std::vector<std::optional<closest_point_result>> closest_point_query::nearest_in_order(
    std::span<const point3> queries, std::span<const double> radii) const {
    return answers(
        queries, [](std::size_t i) { return i; }, [&](std::size_t i) { return radii[i]; });
}

const closest_point_query& closest_point_query_of(const prepared_mesh& mesh) {
    constexpr base::slot<closest_point_query> slot{base::slot_name::closest_triangles};
    return base::prepared_slots::get(mesh, slot,
                                     [&] { return closest_point_query(mesh.indexed_view()); });
}

}  // namespace treeform::detail::nearness

namespace treeform {

using detail::nearness::closest_point_query;
using detail::nearness::closest_point_query_of;

std::optional<closest_point_result> closest_point(const mesh_ref& mesh, const point3& query,
                                                  double radius) {
    return closest_point_query_of(detail::base::prepared_ref(mesh)).nearest(query, radius);
}

std::vector<std::optional<closest_point_result>> closest_point(const mesh_ref& mesh,
                                                               std::span<const point3> queries,
                                                               double radius) {
    return closest_point_query_of(detail::base::prepared_ref(mesh)).nearest(queries, radius);
}

}  // namespace treeform

#endif
