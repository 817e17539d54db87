#include <libmesh/base/max_displacement.hpp>
#include <libmesh/base/prepared_ref.hpp>
#include <treeform/mesh/certificate.hpp>
#include <treeform/mesh/mesh.hpp>

#include <algorithm>
#include <stdexcept>

namespace treeform {

rounding_effects& rounding_effects::operator+=(const rounding_effects& other) {
    max_displacement = std::max(max_displacement, other.max_displacement);
    step = std::max(step, other.step);
    noticeable = noticeable || other.noticeable;
    compared = compared || other.compared;
    collapsed += other.collapsed;
    meeting += other.meeting;
    if (status == treeform::status::ok) status = other.status;
    return *this;
}

rounding_effects find_rounding_effects(const mesh_ref& given, const transform<3>& by,
                                       points_view placed, precision before, precision after,
                                       const progress_callback& progress) {
    const detail::base::prepared_ref held(given);
    const prepared_mesh& mesh = held;
    const mesh_view moving = mesh.indexed_view();
    if (placed.size() != moving.points.size())
        throw std::invalid_argument(
            "treeform::find_rounding_effects: expected as many placed points as points");
    const bool to_float32 = after == precision::float32 && before == precision::float64;
    rounding_effects found;
    found.max_displacement = detail::max_displacement(moving.points, by, placed);
    found.step = coordinate_step(placed, after);
    const auto box = bounding_box(moving.points);
    found.noticeable = found.max_displacement > 0.0 &&
                       (to_float32 || found.max_displacement > 1e-6 * (box ? box->diagonal() : 0));
    const bool coarser = found.step > coordinate_step(moving.points, before);
    if (!coarser || !(found.max_displacement > 0.0) || mesh.is_cloud()) return found;
    const rounding_effects defects = find_rounding_defects(moving, placed, progress);
    found.compared = true;
    found.collapsed = defects.collapsed;
    found.meeting = defects.meeting;
    if (defects.status == treeform::status::cancelled) found.status = status::cancelled;
    return found;
}

}  // namespace treeform
