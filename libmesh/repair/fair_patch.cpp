#include <libmesh/base/point_math.hpp>
#include <libmesh/repair/fair_patch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace treeform::detail::repair {
namespace {

constexpr std::size_t fewest_rim_edges = 12;
constexpr int weightings = 3;  // by angles, which the one before has changed
constexpr double most_cotangent = 1000.0;
constexpr double cos_of_45 = 0.7071067811865476;
constexpr double cos_of_2 = 0.9993908270190958;

double extent(const point3& v) { return std::sqrt(base::dot(v, v)); }

point3 face_normal(const working_mesh& mesh, const face& f) {
    const auto [a, b, c] = base::triangle_of(mesh.points, f);
    return base::cross(base::minus(b, a), base::minus(c, a));
}

/// A row for each point of the filling: its Laplacian by cotangents, over the root of its share of
/// the area, as a sum over unknown points and a rest.
class laplacian {
  public:
    laplacian(const working_mesh& mesh, const open_rim& rim, const std::vector<face>& filling,
              std::size_t first, const base::stars& stars)
        : first_(first), count_(mesh.points.size() - first) {
        std::map<std::uint32_t, std::vector<face>> around;
        for (const face& f : filling)
            for (const std::uint32_t p : f) around[p].push_back(f);
        for (const std::uint32_t p : rim.points)
            for (const std::uint32_t f : stars[p]) around[p].push_back(mesh.faces[f]);
        for (const auto& [p, faces] : around) add_row(mesh, p, faces);
    }

    /// A x, without the rest.
    [[nodiscard]] std::vector<point3> times(const std::vector<point3>& x) const {
        std::vector<point3> y(rests_.size(), point3{0.0, 0.0, 0.0});
        for (std::size_t r = 0; r < y.size(); ++r)
            for (std::size_t i = begin_[r]; i < begin_[r + 1]; ++i)
                y[r] = base::plus(y[r], base::scaled(x[entries_[i].first], entries_[i].second));
        return y;
    }
    /// The transposed A y.
    [[nodiscard]] std::vector<point3> transposed_times(const std::vector<point3>& y) const {
        std::vector<point3> x(count_, point3{0.0, 0.0, 0.0});
        for (std::size_t r = 0; r < y.size(); ++r)
            for (std::size_t i = begin_[r]; i < begin_[r + 1]; ++i) {
                point3& sum = x[entries_[i].first];
                sum = base::plus(sum, base::scaled(y[r], entries_[i].second));
            }
        return x;
    }
    [[nodiscard]] const std::vector<point3>& rests() const { return rests_; }

  private:
    void add_row(const working_mesh& mesh, std::uint32_t p, const std::vector<face>& faces) {
        std::map<std::uint32_t, double> weights;
        double area = 0.0, sum = 0.0;
        for (const face& f : faces) {
            const double size = extent(face_normal(mesh, f));
            if (!(size > 0.0)) continue;
            area += size / 6.0;
            for (const std::uint32_t apex : f) {  // opposite the edge from p to the third corner
                const std::uint32_t q = third_corner(f, p, apex);
                if (apex == p) continue;
                const point3& at = mesh.points[apex];
                const double cotangent =
                    base::dot(base::minus(mesh.points[p], at), base::minus(mesh.points[q], at)) /
                    size;
                weights[q] += std::clamp(cotangent, -most_cotangent, most_cotangent) / 2.0;
            }
        }
        if (!(area > 0.0)) return;
        const double share = 1.0 / std::sqrt(area);
        point3 rest{0.0, 0.0, 0.0};
        const auto put = [&](std::uint32_t q, double weight) {
            if (q >= first_)
                entries_.emplace_back(q - first_, weight);
            else
                rest = base::plus(rest, base::scaled(mesh.points[q], weight));
        };
        for (const auto& [q, weight] : weights) {
            put(q, weight * share);
            sum += weight * share;
        }
        put(p, -sum);
        rests_.push_back(rest);
        begin_.push_back(entries_.size());
    }

    std::size_t first_, count_;
    std::vector<std::size_t> begin_{0};  ///< where the entries of each row begin
    std::vector<std::pair<std::size_t, double>> entries_{};
    std::vector<point3> rests_{};
};

double dot_of(const std::vector<point3>& a, const std::vector<point3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += base::dot(a[i], b[i]);
    return sum;
}

void add_scaled(std::vector<point3>& a, const std::vector<point3>& b, double by) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = base::plus(a[i], base::scaled(b[i], by));
}

/// x with the least |A x + rest|, by conjugate gradients from x on; all three coordinates at once.
std::vector<point3> least_squares(const laplacian& a, std::vector<point3> x) {
    constexpr int most_steps = 2000;
    constexpr double small = 1e-20;  // of squares
    std::vector<point3> residual = a.times(x);
    add_scaled(residual, a.rests(), 1.0);
    for (point3& p : residual) p = base::scaled(p, -1.0);
    std::vector<point3> gradient = a.transposed_times(residual), way = gradient;
    double square = dot_of(gradient, gradient);
    const double enough = small * square;
    for (int pass = 0; pass < most_steps && square > enough; ++pass) {
        const std::vector<point3> along = a.times(way);
        const double steepness = dot_of(along, along);
        if (!(steepness > 0.0)) break;
        const double step = square / steepness;
        add_scaled(x, way, step);
        add_scaled(residual, along, -step);
        gradient = a.transposed_times(residual);
        const double next = dot_of(gradient, gradient);
        for (point3& p : way) p = base::scaled(p, next / square);
        add_scaled(way, gradient, 1.0);
        square = next;
    }
    return x;
}

}  // namespace

bool is_to_be_fair(const working_mesh& mesh, const open_rim& rim,
                   const std::vector<face>& filling) {
    const std::size_t n = rim.points.size();
    if (n < fewest_rim_edges) return false;
    std::map<std::pair<std::uint32_t, std::uint32_t>, point3> normals;
    for (const face& f : filling)
        for (std::size_t i = 0; i < 3; ++i) normals[{f[i], f[(i + 1) % 3]}] = face_normal(mesh, f);
    double all = 0.0, smooth = 0.0, flat = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t from = rim.points[i], to = rim.points[(i + 1) % n];
        const point3 beside = face_normal(mesh, mesh.faces[rim.faces[i]]);
        const point3& within = normals.at({from, to});
        const double length = extent(base::minus(mesh.points[to], mesh.points[from]));
        const double cosine = base::dot(beside, within), most = extent(beside) * extent(within);
        all += length;
        if (cosine >= cos_of_45 * most) smooth += length;
        if (cosine >= cos_of_2 * most) flat += length;
    }
    return 2.0 * smooth >= all && 10.0 * flat < 9.0 * smooth;
}

void make_fair(working_mesh& mesh, const open_rim& rim, const std::vector<face>& filling,
               std::size_t first, const base::stars& stars) {
    if (first == mesh.points.size()) return;
    const auto begin = mesh.points.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<point3> given(begin, mesh.points.end());
    for (int pass = 0; pass < weightings; ++pass)
        std::ranges::copy(
            least_squares(laplacian(mesh, rim, filling, first, stars), {begin, mesh.points.end()}),
            begin);
    std::vector<point3> around;
    for (const std::uint32_t p : rim.points) around.push_back(mesh.points[p]);
    const box3 box = *bounding_box(around);
    const double most = box.diagonal();
    const bool is_near = std::all_of(begin, mesh.points.end(), [&](const point3& p) {
        for (std::size_t k = 0; k < 3; ++k)
            if (!(p[k] > box.min[k] - most && p[k] < box.max[k] + most)) return false;
        return true;
    });
    if (!is_near) std::ranges::copy(given, begin);
}

}  // namespace treeform::detail::repair
