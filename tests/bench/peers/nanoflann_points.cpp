#include "bench/peers/nanoflann_points.hpp"

#include "bench/peers/nanoflann_cloud.hpp"
#include "bench/peers/versions.hpp"

#include <array>
#include <utility>

namespace tf::bench {
namespace {

std::array<double, 3> flat(const point3& p) { return {p.x, p.y, p.z}; }

}  // namespace

struct nanoflann_tree::state {
    nanoflann_cloud given;
    nanoflann_index tree;

    explicit state(const std::vector<point3>& points)
        : given{points}, tree(3, given, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}
};

nanoflann_tree::nanoflann_tree(const std::vector<point3>& points)
    : state_(std::make_unique<state>(points)) {
    state_->tree.buildIndex();
}

nanoflann_tree::~nanoflann_tree() = default;

std::size_t nanoflann_tree::pairs_within(double reach) const {
    std::vector<std::pair<std::uint32_t, double>> found;
    nanoflann::SearchParams options;
    options.sorted = false;
    std::size_t count = 0;
    for (std::size_t i = 0; i < state_->given.points.size(); ++i) {
        const auto query = flat(state_->given.points[i]);
        state_->tree.radiusSearch(query.data(), reach * reach, found, options);
        for (const auto& [id, distance] : found) count += id > i;
    }
    return count;
}

std::vector<std::uint32_t> nanoflann_tree::k_nearest(const std::vector<point3>& queries,
                                                     std::size_t k) const {
    std::vector<std::uint32_t> ids(queries.size() * k);
    std::vector<double> distances(k);
    for (std::size_t i = 0; i < queries.size(); ++i)
        state_->tree.knnSearch(flat(queries[i]).data(), k, ids.data() + i * k, distances.data());
    return ids;
}

std::string nanoflann_name() {
    return "nanoflann " + std::to_string(NANOFLANN_VERSION >> 8) + "." +
           std::to_string(NANOFLANN_VERSION >> 4 & 15) + "." +
           std::to_string(NANOFLANN_VERSION & 15);
}

}  // namespace tf::bench
