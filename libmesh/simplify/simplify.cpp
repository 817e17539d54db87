#include <libmesh/base/check_faces.hpp>
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
           after.open_edges > before.open_edges ||
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
        throw std::invalid_argument("simplify: max_distance has to be finite and not negative");
    const mesh_view view = mesh.view();
    detail::base::check_faces("simplify", view.points.size(), view.faces);
    detail::base::check_finite_faces("simplify", view);
    if (!options.face_groups.empty() && options.face_groups.size() != view.faces.size())
        throw std::invalid_argument("simplify: face_groups needs one for each face");
    simplify_result result = detail::simplify::collapse_edges(view, max_distance, options);
    result.certificate.precision = options.precision;
    if (result.certificate.status == status::cancelled) return result;
    const solid_defects before = find_solid_defects(view), after = find_solid_defects(result.mesh);
    if (has_more(after, before)) {
        certificate& known = result.certificate;
        known.status = status::not_certified;
        const auto met = self_intersections(result.mesh);
        known.meeting_count = met.pairs.size();
        for (std::size_t i = 0; i < std::min<std::size_t>(met.pairs.size(), 100); ++i) {
            known.meeting.push_back({met.pairs[i].a, met.pairs[i].b});
            known.meeting_at.push_back(result.mesh.points[result.mesh.faces[met.pairs[i].a][0]]);
        }
    }
    return result;
}

}  // namespace treeform
