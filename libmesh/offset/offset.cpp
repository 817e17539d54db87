#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/prepared_slots.hpp>
#include <libmesh/base/words.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/offset/cell_grid.hpp>
#include <libmesh/offset/distance_bounds.hpp>
#include <libmesh/offset/drains.hpp>
#include <libmesh/offset/level_surface.hpp>
#include <libmesh/offset/moved_surface.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/properties.hpp>
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

constexpr double most_share = 0.5;      ///< of the distance: the resolution
constexpr double usual_share = 0.25;    ///< of the distance: where no resolution is given,
constexpr double usual_extent = 64.0;   ///< and so many cells along the diagonal of the result,
constexpr double usual_cells = 0x1p16;  ///< unless more than these would be on the surface
constexpr double cells_per_square = 3.0;
constexpr double least_steps = 0x1p14;  ///< of coordinates, in a resolution
constexpr double slack_share = 0x1p-4;  ///< of the resolution: slack of the bounds

/// What was called, and how.
struct request {
    const char* verb;
    const offset_options& options;
    work_progress& progress;

    [[noreturn]] void refuse(const std::string& what) const {
        throw std::invalid_argument("treeform::" + std::string(verb) + ": " + what);
    }
    void require_positive(double value, const char* what) const {
        if (!(value > 0.0) || !std::isfinite(value))
            refuse(std::string(what) + " is not positive and finite");
    }
};

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
mesh used_part(const char* verb, mesh_view given) {
    detail::base::check_faces(verb, given.points.size(), given.faces);
    detail::base::check_finite_faces(verb, given);
    detail::base::refuse_cloud(verb, given);
    std::vector<std::uint32_t> all(given.faces.size());
    for (std::uint32_t f = 0; f < all.size(); ++f) all[f] = f;
    return submesh(given, all).mesh;
}

/// As fine as is usual, but no finer than for so many cells as are usual.
double usual_resolution(mesh_view mesh, double diagonal, double distance, double least,
                        wanted_side side) {
    const bool grows = side != wanted_side::inside;
    const double extent = diagonal + (grows ? 2.0 * distance : 0.0);
    const double area = surface_area(mesh) * (side == wanted_side::any ? 2.0 : 1.0) +
                        (grows ? 4.0 * std::numbers::pi * distance * distance : 0.0);
    const double fine = std::min(usual_share * distance, extent / usual_extent);
    return std::min(most_share * distance,
                    std::max({least, fine, std::sqrt(cells_per_square * area / usual_cells)}));
}

double resolution_for(mesh_view mesh, double distance, wanted_side side, const request& asked) {
    const box3 box = *bounding_box(mesh.points);
    const double size = box.diagonal();
    if (!(size + distance < 0x1p150)) asked.refuse("lengths of 2^150 or more are not supported");
    std::array<point3, 2> ends{box.min, box.max};
    for (std::size_t k = 0; k < 3; ++k) {
        ends[0][k] -= distance;
        ends[1][k] += distance;
    }
    const double least = least_steps * coordinate_step(ends, asked.options.precision);
    const double step = asked.options.resolution
                            ? *asked.options.resolution
                            : usual_resolution(mesh, size, distance, least, side);
    asked.require_positive(step, "the resolution");
    if (step > most_share * distance)
        asked.refuse("the resolution " + detail::base::brief(step) +
                     " is too coarse: it can be at most half of the distance, " +
                     detail::base::brief(most_share * distance));
    if (step < least)
        asked.refuse("the resolution " + detail::base::brief(step) +
                     " is too fine for the coordinates there: it must be at least " +
                     detail::base::brief(least) + "; move the mesh to the origin, or use float64");
    return step;
}

void certify(offset_result& result, progress_callback progress) {
    const solid_defects found = find_solid_defects(result.mesh, std::move(progress));
    certificate& known = result.certificate;
    known.meeting_count = found.meeting_pairs;
    known.boundary_edges = found.boundary_edges;
    known.misoriented_edges = found.misoriented_edges;
    if (found.any()) known.status = status::not_certified;
    if (found.status == status::cancelled) known.status = status::cancelled;
}

/// What is at the distance on the side. `outward`: what is nearer is behind it.
offset_result surface_at(mesh_view given, double distance, wanted_side side, bool outward,
                         const request& asked) {
    const offset_options& options = asked.options;
    work_progress& progress = asked.progress;
    const double step = resolution_for(given, distance, side, asked);
    const prepared_mesh around = detail::base::prepared_slots::of_faces(given);
    offset_result result;
    result.certificate.precision = options.precision;
    result.distance = distance;
    result.resolution = step;
    const auto grid = detail::offset::cells_at(asked.verb, around, distance, side, step, progress);
    if (progress.cancelled()) return ended(status::cancelled, options);
    result.cells = grid.cells.size();
    result.mesh =
        detail::offset::level_surface(around, grid, distance, outward, progress.part(0.3, 0.6));
    if (progress.cancelled()) return ended(status::cancelled, options);
    if (options.precision == precision::float32)
        for (point3& p : result.mesh.points)
            for (std::size_t k = 0; k < 3; ++k) p[k] = detail::base::nearest_float(p[k]);
    if (result.mesh.faces.empty()) {
        result.certificate.status = status::vanished;
        return result;
    }
    const auto [least, greatest] = detail::offset::bounds_of_distance(
        result.mesh, around, slack_share * step, progress.part(0.6, 0.7));
    result.least_distance = least;
    result.greatest_distance = greatest;
    if (!progress.cancelled()) certify(result, progress.part(0.7, 0.9));
    if (progress.cancelled() || result.certificate.status == status::cancelled)
        return ended(status::cancelled, options);
    return result;
}

/// The solid that a mesh winds around, once.
boolean_result solid_of(const mesh_ref& given, const request& asked) {
    boolean_result made =
        boolean(given, "a",
                {.precision = asked.options.precision, .progress = asked.progress.part(0, 0.2)});
    detail::base::name_no_operand(made.certificate);
    return made;
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
    work_progress progress(options.progress);
    const request asked{"offset", options, progress};
    asked.require_positive(std::abs(distance), "the distance");
    const boolean_result solid = solid_of(given, asked);
    if (!solid.certificate) return with_certificate(solid.certificate);
    if (solid.mesh.faces.empty()) return ended(status::vanished, options);
    const bool outward = distance > 0.0;
    return surface_at(solid.mesh, std::abs(distance),
                      outward ? wanted_side::outside : wanted_side::inside, outward, asked);
}

offset_result hollow(const mesh_ref& given, double wall, const offset_options& options) {
    const auto& drains = options.drains;
    work_progress progress(options.progress);
    const request asked{"hollow", options, progress};
    asked.require_positive(wall, "the wall");
    for (const auto& [at, diameter] : drains) {
        asked.require_positive(diameter, "the diameter of a drain");
        if (!detail::base::is_finite(at)) asked.refuse("the position of a drain is not finite");
    }
    boolean_result solid = solid_of(given, asked);
    if (!solid.certificate) return with_certificate(solid.certificate);
    if (solid.mesh.faces.empty()) return ended(status::vanished, options);
    offset_result result = surface_at(solid.mesh, wall, wanted_side::inside, false, asked);
    if (!result.certificate) return result;
    const prepared_mesh outer(std::move(solid.mesh));
    std::vector<mesh> gone;
    gone.push_back(std::move(result.mesh));
    const prepared_mesh cavities = prepared_mesh::borrow(gone[0]);
    std::vector<mesh> prisms;
    for (std::uint32_t i = 0; i < drains.size(); ++i) {
        detail::offset::drilled made =
            detail::offset::drill(drains[i].first, drains[i].second, outer, cavities);
        if (!made.leads) result.blind_drains.push_back(i);
        prisms.push_back(std::move(made.prism));
    }
    for (mesh& prism : prisms) gone.push_back(std::move(prism));
    boolean_result made =
        difference(outer, concatenate(gone),
                   {.precision = options.precision, .progress = progress.part(0.9, 1.0)});
    result.mesh = std::move(made.mesh);
    result.certificate = std::move(made.certificate);
    if (!result.certificate) return result;
    // Shells that are no part of their own are around cavities.
    result.sealed_cavities =
        count_topology(result.mesh.points.size(), result.mesh.faces).components_by_point -
        components(result.mesh).size();
    return result;
}

offset_result thicken(const mesh_ref& given, double thickness, const offset_options& options) {
    work_progress progress(options.progress);
    const request asked{"thicken", options, progress};
    asked.require_positive(thickness, "the thickness");
    mesh surface = used_part(asked.verb, given.view());
    if (surface.faces.empty()) asked.refuse("the mesh has no faces");
    if (!std::isfinite(options.shift)) asked.refuse("the shift is not finite");
    if (options.shift != 0.0) surface = detail::offset::moved_to_front(surface, options.shift);
    return surface_at(surface, 0.5 * thickness, wanted_side::any, true, asked);
}

}  // namespace treeform
