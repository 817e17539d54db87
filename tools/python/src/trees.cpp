#include "bindings.hpp"
#include "tools/bindings/box_trees.hpp"

namespace binding {
namespace {

using id = std::int64_t;  ///< as NumPy numbers elements

/// [Q][k] distances and numbers, nearest first, of what `find(begin, end)` finds for queries. If
/// there are fewer than k, the rest is infinite and `none`.
template <class Find, class DistanceOf>
py::tuple nearest_of(std::size_t queries, std::size_t k, std::size_t none, const Find& find,
                     const DistanceOf& distance_of) {
    std::vector<double> distances(entries(queries, k));
    std::vector<id> ids(distances.size());
    run_pieces(queries, [&](std::size_t begin, std::size_t end) {
        tools::fill_rows(find(begin, end), begin, k, ids.data(), distances.data(),
                         static_cast<id>(none), distance_of);
    });
    return py::make_tuple(as_array(std::move(distances)), as_array(std::move(ids)));
}

/// [n][2]
py::array as_pairs(const std::vector<tf::id_pair>& pairs) {
    return column(pairs, [](const tf::id_pair& pair) {
        return std::array<id, 2>{pair.first, pair.second};
    });
}

/// A search tree for the points of an array.
template <std::size_t D>
class cloud {
  public:
    using point = std::array<double, D>;

    explicit cloud(const array_of<double>& points)
        : search_(run([rows = rows_of<point>(points)](const tf::progress_callback&) {
              return tf::point_search<D>(rows);
          })) {}

    [[nodiscard]] std::size_t size() const { return search_.size(); }

    /// The nearest points that are nearer than `bound`, as in SciPy.
    py::tuple query(const array_of<double>& queries, std::size_t k, double bound) const {
        const auto all = rows_of<point>(queries);
        return nearest_of(
            all.size(), k, size(),
            [&](std::size_t begin, std::size_t end) {
                return search_.k_nearest(all.subspan(begin, end - begin), std::min(k, size()),
                                         bound);
            },
            [&](const tf::near_point& one) {
                return one.distance < bound ? one.distance : std::nan("");
            });
    }

    /// All points within `radius` of each query, nearest first or by number: where the list of each
    /// query begins, numbers, distances.
    py::tuple query_ball(const array_of<double>& queries, double radius, bool by_number) const {
        const auto all = rows_of<point>(queries);
        std::vector<id> begins{0}, ids;
        std::vector<double> distances;
        run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
            auto found = search_.all_within(all.subspan(begin, end - begin), radius);
            for (std::size_t q = 0; q < found.size(); ++q) {
                const std::span list(found.answers.data() + found.begin[q],
                                     found.answers.data() + found.begin[q + 1]);
                if (by_number) std::ranges::sort(list, {}, [](const auto& one) { return one.id; });
                for (const auto& one : list) {
                    ids.push_back(one.id);
                    distances.push_back(one.distance);
                }
                begins.push_back(static_cast<id>(ids.size()));
            }
        });
        return py::make_tuple(as_array(std::move(begins)), as_array(std::move(ids)),
                              as_array(std::move(distances)));
    }

    /// The pairs of points within `radius`, ascending.
    [[nodiscard]] py::array query_pairs(double radius) const {
        if (!(radius >= 0.0)) throw std::invalid_argument("r: negative or NaN");
        return as_pairs(run([&](const tf::progress_callback& report) {
            return search_.pairs_within(radius, report);
        }));
    }

  private:
    tf::point_search<D> search_;
};

/// Python lists of the numbers between consecutive begins.
py::list lists(const array_of<id>& begins, const array_of<id>& ids) {
    const auto begin = rows_of<id>(begins);
    const auto all = rows_of<id>(ids);
    py::list made(begin.size() - 1);
    for (std::size_t q = 0; q + 1 < begin.size(); ++q) {
        py::list one(static_cast<std::size_t>(begin[q + 1] - begin[q]));
        for (std::size_t i = 0; i < one.size(); ++i) {
            if (i % 65536 == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
            one[i] = py::int_(all[static_cast<std::size_t>(begin[q]) + i]);
        }
        made[q] = std::move(one);
    }
    return made;
}

/// A search tree for the boxes of two arrays, which are copied.
template <std::size_t D>
class boxes {
  public:
    using point = std::array<double, D>;
    using box = tf::aabb<double, D>;

    boxes(const array_of<double>& mins, const array_of<double>& maxs)
        : all_(run([all = boxes_of(mins, maxs)](const tf::progress_callback&) {
              return tools::boxes_and_tree<D>(all);
          })) {}

    [[nodiscard]] std::size_t size() const { return all_.boxes.size(); }

    /// [n][D] the lower and the upper corners.
    [[nodiscard]] py::tuple bounds() const {
        return py::make_tuple(column(all_.boxes, &box::min), column(all_.boxes, &box::max));
    }

    /// The pairs of boxes that overlap, ascending.
    py::array pairs() const {
        return pairs_by(
            *this, [&](const auto& overlap) { return tf::search_self_all(all_.tree, overlap); });
    }
    /// The pairs of a box of this tree and a box of the other that overlap, ascending.
    py::array pairs_with(const boxes& other) const {
        return pairs_by(other, [&](const auto& overlap) {
            return tf::search_all(all_.tree, other.all_.tree, overlap);
        });
    }

    /// The boxes that overlap each query, ascending: where the list of each query begins, numbers.
    py::tuple query(const array_of<double>& mins, const array_of<double>& maxs) const {
        const std::vector<box> queries = boxes_of(mins, maxs);
        for (std::size_t q = 0; q < queries.size(); ++q)
            for (std::size_t k = 0; k < D; ++k)
                if (std::isnan(queries[q].min[k]) || std::isnan(queries[q].max[k]))
                    throw std::invalid_argument("query " + std::to_string(q) +
                                                " has a coordinate that is NaN");
        std::vector<id> begins{0}, ids;
        run_pieces(queries.size(), [&](std::size_t begin, std::size_t end) {
            tools::append_lists(begin, end, begins, ids,
                                [&](std::size_t q) { return all_.overlapping(queries[q]); });
        });
        return py::make_tuple(as_array(std::move(begins)), as_array(std::move(ids)));
    }

    /// The nearest boxes.
    py::tuple nearest(const array_of<double>& queries, std::size_t k, double radius) const {
        const auto all = rows_of<point>(queries);
        return nearest_of(
            all.size(), k, size(),
            [&](std::size_t begin, std::size_t end) {
                return all_.nearest(all.subspan(begin, end - begin), std::min(k, size()), radius);
            },
            [](const auto& one) { return std::sqrt(one.squared_distance()); });
    }

  private:
    /// What `search` finds with a test that is false once the job has to stop.
    template <class Search>
    py::array pairs_by(const boxes& other, const Search& search) const {
        return as_pairs(run([&](const tf::progress_callback&) {
            const std::atomic<bool>* const stop = stop_of_job();
            return search([&](std::uint32_t a, std::uint32_t b) {
                return (stop == nullptr || !*stop) &&
                       tf::overlaps(all_.boxes[a], other.all_.boxes[b]);
            });
        }));
    }

    static std::vector<box> boxes_of(const array_of<double>& mins, const array_of<double>& maxs) {
        const auto low = rows_of<point>(mins), high = rows_of<point>(maxs);
        if (low.size() != high.size())
            throw std::invalid_argument("treeform: different numbers of lower and upper corners");
        return tools::boxes_of<D>(low, high);
    }

    tools::boxes_and_tree<D> all_;
};

template <std::size_t D>
void add_trees_of(py::module_& module, const char* cloud_name, const char* boxes_name) {
    py::class_<cloud<D>>(module, cloud_name)
        .def(py::init<const array_of<double>&>())
        .def("__len__", &cloud<D>::size)
        .def("query", &cloud<D>::query)               // -> tuple[Floats, Numbers]
        .def("query_ball", &cloud<D>::query_ball)     // -> tuple[Numbers, Numbers, Floats]
        .def("query_pairs", &cloud<D>::query_pairs);  // -> Numbers
    make_jobs(module.attr(cloud_name), {"query", "query_ball", "query_pairs"});
    py::class_<boxes<D>>(module, boxes_name)
        .def(py::init<const array_of<double>&, const array_of<double>&>())
        .def("__len__", &boxes<D>::size)
        .def("bounds", &boxes<D>::bounds)          // -> tuple[Floats, Floats]
        .def("pairs", &boxes<D>::pairs)            // -> Numbers
        .def("pairs_with", &boxes<D>::pairs_with)  // -> Numbers
        .def("query", &boxes<D>::query)            // -> tuple[Numbers, Numbers]
        .def("nearest", &boxes<D>::nearest);       // -> tuple[Floats, Numbers]
    make_jobs(module.attr(boxes_name), {"pairs", "pairs_with", "query", "nearest"});
}

}  // namespace

void add_trees(py::module_& module) {
    add_trees_of<2>(module, "Cloud2", "Boxes2");
    add_trees_of<3>(module, "Cloud3", "Boxes3");
    module.def("lists", &lists);  // -> list[list[int]]
}

}  // namespace binding
