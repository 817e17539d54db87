#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/place/placing.hpp>
#include <treeform/mesh/slide.hpp>

#include <stdexcept>

namespace treeform {
namespace {

using detail::place::placing;

using many = std::span<const prepared_mesh>;

/// What `drop` is except for its direction; `bed` is the one that there is without fixed meshes.
slide_options slide_of(const drop_options& o, const std::optional<double>& bed) {
    return {.clearance = o.clearance,
            .max_travel = o.max_travel,
            .precision = o.precision,
            .bed = o.bed ? o.bed : bed,
            .limit = o.limit,
            .vertices = o.vertices,
            .progress = o.progress};
}

placement slide_as(const char* function, const prepared_mesh& moving, many fixed,
                   const point3& direction, const slide_options& o) {
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
                const slide_options& options) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    return slide_as("slide", moving, fixed, direction, options);
}

placement drop(const mesh_ref& given_moving, const mesh_refs& given_fixed, const drop_options& o) {
    const detail::base::prepared_ref moving(given_moving);
    const detail::base::prepared_refs all_fixed(given_fixed);
    const std::span<const prepared_mesh> fixed = all_fixed;
    const auto bed = fixed.empty() ? std::optional(0.0) : std::nullopt;
    return slide_as("drop", moving, fixed, o.direction, slide_of(o, bed));
}

placement drop(const mesh_ref& moving, const drop_options& options) {
    return drop(moving, mesh_refs(), options);
}

placement mate(const mesh_ref& given_moving, const mesh_refs& given_fixed, const mate_options& o) {
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
                   const separate_options& o) {
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
                        const measure_among_options& o) {
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
