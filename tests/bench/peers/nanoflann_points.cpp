#include "bench/peers/nanoflann_points.hpp"

#include "bench/peers/nanoflann_cloud.hpp"
#include "bench/peers/versions.hpp"

#include <array>
#include <utility>

namespace treeform::bench {
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

struct nanoflann_float_tree::state {
    struct cloud {
        std::vector<std::array<float, 3>> points;

        [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
        [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t k) const {
            return points[i][k];
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;
        }
    };
    using index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, cloud>,
                                                      cloud, 3, std::uint32_t>;

    static std::array<float, 3> rounded(const point3& p) {
        return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    static cloud cloud_of(const std::vector<point3>& points) {
        cloud result;
        for (const point3& p : points) result.points.push_back(rounded(p));
        return result;
    }

    cloud given;
    index tree;

    explicit state(const std::vector<point3>& points)
        : given(cloud_of(points)), tree(3, given, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {}
};

nanoflann_float_tree::nanoflann_float_tree(const std::vector<point3>& points)
    : state_(std::make_unique<state>(points)) {
    state_->tree.buildIndex();
}

nanoflann_float_tree::~nanoflann_float_tree() = default;

std::vector<std::uint32_t> nanoflann_float_tree::k_nearest(const std::vector<point3>& queries,
                                                           std::size_t k) const {
    std::vector<std::uint32_t> ids(queries.size() * k);
    std::vector<float> distances(k);
    for (std::size_t i = 0; i < queries.size(); ++i)
        state_->tree.knnSearch(state::rounded(queries[i]).data(), k, ids.data() + i * k,
                               distances.data());
    return ids;
}

std::string nanoflann_name() {
    return "nanoflann " + std::to_string(NANOFLANN_VERSION >> 8) + "." +
           std::to_string(NANOFLANN_VERSION >> 4 & 15) + "." +
           std::to_string(NANOFLANN_VERSION & 15);
}

}  // namespace treeform::bench
