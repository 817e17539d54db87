#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/geometry/closest_point.hpp>
#include <libmesh/place/fit_features.hpp>
#include <libmesh/place/shape.hpp>
#include <treeform/mesh/properties.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace treeform {
namespace {

using detail::base::cross;
using detail::base::dot;
using detail::base::minus;
using detail::base::scaled;
using detail::place::distance_from;
using detail::place::double_area;

constexpr std::uint32_t none = 0xFFFFFFFF;
constexpr std::size_t fewest_faces_of_axis = 4, fewest_lines_of_axis = 5;

void check(mesh_view mesh, const feature_options& o) {
    const auto refuse = [](const std::string& what) {
        throw std::invalid_argument("treeform::find_features: " + what);
    };
    detail::base::check_faces("find_features", mesh.points.size(), mesh.faces);
    detail::place::check_finite("find_features", mesh.points);
    if (o.tolerance && !(*o.tolerance >= 0.0)) refuse("the tolerance is negative or NaN");
    for (const double angle : {o.plane_angle, o.facet_angle, o.arc})
        if (!(angle >= 0.0)) refuse("an angle is negative or NaN");
}

/// For each side of a face the one across the edge; none where it has not exactly one.
std::vector<std::array<std::uint32_t, 3>> faces_across(mesh_view mesh) {
    struct side {
        std::uint32_t low, high, face, k;
        bool operator<(const side& o) const {
            return std::tuple(low, high, face, k) < std::tuple(o.low, o.high, o.face, o.k);
        }
    };
    std::vector<side> sides;
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]);
            sides.push_back({low, high, f, k});
        }
    std::sort(sides.begin(), sides.end());
    std::vector<std::array<std::uint32_t, 3>> across(mesh.faces.size(), {none, none, none});
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end].low == sides[i].low &&
               sides[end].high == sides[i].high)
            ++end;
        if (end - i == 2) {
            across[sides[i].face][sides[i].k] = sides[i + 1].face;
            across[sides[i + 1].face][sides[i + 1].k] = sides[i].face;
        }
        i = end;
    }
    return across;
}

class region_finder {
  public:
    region_finder(mesh_view mesh, feature_kind kind, const feature_options& options)
        : mesh_(mesh), kind_(kind), options_(options), across_(faces_across(mesh)) {
        const auto box = bounding_box(mesh.points);
        tolerance_ = options.tolerance.value_or(box ? 1e-4 * box->diagonal() : 0.0);
        for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
            const point3 n = double_area(mesh, f);
            const double size = std::sqrt(dot(n, n));
            area_.push_back(0.5 * size);
            normal_.push_back(size > 0.0 ? scaled(n, 1.0 / size) : point3{});
        }
        taken_.resize(mesh.faces.size());
        mark_.resize(mesh.faces.size());
    }

    [[nodiscard]] std::vector<mesh_feature> all() {
        std::vector<std::uint32_t> seeds(mesh_.faces.size());
        std::iota(seeds.begin(), seeds.end(), 0U);
        std::stable_sort(seeds.begin(), seeds.end(),
                         [&](auto i, auto j) { return area_[i] > area_[j]; });
        std::vector<mesh_feature> found;
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            if (i % 1024 == 0 && options_.progress &&
                !options_.progress(static_cast<double>(i) / static_cast<double>(seeds.size())))
                return {};
            const std::uint32_t seed = seeds[i];
            if (taken_[seed]) continue;
            auto one = around(seed);
            if (!one) continue;
            for (const std::uint32_t f : one->faces) taken_[f] = true;
            found.push_back(std::move(*one));
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.area > b.area; });
        return found;
    }

    [[nodiscard]] std::optional<mesh_feature> around(std::uint32_t seed) {
        if (!(area_[seed] > 0.0)) return std::nullopt;
        if (kind_ == feature_kind::plane) return plane_around(seed);
        std::optional<mesh_feature> best;
        for (const std::uint32_t next : across_[seed])
            if (next != none && !taken_[next])
                if (auto one = axis_around(seed, next); one && (!best || one->area > best->area))
                    best = std::move(one);
        return best;
    }

  private:
    static double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

    /// What is connected with `seed` through faces that belong.
    template <class Belongs>
    [[nodiscard]] std::vector<std::uint32_t> grown(std::uint32_t seed, const Belongs& belongs) {
        ++round_;
        std::vector<std::uint32_t> region{seed};
        mark_[seed] = round_;
        for (std::size_t i = 0; i < region.size(); ++i)
            for (const std::uint32_t next : across_[region[i]]) {
                if (next == none || taken_[next] || mark_[next] == round_) continue;
                mark_[next] = round_;
                if (belongs(region[i], next)) region.push_back(next);
            }
        return region;
    }

    [[nodiscard]] bool near(const mesh_feature& feature, std::uint32_t f) const {
        return std::all_of(mesh_.faces[f].begin(), mesh_.faces[f].end(), [&](std::uint32_t i) {
            return std::abs(distance_from(feature, mesh_.points[i])) <= tolerance_;
        });
    }

    /// Whether none of its edges spans more of the circle than a facet may.
    [[nodiscard]] bool is_facet(const mesh_feature& axis, std::uint32_t f) const {
        const double deep = axis.radius * (1.0 - cosine(0.5 * options_.facet_angle)) + tolerance_;
        const auto t = detail::base::triangle_of(mesh_, f);
        for (std::size_t k = 0; k < 3; ++k) {
            const point3 middle = scaled(detail::base::plus(t[k], t[(k + 1) % 3]), 0.5);
            if (distance_from(axis, middle) < -deep) return false;
        }
        return true;
    }

    [[nodiscard]] std::optional<mesh_feature> plane_around(std::uint32_t seed) {
        const mesh_feature plane{.origin = mesh_.points[mesh_.faces[seed][0]],
                                 .direction = normal_[seed]};
        const double least = cosine(options_.plane_angle);
        const auto region = grown(seed, [&](std::uint32_t, std::uint32_t f) {
            return (!(area_[f] > 0.0) || dot(normal_[f], plane.direction) >= least) &&
                   near(plane, f);
        });
        return detail::place::fit_plane(mesh_, region);
    }

    /// The cylinder through the corners of two faces with a common edge along its axis.
    [[nodiscard]] std::optional<mesh_feature> cylinder_of(std::uint32_t a, std::uint32_t b) const {
        const point3 bend = cross(normal_[a], normal_[b]);
        const double sine = std::sqrt(dot(bend, bend));
        if (!(sine > 1e-3) || dot(normal_[a], normal_[b]) < cosine(options_.facet_angle))
            return std::nullopt;
        const point3 d = scaled(bend, 1.0 / sine);
        // Seen along d, a circle through the edge and the two corners beyond it.
        std::array<point3, 3> p;
        for (const std::uint32_t i : mesh_.faces[a])
            if (std::count(mesh_.faces[b].begin(), mesh_.faces[b].end(), i) == 0)
                p[0] = mesh_.points[i];
            else
                p[1] = mesh_.points[i];
        for (const std::uint32_t i : mesh_.faces[b])
            if (std::count(mesh_.faces[a].begin(), mesh_.faces[a].end(), i) == 0)
                p[2] = mesh_.points[i];
        const auto flat = [&](const point3& v) { return minus(v, scaled(d, dot(v, d))); };
        const point3 u = flat(minus(p[0], p[1])), v = flat(minus(p[2], p[1]));
        const point3 w = cross(u, v);
        const double square = dot(w, w);
        if (!(square > 0.0)) return std::nullopt;
        const point3 from =
            scaled(cross(minus(scaled(v, dot(u, u)), scaled(u, dot(v, v))), w), 0.5 / square);
        const point3 away{-from.x, -from.y, -from.z};
        mesh_feature c{.kind = feature_kind::axis, .direction = d};
        c.radius = std::sqrt(dot(from, from));
        // Of the two ends of that vector the one as far from all three.
        for (const point3& to : {from, away}) {
            c.origin = detail::base::plus(p[1], to);
            if (std::abs(distance_from(c, p[0])) <= tolerance_ + 1e-6 * c.radius &&
                std::abs(distance_from(c, p[2])) <= tolerance_ + 1e-6 * c.radius)
                return c;
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<mesh_feature> axis_around(std::uint32_t seed, std::uint32_t next) {
        std::optional<mesh_feature> axis = cylinder_of(seed, next);
        const double bent = cosine(options_.facet_angle), across = cosine(85.0);
        // A fit to more faces is better, and may hold more.
        std::size_t before = 0;
        for (int round = 0; axis && round < 20; ++round) {
            const auto region = grown(seed, [&](std::uint32_t from, std::uint32_t f) {
                return area_[f] > 0.0 && dot(normal_[from], normal_[f]) >= bent &&
                       std::abs(dot(normal_[f], axis->direction)) <= across && near(*axis, f) &&
                       is_facet(*axis, f);
            });
            if (region.size() < fewest_faces_of_axis) return std::nullopt;
            if (region.size() == before) break;
            before = region.size();
            axis = detail::place::fit_axis(mesh_, region, &*axis);
        }
        if (!axis || axis->deviation > 2.0 * tolerance_) return std::nullopt;
        // Any two flat faces with an edge are on some cylinder, and so are many threes.
        const auto arc = detail::place::arc_of(mesh_, *axis);
        if (arc.lines < fewest_lines_of_axis || arc.angle < options_.arc) return std::nullopt;
        return axis;
    }

    mesh_view mesh_;
    feature_kind kind_;
    feature_options options_;
    std::vector<std::array<std::uint32_t, 3>> across_;
    double tolerance_ = 0.0;
    std::vector<double> area_;
    std::vector<point3> normal_;
    std::vector<bool> taken_;
    std::vector<std::uint32_t> mark_;
    std::uint32_t round_ = 0;
};

void check_face(mesh_view mesh, std::uint32_t number) {
    if (number >= mesh.faces.size())
        throw std::invalid_argument("treeform::feature_at: there is no face " +
                                    std::to_string(number));
}

}  // namespace

std::vector<mesh_feature> find_features(mesh_view mesh, feature_kind kind,
                                        const feature_options& options) {
    check(mesh, options);
    return region_finder(mesh, kind, options).all();
}

std::optional<mesh_feature> feature_at(mesh_view mesh, feature_kind kind, std::uint32_t number,
                                       const feature_options& options) {
    check(mesh, options);
    check_face(mesh, number);
    return region_finder(mesh, kind, options).around(number);
}

std::optional<mesh_feature> fit_feature(mesh_view mesh, feature_kind kind,
                                        std::span<const std::uint32_t> faces) {
    check(mesh, {});
    for (const std::uint32_t f : faces) check_face(mesh, f);
    return kind == feature_kind::plane ? detail::place::fit_plane(mesh, faces)
                                       : detail::place::fit_axis(mesh, faces);
}

}  // namespace treeform
