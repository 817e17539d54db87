#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/words.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/offset/cell_grid.hpp>
#include <libmesh/offset/distance_bounds.hpp>
#include <libmesh/offset/level_surface.hpp>
#include <libmesh/offset/moved_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/distance.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using detail::base::work_progress;
using detail::offset::wanted_side;

constexpr double usual_cells = 128.0;   ///< along the diagonal
constexpr double most_share = 0.5;      ///< of the distance: the resolution
constexpr double least_steps = 0x1p14;  ///< of coordinates, in a resolution
constexpr double slack_share = 0x1p-4;  ///< of the resolution: slack of the bounds
constexpr std::uint32_t drain_sides = 32;

[[noreturn]] void refuse(const std::string& what) {
    throw std::invalid_argument("treeform::offset: " + what);
}

void require_positive(double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value))
        refuse(std::string(what) + " is not positive and finite");
}

offset_result with_certificate(certificate how) {
    offset_result result;
    result.certificate = std::move(how);
    return result;
}

offset_result ended(status how, const offset_options& options) {
    certificate made;
    made.status = how;
    made.precision = options.precision;
    return with_certificate(std::move(made));
}

/// Only the points that faces use.
mesh used_part(mesh_view given) {
    detail::base::check_faces("offset", given.points.size(), given.faces);
    detail::base::check_finite_faces("offset", given);
    std::vector<std::uint32_t> all(given.faces.size());
    for (std::uint32_t f = 0; f < all.size(); ++f) all[f] = f;
    return submesh(given, all).mesh;
}

double resolution_for(mesh_view mesh, double distance, const offset_options& options) {
    const box3 box = *bounding_box(mesh.points);
    const double size = box.diagonal();
    if (!(size + distance < 0x1p150)) refuse("lengths of 2^150 and more are not taken");
    const double step =
        options.resolution.value_or(std::min(most_share * distance, size / usual_cells));
    require_positive(step, "the resolution");
    if (step > most_share * distance)
        refuse("the resolution " + detail::base::brief(step) +
               " is too coarse: half of the distance, " +
               detail::base::brief(most_share * distance) + ", is the most");
    std::array<point3, 2> ends{box.min, box.max};
    for (std::size_t k = 0; k < 3; ++k) {
        ends[0][k] -= distance;
        ends[1][k] += distance;
    }
    const double least = least_steps * coordinate_step(ends, options.precision);
    if (step < least)
        refuse("the resolution " + detail::base::brief(step) +
               " is finer than coordinates allow there: " + detail::base::brief(least) +
               " is the least; move the mesh to the origin, or take float64");
    return step;
}

void certify(offset_result& result, progress_callback progress) {
    const solid_defects found = find_solid_defects(result.mesh, std::move(progress));
    certificate& known = result.certificate;
    known.meeting_count = found.meeting_pairs;
    known.boundary_edges = found.open_edges;
    known.misoriented_edges = found.misoriented_edges;
    if (found.any()) known.status = status::not_certified;
    if (found.status == status::cancelled) known.status = status::cancelled;
}

/// What is at the distance on the side. `outward`: what is nearer is behind it.
offset_result surface_at(mesh_view given, double distance, wanted_side side, bool outward,
                         const offset_options& options, work_progress& progress) {
    const double step = resolution_for(given, distance, options);
    const prepared_mesh around = prepared_mesh::borrow(given);
    offset_result result;
    result.certificate.precision = options.precision;
    result.statistics.distance = distance;
    result.statistics.resolution = step;
    const auto grid = detail::offset::cells_at(around, distance, side, step, progress);
    if (progress.cancelled()) return ended(status::cancelled, options);
    result.statistics.cells = grid.cells.size();
    result.mesh = detail::offset::level_surface(around, grid, distance, outward);
    if (options.precision == precision::float32)
        for (point3& p : result.mesh.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
    if (result.mesh.faces.empty()) {
        result.certificate.status = status::vanished;
        return result;
    }
    if (!progress.reach(0.6)) return ended(status::cancelled, options);
    const auto [least, greatest] =
        detail::offset::bounds_of_distance(result.mesh, around, slack_share * step);
    result.statistics.least = least;
    result.statistics.greatest = greatest;
    certify(result, progress.part(0.7, 0.9));
    if (result.certificate.status == status::cancelled) return ended(status::cancelled, options);
    return result;
}

/// The solid that a mesh winds around, once.
boolean_result solid_of(const mesh_ref& given, const offset_options& options,
                        work_progress& progress) {
    return boolean(given, "a", {.precision = options.precision, .progress = progress.part(0, 0.2)});
}

/// Along the shortest way from the surface, at `drain.at`, to the cavities, and as far beyond both as
/// the hole is wide.
mesh drill(const drain& hole, const prepared_mesh& solid, const prepared_mesh& cavities) {
    using namespace detail::base;
    const point3 from = closest_point(solid, hole.at)->point;
    const point3 to = closest_point(cavities, from)->point;
    const point3 way = minus(to, from);
    const double length = std::sqrt(dot(way, way));
    const point3 along = scaled(way, 1.0 / length);
    const double beyond = hole.diameter;
    point3 least{};
    const std::array<double, 3> size{std::abs(along.x), std::abs(along.y), std::abs(along.z)};
    least[static_cast<std::size_t>(std::min_element(size.begin(), size.end()) - size.begin())] = 1;
    point3 u = cross(along, least);
    u = scaled(u, 1.0 / std::sqrt(dot(u, u)));
    const point3 v = cross(along, u);
    mesh prism;
    for (const double at : {-beyond, length + beyond})
        for (std::uint32_t i = 0; i < drain_sides; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / drain_sides;
            prism.points.push_back(
                plus(plus(from, scaled(along, at)),
                     scaled(plus(scaled(u, std::cos(turn)), scaled(v, std::sin(turn))),
                            0.5 * hole.diameter)));
        }
    constexpr std::uint32_t n = drain_sides;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t next = (i + 1) % n;
        prism.faces.push_back({i, next, next + n});
        prism.faces.push_back({i, next + n, i + n});
        if (i == 0 || next == 0) continue;
        prism.faces.push_back({0, next, i});
        prism.faces.push_back({n, i + n, next + n});
    }
    return prism;
}

}  // namespace

const mesh& offset_result::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh offset_result::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

offset_result offset(const mesh_ref& given, double distance, const offset_options& options) {
    require_positive(std::abs(distance), "the distance");
    work_progress progress(options.progress);
    const boolean_result solid = solid_of(given, options, progress);
    if (!solid.certificate) return with_certificate(solid.certificate);
    if (solid.mesh.faces.empty()) return ended(status::vanished, options);
    const bool outward = distance > 0.0;
    return surface_at(solid.mesh, std::abs(distance),
                      outward ? wanted_side::outside : wanted_side::inside, outward, options,
                      progress);
}

offset_result hollow(const mesh_ref& given, double wall, std::span<const drain> drains,
                     const offset_options& options) {
    require_positive(wall, "the wall");
    for (const drain& hole : drains) {
        require_positive(hole.diameter, "the diameter of a drain");
        if (!detail::base::is_finite(hole.at)) refuse("the place of a drain is not finite");
    }
    work_progress progress(options.progress);
    boolean_result solid = solid_of(given, options, progress);
    if (!solid.certificate) return with_certificate(solid.certificate);
    if (solid.mesh.faces.empty()) return ended(status::vanished, options);
    offset_result result =
        surface_at(solid.mesh, wall, wanted_side::inside, false, options, progress);
    if (!result.certificate) return result;
    const prepared_mesh outer(std::move(solid.mesh));
    const prepared_mesh cavities(std::move(result.mesh));
    std::vector<mesh> gone;
    gone.push_back({{cavities.view().points.begin(), cavities.view().points.end()},
                    {cavities.view().faces.begin(), cavities.view().faces.end()}});
    for (const drain& hole : drains) gone.push_back(drill(hole, outer, cavities));
    boolean_result made =
        subtract(outer, concatenate(gone),
                 {.precision = options.precision, .progress = progress.part(0.9, 1.0)});
    result.mesh = std::move(made.mesh);
    result.certificate = std::move(made.certificate);
    return result;
}

offset_result thicken(const mesh_ref& given, double thickness, thick_side side,
                      const offset_options& options) {
    require_positive(thickness, "the thickness");
    mesh surface = used_part(given.view());
    if (surface.faces.empty()) refuse("the mesh has no faces");
    const double half = 0.5 * thickness;
    if (side != thick_side::both)
        surface = detail::offset::moved_to_front(surface, side == thick_side::front ? half : -half);
    work_progress progress(options.progress);
    return surface_at(surface, half, wanted_side::any, true, options, progress);
}

}  // namespace treeform
