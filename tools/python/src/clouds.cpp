#include "bindings.hpp"

namespace binding {
namespace {

using id = std::int64_t;  ///< as NumPy numbers elements

/// Points to search near, for the array that they are of.
template <std::size_t D>
class cloud {
  public:
    using point = std::array<double, D>;

    explicit cloud(const array_of<double>& points)
        : search_(run([rows = rows_of<point>(points)](const tf::progress_callback&) {
              return tf::point_search<D>(rows);
          })) {}

    [[nodiscard]] std::size_t size() const { return search_.size(); }

    /// [Q][k] distances and numbers of points, nearest first; infinite and `size()` where there are
    /// fewer. Nearer than `bound` if that is finite, as SciPy has it.
    py::tuple query(const array_of<double>& queries, std::size_t k, double bound) const {
        const auto all = rows_of<point>(queries);
        std::vector<double> distances(entries(all.size(), k),
                                      std::numeric_limits<double>::infinity());
        std::vector<id> ids(distances.size(), static_cast<id>(size()));
        run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
            const auto found =
                search_.k_nearest(all.subspan(begin, end - begin), std::min(k, size()), bound);
            for (std::size_t q = 0; q < found.size(); ++q)
                for (std::size_t i = 0; i < found[q].size(); ++i) {
                    if (!(found[q][i].distance < bound)) break;
                    distances[(begin + q) * k + i] = found[q][i].distance;
                    ids[(begin + q) * k + i] = found[q][i].id;
                }
        });
        return py::make_tuple(as_array<double>(std::move(distances)), as_array<id>(std::move(ids)));
    }

    /// All points within `radius` of each query: where its list begins, numbers, distances; nearest
    /// first, or by number.
    py::tuple query_ball(const array_of<double>& queries, double radius, bool by_number) const {
        const auto all = rows_of<point>(queries);
        std::vector<id> begins{0}, ids;
        std::vector<double> distances;
        run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
            auto found = search_.all_within(all.subspan(begin, end - begin), radius);
            for (std::size_t q = 0; q < found.size(); ++q) {
                const auto first =
                    found.neighbors.begin() + static_cast<std::ptrdiff_t>(found.begin[q]);
                const auto last =
                    found.neighbors.begin() + static_cast<std::ptrdiff_t>(found.begin[q + 1]);
                if (by_number)
                    std::sort(first, last,
                              [](const auto& a, const auto& b) { return a.id < b.id; });
                for (auto one = first; one != last; ++one) {
                    ids.push_back(one->id);
                    distances.push_back(one->distance);
                }
                begins.push_back(static_cast<id>(ids.size()));
            }
        });
        return py::make_tuple(as_array<id>(std::move(begins)), as_array<id>(std::move(ids)),
                              as_array<double>(std::move(distances)));
    }

    /// [n][2] the pairs of points within `radius`, ascending.
    [[nodiscard]] py::array query_pairs(double radius) const {
        if (!(radius >= 0.0)) throw std::invalid_argument("r: negative or NaN");
        const auto found = run([&](const tf::progress_callback& report) {
            return search_.pairs_within(radius, report);
        });
        return column(found, [](const tf::id_pair& pair) {
            return std::array<id, 2>{pair.first, pair.second};
        });
    }

  private:
    tf::point_search<D> search_;
};

/// Lists of Python of the numbers between two begins.
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

template <std::size_t D>
void add_cloud(py::module_& module, const char* name) {
    py::class_<cloud<D>>(module, name)
        .def(py::init<const array_of<double>&>())
        .def("__len__", &cloud<D>::size)
        .def("query", &cloud<D>::query)
        .def("query_ball", &cloud<D>::query_ball)
        .def("query_pairs", &cloud<D>::query_pairs);
    make_jobs(module.attr(name), {"query", "query_ball", "query_pairs"});
}

}  // namespace

void add_clouds(py::module_& module) {
    add_cloud<2>(module, "Cloud2");
    add_cloud<3>(module, "Cloud3");
    module.def("lists", &lists);
}

}  // namespace binding
