#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/place/placing.hpp>
#include <treeform/mesh/slide.hpp>

#include <stdexcept>

namespace treeform {
namespace {

using detail::place::placing;

using many = std::span<const prepared_mesh>;

placement slide_as(const char* function, const prepared_mesh& moving, many fixed,
                   const point3& direction, const placement_options& o) {
    placing work(moving, fixed,
                 {.function = function,
                  .clearance = o.clearance,
                  .max_travel = o.max_travel,
                  .precision = o.precision,
                  .bed = o.bed,
                  .close_in = o.close_in,
                  .along_direction = true,
                  .limit = o.limit,
                  .vertices = o.vertices,
                  .progress = o.progress});
    return work.run([&](placing& p) { p.slide(direction); });
}

}  // namespace

placement slide(const mesh_ref& given_moving, const mesh_refs& given_fixed, const point3& direction,
                const placement_options& options) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    return slide_as("slide", moving, fixed, direction, options);
}

placement drop(const mesh_ref& given_moving, const mesh_refs& given_fixed,
               const placement_options& options, const point3& direction) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    placement_options o = options;
    if (fixed.empty() && !o.bed) o.bed = 0.0;
    return slide_as("drop", moving, fixed, direction, o);
}

placement drop(const mesh_ref& moving, const placement_options& options, const point3& direction) {
    return drop(moving, mesh_refs(), options, direction);
}

placement mate(const mesh_ref& given_moving, const mesh_refs& given_fixed,
               const placement_options& o) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    placing work(moving, fixed,
                 {.function = "mate",
                  .clearance = o.clearance,
                  .max_travel = o.max_travel,
                  .precision = o.precision,
                  .limit = o.limit,
                  .vertices = o.vertices,
                  .progress = o.progress});
    return work.run([](placing& p) { p.mate(); });
}

placement separate(const mesh_ref& given_moving, const mesh_refs& given_fixed,
                   const placement_options& o) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    placing work(moving, fixed,
                 {.function = "separate",
                  .clearance = o.clearance,
                  .max_travel = o.max_travel,
                  .precision = o.precision,
                  .normals = o.normals,
                  .face_pairs = o.face_pairs,
                  .effort = o.effort,
                  .limit = o.limit,
                  .vertices = o.vertices,
                  .progress = o.progress});
    return work.run([](placing& p) { p.separate(); });
}

placement measure_among(const mesh_ref& given_moving, const mesh_refs& given_fixed,
                        const placement_options& o) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    placing work(moving, fixed,
                 {.function = "measure_among",
                  .clearance = o.clearance,
                  .limit = o.limit,
                  .vertices = o.vertices,
                  .progress = o.progress});
    return work.run([](placing& p) { p.measure(); });
}

}  // namespace treeform
