#include <libmesh/base/certify.hpp>
#include <libmesh/base/check_faces.hpp>
#include <libmesh/base/work_progress.hpp>
#include <libmesh/simplify/collapsing.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/simplify.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace treeform {
namespace {

bool has_more(const solid_defects& after, const solid_defects& before) {
    return after.degenerate > before.degenerate || after.repeated > before.repeated ||
           after.boundary_edges > before.boundary_edges ||
           after.nonmanifold_edges > before.nonmanifold_edges ||
           after.misoriented_edges > before.misoriented_edges ||
           after.nonmanifold_vertices > before.nonmanifold_vertices ||
           after.meeting_pairs > before.meeting_pairs || after.inverted > before.inverted ||
           (after.wrongly_nested && !before.wrongly_nested);
}

}  // namespace

simplify_result simplify(const mesh_ref& mesh, double max_distance,
                         const simplify_options& options) {
    if (!(max_distance >= 0.0 && max_distance <= std::numeric_limits<double>::max()))
        throw std::invalid_argument("simplify: max_distance must be finite and not negative");
    const mesh_view view = mesh.view();
    detail::base::check_faces("simplify", view.points.size(), view.faces);
    detail::base::check_finite_faces("simplify", view);
    if (!options.face_groups.empty() && options.face_groups.size() != view.faces.size())
        throw std::invalid_argument("simplify: expected one entry of face_groups for each face");
    if (!options.corner_groups.empty() && options.corner_groups.size() != 3 * view.faces.size())
        throw std::invalid_argument(
            "simplify: expected three entries of corner_groups for each face");
    detail::base::work_progress progress(options.progress);
    simplify_options how = options;
    how.progress = progress.part(0.0, 0.9);
    simplify_result result = detail::simplify::collapse_edges(view, max_distance, how);
    result.certificate.precision = options.precision;
    const solid_defects before = find_solid_defects(view, progress.part(0.9, 0.95));
    const solid_defects after = find_solid_defects(result.mesh, progress.part(0.95, 1.0));
    if (progress.cancelled()) {
        result = {};
        result.certificate.status = status::cancelled;
        return result;
    }
    if (has_more(after, before)) {
        const auto met = self_intersections(result.mesh);
        detail::base::refuse_meeting(result.certificate, met.pairs, result.mesh);
    }
    return result;
}

}  // namespace treeform
