#include "bindings.hpp"

namespace binding {
namespace {

using id = std::int64_t;

/// The boxes of two arrays, with a tree over them; the arrays may go.
template <std::size_t D>
class boxes {
  public:
    using point = std::array<double, D>;
    using box = tf::aabb<double, D>;

    boxes(const array_of<double>& mins, const array_of<double>& maxs)
        : boxes_(boxes_of(mins, maxs)), tree_(run([this](const tf::progress_callback&) {
              return tf::build(boxes_, [](const box& one) { return one; });
          })) {}

    [[nodiscard]] std::size_t size() const { return boxes_.size(); }

    /// [n][D] the lows and the highs.
    [[nodiscard]] py::tuple bounds() const {
        return py::make_tuple(column(boxes_, [](const box& one) { return one.min; }),
                              column(boxes_, [](const box& one) { return one.max; }));
    }

    /// [n][2] the pairs of boxes that overlap, ascending.
    py::array pairs() const {
        return as_pairs(run([&](const tf::progress_callback&) {
            const std::atomic<bool>* const stop = stop_of_job();
            return tf::search_self_all(tree_, [&](std::uint32_t a, std::uint32_t b) {
                return (stop == nullptr || !*stop) && tf::overlaps(boxes_[a], boxes_[b]);
            });
        }));
    }

    /// [n][2] the pairs of a box of this and a box of the other that overlap, ascending.
    py::array pairs_with(const boxes& other) const {
        return as_pairs(run([&](const tf::progress_callback&) {
            const std::atomic<bool>* const stop = stop_of_job();
            return tf::search_all(tree_, other.tree_, [&](std::uint32_t a, std::uint32_t b) {
                return (stop == nullptr || !*stop) && tf::overlaps(boxes_[a], other.boxes_[b]);
            });
        }));
    }

    /// The boxes that overlap each query: where its list begins, and numbers, ascending.
    py::tuple query(const array_of<double>& mins, const array_of<double>& maxs) const {
        const std::vector<box> all = boxes_of(mins, maxs);
        for (std::size_t q = 0; q < all.size(); ++q)
            for (std::size_t k = 0; k < D; ++k)
                if (std::isnan(all[q].min[k]) || std::isnan(all[q].max[k]))
                    throw std::invalid_argument("query " + std::to_string(q) +
                                                " has a coordinate that is NaN");
        std::vector<id> begins{0}, ids;
        run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
            std::vector<std::vector<std::uint32_t>> found(end - begin);
            tf::for_chunks(found.size(), 64, [&](std::size_t from, std::size_t to, std::size_t) {
                for (std::size_t q = from; q < to; ++q)
                    found[q] = tf::search_all(tree_, all[begin + q], [&](std::uint32_t i) {
                        return tf::overlaps(boxes_[i], all[begin + q]);
                    });
            });
            for (const auto& one : found) {
                ids.insert(ids.end(), one.begin(), one.end());
                begins.push_back(static_cast<id>(ids.size()));
            }
        });
        return py::make_tuple(as_array<id>(std::move(begins)), as_array<id>(std::move(ids)));
    }

    /// [Q][k] distances and numbers of boxes, nearest first; infinite and `size()` where there are
    /// fewer.
    py::tuple nearest(const array_of<double>& queries, std::size_t k, double radius) const {
        const auto all = rows_of<point>(queries);
        std::vector<double> distances(entries(all.size(), k),
                                      std::numeric_limits<double>::infinity());
        std::vector<id> ids(distances.size(), static_cast<id>(size()));
        run_pieces(all.size(), [&](std::size_t begin, std::size_t end) {
            const auto some = all.subspan(begin, end - begin);
            const auto found =
                tf::k_nearest_batch(tree_, some, std::min(k, size()),
                                    [&](std::size_t q, std::uint32_t i) {
                                        return tf::squared_distance(boxes_[i], some[q]);
                                    },
                                    {.radius = radius});
            for (std::size_t q = 0; q < found.size(); ++q)
                for (std::size_t i = 0; i < found[q].size(); ++i) {
                    distances[(begin + q) * k + i] = std::sqrt(found[q][i].squared_distance());
                    ids[(begin + q) * k + i] = found[q][i].id;
                }
        });
        return py::make_tuple(as_array<double>(std::move(distances)), as_array<id>(std::move(ids)));
    }

  private:
    static std::vector<box> boxes_of(const array_of<double>& mins, const array_of<double>& maxs) {
        const auto low = rows_of<point>(mins), high = rows_of<point>(maxs);
        if (low.size() != high.size())
            throw std::invalid_argument("treeform: as many lows as highs are needed");
        std::vector<box> all(low.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].min = low[i];
            all[i].max = high[i];
        }
        return all;
    }

    static py::array as_pairs(const std::vector<tf::id_pair>& pairs) {
        return column(pairs, [](const tf::id_pair& pair) {
            return std::array<id, 2>{pair.first, pair.second};
        });
    }

    std::vector<box> boxes_;
    tf::tree<D> tree_;
};

template <std::size_t D>
void add_boxes_of(py::module_& module, const char* name) {
    py::class_<boxes<D>>(module, name)
        .def(py::init<const array_of<double>&, const array_of<double>&>())
        .def("__len__", &boxes<D>::size)
        .def("bounds", &boxes<D>::bounds)
        .def("pairs", &boxes<D>::pairs)
        .def("pairs_with", &boxes<D>::pairs_with)
        .def("query", &boxes<D>::query)
        .def("nearest", &boxes<D>::nearest);
    make_jobs(module.attr(name), {"pairs", "pairs_with", "query", "nearest"});
}

}  // namespace

void add_boxes(py::module_& module) {
    add_boxes_of<2>(module, "Boxes2");
    add_boxes_of<3>(module, "Boxes3");
}

}  // namespace binding
