#pragma once
/// \file
/// Trees over points and boxes, in the plane and in space, in C.

#include <treeform/tree/point_search.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/search_pair.hpp>

#include <tools/bindings/box_trees.hpp>
#include <tools/c/made/structs.hpp>

#include <algorithm>
#include <array>
#include <variant>

namespace glue {

using tools::boxes_and_tree;

using point_tree = std::variant<tf::point_search<2>, tf::point_search<3>>;
using box_tree = std::variant<boxes_and_tree<2>, boxes_and_tree<3>>;

}  // namespace glue

struct treeform_point_tree {
    void* owner;
    std::optional<glue::point_tree> content;
};

struct treeform_box_tree {
    void* owner;
    std::optional<glue::box_tree> content;
};

namespace glue {

/// The caller's points, in D dimensions, or in those of a tree.
template <std::size_t D>
auto rows(const double* data, std::size_t count, const char* name) {
    return rows_of<std::array<double, D>>(data, count, name);
}
template <template <std::size_t> class Tree, std::size_t D>
auto rows(const Tree<D>&, const double* data, std::size_t count, const char* name) {
    return rows<D>(data, count, name);
}

template <std::size_t D>
auto boxes_of(const double* mins, const double* maxs, std::size_t count) {
    return tools::boxes_of<D>(rows<D>(mins, count, "mins"), rows<D>(maxs, count, "maxs"));
}

/// Calls `create` with the dimension, 2 or 3, as a type.
template <class Tree, class Create>
Tree of_dimensions(std::uint32_t dimensions, const Create& create) {
    if (dimensions == 2) return create(std::integral_constant<std::size_t, 2>{});
    if (dimensions == 3) return create(std::integral_constant<std::size_t, 3>{});
    throw std::invalid_argument("dimensions is " + std::to_string(dimensions) +
                                ", which is neither 2 nor 3");
}

inline answer_of<treeform_id_pairs> pairs_of(const std::vector<tf::id_pair>& found) {
    auto made = make<treeform_id_pairs>();
    auto& flat = made->keep(std::vector<std::uint32_t>());
    flat.reserve(2 * found.size());
    for (const tf::id_pair& one : found) flat.insert(flat.end(), {one.first, one.second});
    made->value.count = found.size();
    made->value.pairs = flat.data();
    return made;
}

/// The [count] lists that `list_of(i)` returns, computed in parallel, as one array.
template <class ListOf>
answer_of<treeform_id_lists> lists_of(std::size_t count, const ListOf& list_of) {
    auto made = make<treeform_id_lists>();
    auto& begins = made->keep(std::vector<std::size_t>{0});
    auto& ids = made->keep(std::vector<std::uint32_t>());
    in_pieces(count, [&](std::size_t begin, std::size_t end) {
        tools::append_lists(begin, end, begins, ids, list_of);
    });
    made->value.count = count;
    made->value.begin = begins.data();
    made->value.ids = ids.data();
    return made;
}

// ---- points ----

/// A tree over `points` [count][dimensions]; 2 or 3 dimensions.
inline point_tree point_tree_create(const double* points, std::size_t count,
                                    std::uint32_t dimensions) {
    return of_dimensions<point_tree>(dimensions, [&](auto d) {
        return tf::point_search<d.value>(rows<d.value>(points, count, "points"));
    });
}

/// Number of points.
inline std::size_t point_tree_size(const point_tree& tree) {
    return std::visit([](const auto& of) { return of.size(); }, tree);
}

/// The `k` nearest points of each of `queries` [count][dimensions], nearest first, within `radius`
/// (inclusive; infinite for none): `ids` [count][k] and `distances` [count][k], either of which may
/// be null. If there are fewer, the remaining ids are `TREEFORM_NONE` and distances infinite.
/// Equally near points are ordered by number.
inline void point_tree_nearest(const point_tree& tree, const double* queries, std::size_t count,
                               std::size_t k, double radius, std::uint32_t* ids,
                               double* distances) {
    std::visit(
        [&](const auto& of) {
            const auto all = rows(of, queries, count, "queries");
            in_pieces(count, [&](std::size_t begin, std::size_t end) {
                tools::fill_rows(of.k_nearest(all.subspan(begin, end - begin), k, radius), begin, k,
                                 ids, distances, TREEFORM_NONE,
                                 [](const tf::near_point& one) { return one.distance; });
            });
        },
        tree);
}

/// All points within `radius` (inclusive) of each query, nearest first.
inline answer_of<treeform_neighbors> point_tree_within(const point_tree& tree,
                                                       const double* queries, std::size_t count,
                                                       double radius) {
    auto made = make<treeform_neighbors>();
    auto& found = made->keep(tf::answer_lists<tf::near_point>{{0}, {}});
    std::visit(
        [&](const auto& of) {
            const auto all = rows(of, queries, count, "queries");
            in_pieces(count, [&](std::size_t begin, std::size_t end) {
                auto some = of.all_within(all.subspan(begin, end - begin), radius);
                append(found.begin, found.answers, std::move(some.begin), std::move(some.answers));
            });
        },
        tree);
    made->value.begin = found.begin.data();
    made->value.neighbors = same<treeform_neighbor>(found.answers);
    made->value.count = count;
    return made;
}

/// All pairs of points within `radius` (inclusive) of each other, each once, the lower number
/// first.
inline answer_of<treeform_id_pairs> point_tree_pairs(const point_tree& tree, double radius) {
    bool stopped = false;
    const auto report = [&](double done) {
        stopped = thread_progress() && !thread_progress()(done);
        return !stopped;
    };
    const auto found =
        std::visit([&](const auto& of) { return of.pairs_within(radius, report); }, tree);
    if (stopped) throw cancelled{};
    return pairs_of(found);
}

// ---- boxes ----

/// A tree over the boxes from `mins` [count][dimensions] to `maxs` [count][dimensions]; 2 or 3
/// dimensions. Returns `TREEFORM_INVALID` for a box that is not finite, or whose min exceeds its
/// max.
inline box_tree box_tree_create(const double* mins, const double* maxs, std::size_t count,
                                std::uint32_t dimensions) {
    return of_dimensions<box_tree>(dimensions, [&](auto d) {
        return boxes_and_tree<d.value>(boxes_of<d.value>(mins, maxs, count));
    });
}

/// Number of boxes.
inline std::size_t box_tree_size(const box_tree& tree) {
    return std::visit([](const auto& of) { return of.boxes.size(); }, tree);
}

/// All pairs of boxes that have a common point, each once, the lower number first; exact.
inline answer_of<treeform_id_pairs> box_tree_pairs(const box_tree& tree) {
    return std::visit(
        [](const auto& of) {
            return pairs_of(tf::search_self_all(of.tree, [&](std::uint32_t a, std::uint32_t b) {
                return tf::overlaps(of.boxes[a], of.boxes[b]);
            }));
        },
        tree);
}

/// All pairs of a box of `a` and a box of `b` that have a common point; exact.
inline answer_of<treeform_id_pairs> box_tree_pairs_of(const box_tree& a, const box_tree& b) {
    return std::visit(
        [&](const auto& x) {
            const auto* const y = std::get_if<std::remove_cvref_t<decltype(x)>>(&b);
            if (!y) throw std::invalid_argument("the trees have different dimensions");
            return pairs_of(tf::search_all(x.tree, y->tree, [&](std::uint32_t i, std::uint32_t j) {
                return tf::overlaps(x.boxes[i], y->boxes[j]);
            }));
        },
        a);
}

/// The boxes that have a common point with each of the query boxes [count], ascending; exact. A
/// query may be infinite; one whose min exceeds its max matches nothing.
inline answer_of<treeform_id_lists> box_tree_query(const box_tree& tree, const double* mins,
                                                   const double* maxs, std::size_t count) {
    return std::visit(
        [&]<std::size_t D>(const boxes_and_tree<D>& of) {
            const auto queries = boxes_of<D>(mins, maxs, count);
            return lists_of(count, [&](std::size_t i) { return of.overlapping(queries[i]); });
        },
        tree);
}

/// The boxes that each ray meets, ascending. Rays are origin + t direction with t >= 0, for
/// `origins` and `directions` [count][dimensions]. No box is missed; boxes that a ray misses by
/// less than the rounding of 32-bit floats may be included.
inline answer_of<treeform_id_lists> box_tree_rays(const box_tree& tree, const double* origins,
                                                  const double* directions, std::size_t count) {
    return std::visit(
        [&]<std::size_t D>(const boxes_and_tree<D>& of) {
            const auto from = rows<D>(origins, count, "origins");
            const auto along = rows<D>(directions, count, "directions");
            return lists_of(count, [&](std::size_t i) {
                std::vector<std::uint32_t> met;
                tf::visit_ray(of.tree, tf::ray<double, D>{from[i], along[i]},
                              [&](std::uint32_t id) {
                                  met.push_back(id);
                                  return infinity;
                              });
                std::sort(met.begin(), met.end());
                return met;
            });
        },
        tree);
}

/// The `k` boxes nearest to each of `points` [count][dimensions], within `radius`; results as in
/// `treeform_point_tree_nearest`. The distance of a point inside a box is 0.
inline void box_tree_nearest(const box_tree& tree, const double* points, std::size_t count,
                             std::size_t k, double radius, std::uint32_t* ids, double* distances) {
    std::visit(
        [&](const auto& of) {
            const auto queries = rows(of, points, count, "points");
            in_pieces(count, [&](std::size_t begin, std::size_t end) {
                tools::fill_rows(of.nearest(queries.subspan(begin, end - begin), k, radius), begin,
                                 k, ids, distances, TREEFORM_NONE,
                                 [](const auto& one) { return std::sqrt(one.squared_distance()); });
            });
        },
        tree);
}

}  // namespace glue
