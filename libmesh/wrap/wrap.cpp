#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/nearest_float.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/base/words.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/topology/area.hpp>
#include <libmesh/wrap/carving.hpp>
#include <libmesh/wrap/offset_surface.hpp>
#include <libmesh/wrap/pinched_vertices.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/offset.hpp>
#include <treeform/mesh/repair.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace treeform {
namespace {

using detail::wrap::carved_space;
using detail::wrap::tetrahedralization;

constexpr double usual_share = 1.0 / 30.0;  ///< of the size: the offset

[[noreturn]] void refuse(const std::string& what) {
    throw std::invalid_argument("treeform::wrap: " + what);
}

void require_length(double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value))
        refuse(std::string(what) + " is not positive and finite");
}

box3 box_of(mesh_view mesh) {
    box3 box{mesh.points[mesh.faces[0][0]], mesh.points[mesh.faces[0][0]]};
    for (const face& f : mesh.faces)
        for (const std::uint32_t corner : f)
            for (std::size_t k = 0; k < 3; ++k) {
                box.min[k] = std::min(box.min[k], mesh.points[corner][k]);
                box.max[k] = std::max(box.max[k], mesh.points[corner][k]);
            }
    return box;
}

/// So far beyond the mesh that a ball passes through every face there.
box3 box_around(const box3& mesh, double size, double offset, precision of) {
    const double margin = 4.0 * (size + offset) + 0.25 * mesh.diagonal();
    box3 box = mesh;
    for (std::size_t k = 0; k < 3; ++k) {
        box.min[k] -= margin;
        box.max[k] += margin;
        if (of == precision::float32) {
            box.min[k] = detail::base::nearest_float(box.min[k]);
            box.max[k] = detail::base::nearest_float(box.max[k]);
        }
    }
    return box;
}

void check_sizes(const box3& mesh, const box3& around, double offset, precision of) {
    // Volumes times squared lengths are computed.
    constexpr double largest = 0x1p150;
    const double extent = around.diagonal();
    if (!(extent < largest) || !(offset > 1.0 / largest))
        refuse("lengths of 2^150 or more, or 2^-150 or less, are not supported");
    // Corners have to be apart, and where they are meant to be, when they are rounded.
    constexpr double least_steps = 16.0;
    const std::array<point3, 2> ends{mesh.min, mesh.max};
    const double step = coordinate_step(ends, of);
    if (offset < least_steps * step)
        refuse("the offset " + detail::base::brief(offset) + " is too small: coordinates are " +
               detail::base::brief(step) +
               " apart there; use a larger offset, or move the mesh to the origin");
}

/// The faces between inside and outside.
mesh boundary_of(const carved_space& space) {
    const tetrahedralization& cells = space.cells;
    const auto is_outside = [&](std::uint32_t t) {
        return t == tetrahedralization::none || space.is_outside[t] != 0;
    };
    mesh result;
    std::vector<std::uint32_t> number(cells.points().size(), tetrahedralization::none);
    for (std::uint32_t t = 0; t < cells.size(); ++t) {
        if (!cells.is_used(t) || is_outside(t)) continue;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!is_outside(cells[t].neighbors[i])) continue;
            const auto [a, b, c] = cells.face(t, i);  // as seen from inside
            for (const std::uint32_t v : {a, c, b})
                if (number[v] == tetrahedralization::none) {
                    number[v] = static_cast<std::uint32_t>(result.points.size());
                    result.points.push_back(cells.points()[v]);
                }
            result.faces.push_back({number[a], number[c], number[b]});
        }
    }
    return result;
}

certificate checked(mesh_view made, precision of, detail::base::work_progress& progress) {
    certificate known;
    known.precision = of;
    const solid_defects found = find_solid_defects(made, progress.part(0.95, 1.0));
    known.meeting_count = found.meeting_pairs;
    known.boundary_edges = found.boundary_edges;
    known.misoriented_edges = found.misoriented_edges;
    if (found.any()) known.status = status::not_certified;
    if (found.status == treeform::status::cancelled) known.status = status::cancelled;
    return known;
}

}  // namespace

offset_result wrap(const mesh_ref& given, double size, const offset_options& options) {
    const mesh_view mesh = given.view();
    require_length(size, "the size");
    const double offset = options.offset.value_or(usual_share * size);
    require_length(offset, "the offset");
    detail::base::check_faces("wrap", mesh.points.size(), mesh.faces);
    detail::base::check_finite_faces("wrap", mesh);
    if (mesh.faces.empty()) refuse("the mesh has no faces");
    const box3 box = box_of(mesh);
    const box3 around = box_around(box, size, offset, options.precision);
    check_sizes(box, around, offset, options.precision);

    offset_result result;
    result.resolution = size;
    result.distance = offset;
    const auto cancelled = [&result]() -> offset_result& {
        result.mesh = {};
        result.certificate.status = status::cancelled;
        return result;
    };
    detail::base::work_progress progress(options.progress);
    constexpr double most_faces = 0x1p30;
    if (detail::topology::area(mesh) > most_faces * size * size)
        refuse("the size " + detail::base::brief(size) +
               " is too small: the wrap would have more "
               "than 10^9 faces");
    const detail::wrap::offset_surface surface(mesh, offset);
    std::optional<carved_space> space = detail::wrap::carve(
        surface, around, {size, offset, options.precision},
        [&](std::size_t done, std::size_t waiting) {
            const auto looked_at = static_cast<double>(done);
            return !progress.reach(0.9 * looked_at /
                                   (looked_at + 8.0 * static_cast<double>(waiting) + 1000.0));
        });
    if (!space) return std::move(cancelled());
    result.filled_tetrahedra = detail::wrap::fill_pinched_vertices(*space);
    result.tetrahedra_points = space->cells.points().size();
    result.tetrahedra = space->cells.count();
    result.mesh = boundary_of(*space);
    space.reset();
    result.certificate = checked(result.mesh, options.precision, progress);
    if (result.certificate.status == status::cancelled) return std::move(cancelled());
    return result;
}

}  // namespace treeform
