#include "fit_pairs.hpp"

#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>
#include <support/scans.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

namespace test {
namespace {

using tf::point3;

constexpr std::size_t most_points = 20'000;  ///< of a side, before it is thinned

constexpr std::array<const char*, 11> meshes{"clean/decimated_knight_1k.off",
                                             "clean/fertility_9k.off",
                                             "clean/fish_2k.obj",
                                             "clean/spot_23k.obj",
                                             "clean/armadillo_29k.obj",
                                             "clean/fandisk_14k.off",
                                             "clean/koala_100k.obj",
                                             "clean/turbineblade_199k.ply",
                                             "open/bunny_69k.obj",
                                             "open/camelhead_23k.off",
                                             "open/mountain_51k.obj"};
constexpr std::array<const char*, 4> clouds_of_models{
    "cloud/room_scan1_113k.ply", "cloud/car_cloud400_25k.xyz", "cloud/kinect_nan_307k.ply",
    "cloud/terrain_samp11_38k.ply"};
constexpr std::array<const char*, 4> clouds_of_las{"las/warsaw_small.las", "las/4_6_crop.las",
                                                   "copc/lone-star.copc.laz", "apps/simple.las"};

/// Different finite points: half of those of a scanner may be others again.
std::vector<point3> points_of(const std::filesystem::path& path) {
    std::vector<point3> points;
    for (const point3& p : tf::read(path).mesh.points)
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) points.push_back(p);
    const auto less = [](const point3& a, const point3& b) {
        return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    };
    std::sort(points.begin(), points.end(), less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

/// Leaves out more and more along some direction, up to nine in ten.
void thin_unevenly(random& source, std::vector<point3>& points) {
    const point3 d = direction(source);
    const double low = quantile_along(points, d, 0.0), high = quantile_along(points, d, 1.0);
    std::erase_if(points, [&](const point3& p) {
        const double at = (p.x * d.x + p.y * d.y + p.z * d.z - low) / (high - low);
        return source.unit() < 0.9 * at;
    });
}

/// Leaves out what is beyond `share` of the points in some direction.
void crop(random& source, double share, std::vector<point3>& points) {
    const point3 d = direction(source);
    const double end = quantile_along(points, d, share);
    std::erase_if(points, [&](const point3& p) { return p.x * d.x + p.y * d.y + p.z * d.z > end; });
}

void crop(random& source, double share, tf::mesh& mesh) {
    const point3 d = direction(source);
    const double end = quantile_along(mesh.points, d, share);
    std::erase_if(mesh.faces, [&](const tf::face& f) {
        const point3& p = mesh.points[f[0]];
        return p.x * d.x + p.y * d.y + p.z * d.z > end;
    });
}

void add_noise(random& source, double deviation, std::vector<point3>& points) {
    for (point3& p : points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += deviation * gaussian(source);
}

point3 middle_of(const tf::box3& box) {
    return {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y),
            0.5 * (box.min.z + box.max.z)};
}

/// Moves `pair.moving`, which is where it belongs after `home`, away.
void move_away(random& source, double degrees, double shift, const tf::transform<3>& home,
               fit_pair& pair) {
    const point3 center = middle_of(tf::bounding_box(pair.moving).value());
    const point3 axis = direction(source), d = direction(source);
    const double turn = degrees * std::numbers::pi / 180.0;
    const point3 way{shift * d.x, shift * d.y, shift * d.z};
    const auto away = turn_about(axis, turn, center, way);
    for (point3& p : pair.moving) p = away(p);
    const point3 there{center.x + way.x, center.y + way.y, center.z + way.z};
    pair.truth = home.after(turn_about(axis, -turn, there, {-way.x, -way.y, -way.z}));
}

fit_pair pair_of(const std::string& name, const std::vector<point3>& points, const tf::mesh* solid,
                 std::uint64_t seed, std::size_t variant) {
    random source(1000 * seed + variant);
    const double size = tf::bounding_box(points).value().diagonal();
    constexpr std::array<double, 3> noises{0.0, 5e-4, 2e-3};
    const double noise = noises[variant / 3 % noises.size()];
    fit_pair pair;
    pair.name = name + " " + std::to_string(variant);
    auto all = points;
    source.shuffle(all);
    all.resize(std::min(all.size(), 2 * most_points));
    const auto half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    pair.moving.assign(all.begin(), half);
    const bool to_mesh = solid != nullptr && variant % 2 == 0;
    if (to_mesh)
        pair.fixed = *solid;
    else
        pair.fixed.points.assign(half, all.end());
    thin_unevenly(source, pair.moving);
    if (!to_mesh) thin_unevenly(source, pair.fixed.points);
    if (variant % 3 > 0) crop(source, 0.85, pair.moving);
    if (variant % 3 > 1)
        to_mesh ? crop(source, 0.85, pair.fixed) : crop(source, 0.85, pair.fixed.points);
    add_noise(source, noise * size, pair.moving);
    if (!to_mesh) add_noise(source, noise * size, pair.fixed.points);
    move_away(source, 10.0, 0.1 * size, {}, pair);
    const double dense = static_cast<double>(to_mesh ? 2 * most_points : pair.fixed.points.size());
    pair.right = size * (std::max(0.005, 0.25 / std::sqrt(dense)) + noise);
    return pair;
}

/// Of a rigid motion.
tf::transform<3> inverse_of(const tf::transform<3>& m) {
    tf::transform<3> inverse;
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) inverse.rows[r][c] = m.rows[c][r];
        inverse.rows[r][3] = 0.0;
        for (std::size_t c = 0; c < 3; ++c) inverse.rows[r][3] -= m.rows[c][r] * m.rows[c][3];
    }
    return inverse;
}

/// Two sweeps of a lidar scanner that moved between them; the truth is published with them.
fit_pair sweeps(const std::vector<point3>& moving, const std::vector<point3>& fixed,
                std::size_t variant) {
    random source(variant);
    fit_pair pair{.name = "lidar sweeps " + std::to_string(variant), .moving = moving};
    pair.fixed.points = fixed;
    pair.truth.rows = {{{0.999925, 0.0121483, -0.00177009, 0.488882},
                        {-0.0121523, 0.999924, -0.00228657, 0.121214},
                        {0.00174218, 0.00230791, 0.999996, -0.0253342}}};
    const auto published = pair.truth;
    if (variant > 0)
        move_away(source, static_cast<double>(variant), 0.3 * static_cast<double>(variant),
                  published, pair);
    pair.scanner = inverse_of(pair.truth).after(published)(point3{0, 0, 0});
    pair.right = 0.05;
    pair.turn = 0.3 * std::numbers::pi / 180.0;
    return pair;
}

}  // namespace

double fit_pair::error_of(const tf::transform<3>& found) const {
    const auto off = [&](const point3& p) {
        const point3 a = found(p), b = truth(p);
        return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
    };
    if (std::isfinite(turn)) {
        double trace = 0.0;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < 3; ++c) trace += found.rows[r][c] * truth.rows[r][c];
        const double angle = std::acos(std::clamp(0.5 * (trace - 1.0), -1.0, 1.0));
        return std::max(off(scanner) / right, angle / turn);
    }
    double sum = 0.0;
    for (const point3& p : moving) sum += off(p) * off(p);
    return std::sqrt(sum / static_cast<double>(moving.size())) / right;
}

void for_fit_pairs(const std::filesystem::path& models, const std::filesystem::path& clouds,
                   std::size_t variants, const std::function<void(const fit_pair&)>& body) {
    variants = std::min(variants, variants_of_pair);
    std::uint64_t seed = 0;
    for (const char* file : meshes) {
        const tf::mesh solid = tf::as_mesh(tf::read(models / file)).mesh;
        random source(++seed);
        const auto points = spread_over(source, solid, 2 * most_points);
        for (std::size_t v = 0; v < variants; ++v) body(pair_of(file, points, &solid, seed, v));
    }
    const auto of_cloud = [&](const std::filesystem::path& folder, const char* file) {
        const auto points = points_of(folder / file);
        ++seed;
        for (std::size_t v = 0; v < variants; ++v) body(pair_of(file, points, nullptr, seed, v));
    };
    for (const char* file : clouds_of_models) of_cloud(models, file);
    for (const char* file : clouds_of_las) of_cloud(clouds, file);
    const auto moving = points_of(models / "cloud/lidar_source_70k.ply");
    const auto fixed = points_of(models / "cloud/lidar_target_69k.ply");
    for (std::size_t v = 0; v < variants; ++v) body(sweeps(moving, fixed, v));
}

void write_pair(const std::filesystem::path& folder, std::size_t number, const fit_pair& pair) {
    const std::string start = (folder / std::to_string(number)).string();
    tf::write(start + "_moving.ply", tf::mesh{pair.moving, {}});
    tf::write(start + "_fixed.ply", pair.fixed);
    std::ofstream out(start + ".txt");
    out.precision(17);
    out << pair.name << '\n'
        << pair.right << ' ' << pair.turn << '\n'
        << pair.scanner.x << ' ' << pair.scanner.y << ' ' << pair.scanner.z << '\n';
    for (const auto& row : pair.truth.rows)
        out << row[0] << ' ' << row[1] << ' ' << row[2] << ' ' << row[3] << '\n';
}

}  // namespace test
