#include <treeform/tree/aabb.hpp>
#include <treeform/tree/build.hpp>
#include <treeform/tree/nearness_batch.hpp>
#include <treeform/tree/point_search.hpp>
#include <treeform/tree/ray.hpp>
#include <treeform/tree/search.hpp>
#include <treeform/tree/search_pair.hpp>

#include <tools/c/glue.hpp>

#include <algorithm>
#include <array>
#include <variant>

namespace tf = treeform;

namespace {

template <std::size_t D>
using point_of = std::array<double, D>;

template <std::size_t D>
std::span<const point_of<D>> points_of(const double* data, std::size_t count, const char* name) {
    static_assert(sizeof(point_of<D>) == D * sizeof(double));
    (void)glue::array(data, count, name);
    return {reinterpret_cast<const point_of<D>*>(data), count};
}

template <std::size_t D>
struct points_and_tree {
    static constexpr std::size_t dimensions = D;
    tf::point_search<D> search;
};

template <std::size_t D>
struct boxes_and_tree {
    static constexpr std::size_t dimensions = D;
    std::vector<tf::aabb<double, D>> boxes;
    tf::tree<D> tree;
};

/// Boxes of a caller. Which ones make no sense, `build` and `search_all` know.
template <std::size_t D>
std::vector<tf::aabb<double, D>> boxes_of(const double* mins, const double* maxs,
                                          std::size_t count) {
    const auto low = points_of<D>(mins, count, "mins");
    const auto high = points_of<D>(maxs, count, "maxs");
    std::vector<tf::aabb<double, D>> boxes(count);
    for (std::size_t i = 0; i < count; ++i) {
        boxes[i].min = low[i];
        boxes[i].max = high[i];
    }
    return boxes;
}

/// The function with the dimensions as a type: 2 or 3.
template <class Call>
void with_dimensions(std::uint32_t dimensions, const Call& call) {
    if (dimensions == 2)
        call(std::integral_constant<std::size_t, 2>{});
    else if (dimensions == 3)
        call(std::integral_constant<std::size_t, 3>{});
    else
        throw std::invalid_argument("dimensions is " + std::to_string(dimensions) +
                                    ", which is neither 2 nor 3");
}

void give_pairs(const std::vector<tf::id_pair>& found, treeform_id_pairs** out) {
    auto made = glue::make<treeform_id_pairs>();
    std::vector<std::uint32_t> flat;
    flat.reserve(2 * found.size());
    for (const tf::id_pair& one : found) flat.insert(flat.end(), {one.first, one.second});
    made->value.count = found.size();
    made->value.pairs = made->keep(std::move(flat)).data();
    glue::give(std::move(made), out);
}

/// [count] lists that `list_of(i)` makes in parallel, one after the other.
template <class ListOf>
void give_lists(std::size_t count, const ListOf& list_of, treeform_id_lists** out) {
    auto made = glue::make<treeform_id_lists>();
    std::vector<std::size_t> begins{0};
    std::vector<std::uint32_t> ids;
    glue::in_pieces(count, [&](std::size_t begin, std::size_t end) {
        std::vector<std::vector<std::uint32_t>> lists(end - begin);
        tf::for_chunks(lists.size(), 64, [&](std::size_t from, std::size_t to, std::size_t) {
            for (std::size_t i = from; i < to; ++i) lists[i] = list_of(begin + i);
        });
        for (const auto& one : lists) {
            ids.insert(ids.end(), one.begin(), one.end());
            begins.push_back(ids.size());
        }
    });
    made->value.count = count;
    made->value.begin = made->keep(std::move(begins)).data();
    made->value.ids = made->keep(std::move(ids)).data();
    glue::give(std::move(made), out);
}

/// Rows of k answers from query `begin` on, filled up where there are fewer;
/// `distance_of(neighbor)` is not squared.
template <class Lists, class DistanceOf>
void fill_rows(const Lists& found, std::size_t begin, std::size_t k, std::uint32_t* ids,
               double* distances, const DistanceOf& distance_of) {
    for (std::size_t query = 0; query < found.size(); ++query) {
        const auto row = found[query];
        for (std::size_t i = 0; i < k; ++i) {
            const std::size_t at = (begin + query) * k + i;
            if (ids) ids[at] = i < row.size() ? row[i].id : TREEFORM_NONE;
            if (distances) distances[at] = i < row.size() ? distance_of(row[i]) : glue::infinity;
        }
    }
}

template <class Tree>
constexpr std::size_t dimensions_of = std::remove_cvref_t<Tree>::dimensions;

}  // namespace

struct treeform_point_tree {
    void* owner;
    std::variant<points_and_tree<2>, points_and_tree<3>> of;
};

struct treeform_box_tree {
    void* owner;
    std::variant<boxes_and_tree<2>, boxes_and_tree<3>> of;
};

namespace {

template <class Call>
void with(const treeform_point_tree* tree, const Call& call) {
    std::visit(call, glue::need(tree, "tree").of);
}
template <class Call>
void with(const treeform_box_tree* tree, const Call& call) {
    std::visit(call, glue::need(tree, "tree").of);
}

}  // namespace

treeform_code treeform_point_tree_create(const double* points, size_t count, uint32_t dimensions,
                                         treeform_point_tree** tree) {
    return glue::guard([&] {
        glue::start(tree);
        auto made = glue::make<treeform_point_tree>();
        with_dimensions(dimensions, [&](auto d) {
            const auto all = points_of<d.value>(points, count, "points");
            made->value.of = points_and_tree<d.value>{tf::point_search<d.value>(all)};
        });
        glue::give(std::move(made), tree);
    });
}

treeform_code treeform_point_tree_size(const treeform_point_tree* tree, size_t* count) {
    return glue::guard([&] {
        (void)glue::need(count, "count");
        with(tree, [&](const auto& of) { *count = of.search.size(); });
    });
}

treeform_code treeform_point_tree_nearest(const treeform_point_tree* tree, const double* queries,
                                          size_t count, size_t k, double radius, uint32_t* ids,
                                          double* distances) {
    return glue::guard([&] {
        with(tree, [&](const auto& of) {
            const auto all = points_of<dimensions_of<decltype(of)>>(queries, count, "queries");
            glue::in_pieces(count, [&](std::size_t begin, std::size_t end) {
                fill_rows(of.search.k_nearest(all.subspan(begin, end - begin), k, radius), begin, k,
                          ids, distances, [](const tf::near_point& one) { return one.distance; });
            });
        });
    });
}

treeform_code treeform_point_tree_within(const treeform_point_tree* tree, const double* queries,
                                         size_t count, double radius,
                                         treeform_neighbors** neighbors) {
    return glue::guard([&] {
        glue::start(neighbors);
        auto made = glue::make<treeform_neighbors>();
        with(tree, [&](const auto& of) {
            const auto all = points_of<dimensions_of<decltype(of)>>(queries, count, "queries");
            auto& found = made->keep(tf::neighbor_lists<tf::near_point>{{0}, {}});
            glue::in_pieces(count, [&](std::size_t begin, std::size_t end) {
                auto some = of.search.all_within(all.subspan(begin, end - begin), radius);
                glue::append(found.begin, found.neighbors, std::move(some.begin),
                             std::move(some.neighbors));
            });
            made->value.begin = found.begin.data();
            made->value.neighbors = glue::same<treeform_neighbor>(found.neighbors);
            made->value.count = count;
        });
        glue::give(std::move(made), neighbors);
    });
}

treeform_code treeform_point_tree_pairs(const treeform_point_tree* tree, double radius,
                                        treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        with(tree, [&](const auto& of) {
            bool stopped = false;
            const auto report = [&](double done) {
                stopped = glue::thread_progress() && !glue::thread_progress()(done);
                return !stopped;
            };
            const auto found = of.search.pairs_within(radius, report);
            if (stopped) throw glue::cancelled{};
            give_pairs(found, pairs);
        });
    });
}

treeform_code treeform_box_tree_create(const double* mins, const double* maxs, size_t count,
                                       uint32_t dimensions, treeform_box_tree** tree) {
    return glue::guard([&] {
        glue::start(tree);
        auto made = glue::make<treeform_box_tree>();
        with_dimensions(dimensions, [&](auto d) {
            boxes_and_tree<d.value> of{boxes_of<d.value>(mins, maxs, count), {}};
            of.tree = tf::build(of.boxes, [](const auto& box) { return box; });
            made->value.of = std::move(of);
        });
        glue::give(std::move(made), tree);
    });
}

treeform_code treeform_box_tree_size(const treeform_box_tree* tree, size_t* count) {
    return glue::guard([&] {
        (void)glue::need(count, "count");
        with(tree, [&](const auto& of) { *count = of.boxes.size(); });
    });
}

treeform_code treeform_box_tree_pairs(const treeform_box_tree* tree, treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        with(tree, [&](const auto& of) {
            give_pairs(tf::search_self_all(of.tree,
                                           [&](std::uint32_t a, std::uint32_t b) {
                                               return tf::overlaps(of.boxes[a], of.boxes[b]);
                                           }),
                       pairs);
        });
    });
}

treeform_code treeform_box_tree_pairs_of(const treeform_box_tree* a, const treeform_box_tree* b,
                                         treeform_id_pairs** pairs) {
    return glue::guard([&] {
        glue::start(pairs);
        with(a, [&](const auto& x) {
            const auto* const y =
                std::get_if<std::remove_cvref_t<decltype(x)>>(&glue::need(b, "tree").of);
            if (!y) throw std::invalid_argument("the trees have different dimensions");
            give_pairs(tf::search_all(x.tree, y->tree,
                                      [&](std::uint32_t i, std::uint32_t j) {
                                          return tf::overlaps(x.boxes[i], y->boxes[j]);
                                      }),
                       pairs);
        });
    });
}

treeform_code treeform_box_tree_query(const treeform_box_tree* tree, const double* mins,
                                      const double* maxs, size_t count, treeform_id_lists** lists) {
    return glue::guard([&] {
        glue::start(lists);
        with(tree, [&](const auto& of) {
            const auto queries = boxes_of<dimensions_of<decltype(of)>>(mins, maxs, count);
            give_lists(
                count,
                [&](std::size_t i) {
                    return tf::search_all(of.tree, queries[i], [&](std::uint32_t id) {
                        return tf::overlaps(of.boxes[id], queries[i]);
                    });
                },
                lists);
        });
    });
}

treeform_code treeform_box_tree_rays(const treeform_box_tree* tree, const double* origins,
                                     const double* directions, size_t count,
                                     treeform_id_lists** lists) {
    return glue::guard([&] {
        glue::start(lists);
        with(tree, [&](const auto& of) {
            constexpr std::size_t D = dimensions_of<decltype(of)>;
            const auto from = points_of<D>(origins, count, "origins");
            const auto along = points_of<D>(directions, count, "directions");
            give_lists(
                count,
                [&](std::size_t i) {
                    std::vector<std::uint32_t> met;
                    const tf::ray<double, D> ray{from[i], along[i]};
                    tf::visit_along(of.tree, ray, [&](std::uint32_t id) {
                        met.push_back(id);
                        return glue::infinity;
                    });
                    std::sort(met.begin(), met.end());
                    return met;
                },
                lists);
        });
    });
}

treeform_code treeform_box_tree_nearest(const treeform_box_tree* tree, const double* points,
                                        size_t count, size_t k, double radius, uint32_t* ids,
                                        double* distances) {
    return glue::guard([&] {
        with(tree, [&](const auto& of) {
            const auto queries = points_of<dimensions_of<decltype(of)>>(points, count, "points");
            glue::in_pieces(count, [&](std::size_t begin, std::size_t end) {
                const auto some = queries.subspan(begin, end - begin);
                const auto found =
                    tf::k_nearest_batch(of.tree, some, k,
                                        [&](std::size_t query, std::uint32_t id) {
                                            return tf::squared_distance(of.boxes[id], some[query]);
                                        },
                                        {.radius = radius});
                fill_rows(found, begin, k, ids, distances,
                          [](const auto& one) { return std::sqrt(one.squared_distance()); });
            });
        });
    });
}
