#include <libmesh/place/quickhull.hpp>
#include <treeform/mesh/predicates.hpp>

#include <algorithm>
#include <cmath>

namespace treeform::detail::place {

scaled_points::scaled_points(points_view points) : points_(points.begin(), points.end()) {
    double largest = 0.0;
    for (const point3& p : points_)
        for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
    int exponent = 0;
    std::frexp(largest, &exponent);
    const double by = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    for (point3& p : points_) p = {p.x * by, p.y * by, p.z * by};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] =
            std::minmax_element(points_.begin(), points_.end(),
                                [k](const point3& a, const point3& b) { return a[k] < b[k]; });
        if (low != high) extent_ = std::max(extent_, (*high)[k] - (*low)[k]);
    }
    extent_ *= 1.0 + 0x1p-50;
}

quickhull::quickhull(points_view points, const scaled_points& scaled,
                     const std::array<std::uint32_t, 4>& first)
    : points_(points), scaled_(scaled), next_(points.size(), none), cone_at_(points.size(), none) {
    const auto& [a, b, c, d] = first;
    for (const face& corners : {face{a, b, c}, face{a, d, b}, face{b, d, c}, face{c, d, a}})
        make_facet(corners);
    // across a-b, b-c, c-a; a-d, d-b, b-a; ...
    facets_[0].beyond = {1, 2, 3};
    facets_[1].beyond = {3, 2, 0};
    facets_[2].beyond = {1, 3, 0};
    facets_[3].beyond = {2, 1, 0};
    for (std::uint32_t p = 0; p < points.size(); ++p)
        for (std::uint32_t f = 0; f < 4; ++f)
            if (keep_above(f, p)) break;
    for (std::uint32_t f = 0; f < 4; ++f) waiting_.push(f);
}

std::uint32_t quickhull::make_facet(const face& corners) {
    std::uint32_t at = static_cast<std::uint32_t>(facets_.size());
    if (free_.empty()) {
        facets_.emplace_back();
    } else {
        at = free_.back();
        free_.pop_back();
    }
    facet& f = facets_[at] = {};
    f.corner = corners;
    f.used = true;
    const point3 e = scaled_.difference(corners[1], corners[0]);
    const point3 g = scaled_.difference(corners[2], corners[0]);
    f.normal = base::cross(e, g);
    // With d = p - a rounded and n as above, the error of n . d is below 10 u of the sum of its six
    // products' magnitudes, where u = 2^-53: one for each difference and product, three for sums.
    // What denormals lose, of coordinates scaled or of products, is far below the constant.
    const double products = std::abs(e.y * g.z) + std::abs(e.z * g.y) + std::abs(e.z * g.x) +
                            std::abs(e.x * g.z) + std::abs(e.x * g.y) + std::abs(e.y * g.x);
    f.error = 0x1p-49 * products * scaled_.extent() + 1e-300;
    return at;
}

double quickhull::height(const facet& f, std::uint32_t p) const {
    return base::dot(f.normal, scaled_.difference(p, f.corner[0]));
}

bool quickhull::sees(const facet& f, std::uint32_t p, double height) const {
    if (std::abs(height) > f.error) return height > 0.0;
    return orient3d(points_[f.corner[0]], points_[f.corner[1]], points_[f.corner[2]], points_[p]) >
           0;
}

bool quickhull::keep_above(std::uint32_t at, std::uint32_t p) {
    facet& f = facets_[at];
    const double high = height(f, p);
    if (!sees(f, p, high)) return false;
    if (f.first_above == none || high > f.height || (high == f.height && p < f.highest)) {
        f.height = high;
        f.highest = p;
    }
    next_[p] = f.first_above;
    f.first_above = p;
    return true;
}

/// The facets that `p` is above of, which hang together, and the edges around them.
void quickhull::find_seen(std::uint32_t start, std::uint32_t p) {
    seen_.assign(1, start);
    rim_.clear();
    facets_[start].seen = true;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        const std::uint32_t at = seen_[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t beyond = facets_[at].beyond[k];
            facet& other = facets_[beyond];
            if (other.seen) continue;
            if (sees(other, p, height(other, p))) {
                other.seen = true;
                seen_.push_back(beyond);
            } else {
                const face& corner = facets_[at].corner;
                rim_.push_back({corner[k], corner[(k + 1) % 3], beyond});
            }
        }
    }
}

/// A facet from each edge of the rim to `p`. It is not degenerate: the edge lies in the plane of a
/// facet that p is strictly above of.
void quickhull::make_cone(std::uint32_t p) {
    cone_.clear();
    for (const rim_edge& e : rim_) {
        const std::uint32_t at = make_facet({e.from, e.to, p});
        facets_[at].beyond[0] = e.outside;
        const auto k = static_cast<std::size_t>(
            std::find(facets_[e.outside].corner.begin(), facets_[e.outside].corner.end(), e.to) -
            facets_[e.outside].corner.begin());
        facets_[e.outside].beyond[k] = at;
        cone_at_[e.from] = at;
        cone_.push_back(at);
    }
    for (const std::uint32_t at : cone_) {
        const std::uint32_t after = cone_at_[facets_[at].corner[1]];
        facets_[at].beyond[1] = after;
        facets_[after].beyond[2] = at;
    }
}

void quickhull::hand_over_points(std::uint32_t p) {
    for (const std::uint32_t from : seen_) {
        std::uint32_t q = facets_[from].first_above;
        while (q != none) {
            const std::uint32_t after = next_[q];
            if (q != p)
                for (const std::uint32_t to : cone_)
                    if (keep_above(to, q)) break;
            q = after;
        }
    }
}

bool quickhull::run(base::work_progress& work) {
    std::size_t added = 0;
    // The oldest first, so that the hull gets finer everywhere at once. Where it is fine beside
    // coarse, as around a cylinder's one rim and not the other, points see long rows of facets.
    while (!waiting_.empty()) {
        const std::uint32_t at = waiting_.front();
        waiting_.pop();
        if (!facets_[at].used || facets_[at].first_above == none) continue;
        if (added++ % 64 == 0 && !work.step(0.0, 0.9, added, 1000.0)) return false;
        const std::uint32_t p = facets_[at].highest;
        find_seen(at, p);
        make_cone(p);
        hand_over_points(p);
        for (const std::uint32_t gone : seen_) {
            facets_[gone].used = facets_[gone].seen = false;
            free_.push_back(gone);
        }
        for (const std::uint32_t made : cone_)
            if (facets_[made].first_above != none) waiting_.push(made);
    }
    return true;
}

std::vector<std::vector<face>> quickhull::sides() const {
    std::vector<std::vector<face>> result;
    std::vector<bool> done(facets_.size());
    std::vector<std::uint32_t> together;
    for (std::uint32_t start = 0; start < facets_.size(); ++start) {
        if (!facets_[start].used || done[start]) continue;
        const face& plane = facets_[start].corner;
        together.assign(1, start);
        done[start] = true;
        for (std::size_t i = 0; i < together.size(); ++i)
            for (const std::uint32_t beyond : facets_[together[i]].beyond) {
                if (done[beyond]) continue;
                const face& other = facets_[beyond].corner;
                const bool coplanar = std::all_of(other.begin(), other.end(), [&](auto p) {
                    return orient3d(points_[plane[0]], points_[plane[1]], points_[plane[2]],
                                    points_[p]) == 0;
                });
                if (!coplanar) continue;
                done[beyond] = true;
                together.push_back(beyond);
            }
        std::vector<face>& faces = result.emplace_back();
        for (const std::uint32_t at : together) faces.push_back(facets_[at].corner);
    }
    return result;
}

}  // namespace treeform::detail::place
