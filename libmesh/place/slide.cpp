#include <libmesh/place/placing.hpp>
#include <treeform/mesh/slide.hpp>

#include <stdexcept>

namespace treeform {
namespace {

using detail::place::placing;

using many = std::span<const prepared_mesh>;

many one(const prepared_mesh& mesh) { return {&mesh, 1}; }

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

placement slide(const prepared_mesh& moving, many fixed, const point3& direction,
                const slide_options& options) {
    return slide_as("slide", moving, fixed, direction, options);
}

placement slide(const prepared_mesh& moving, const prepared_mesh& fixed, const point3& direction,
                const slide_options& options) {
    return slide(moving, one(fixed), direction, options);
}

placement slide(mesh_view moving, mesh_view fixed, const point3& direction,
                const slide_options& options) {
    return slide(prepared_mesh::borrow(moving), prepared_mesh::borrow(fixed), direction, options);
}

placement drop(const prepared_mesh& moving, many fixed, const drop_options& o) {
    const auto bed = fixed.empty() ? std::optional(0.0) : std::nullopt;
    return slide_as("drop", moving, fixed, o.direction, slide_of(o, bed));
}

placement drop(const prepared_mesh& moving, const drop_options& options) {
    return drop(moving, many{}, options);
}

placement drop(mesh_view moving, const drop_options& options) {
    return drop(prepared_mesh::borrow(moving), options);
}

placement drop(const prepared_mesh& moving, const prepared_mesh& fixed,
               const drop_options& options) {
    return drop(moving, one(fixed), options);
}

placement drop(mesh_view moving, mesh_view fixed, const drop_options& options) {
    return drop(prepared_mesh::borrow(moving), prepared_mesh::borrow(fixed), options);
}

placement mate(const prepared_mesh& moving, many fixed, const mate_options& o) {
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

placement mate(const prepared_mesh& moving, const prepared_mesh& fixed,
               const mate_options& options) {
    return mate(moving, one(fixed), options);
}

placement mate(mesh_view moving, mesh_view fixed, const mate_options& options) {
    return mate(prepared_mesh::borrow(moving), prepared_mesh::borrow(fixed), options);
}

placement separate(const prepared_mesh& moving, many fixed, const separate_options& o) {
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

placement separate(const prepared_mesh& moving, const prepared_mesh& fixed,
                   const separate_options& options) {
    return separate(moving, one(fixed), options);
}

placement separate(mesh_view moving, mesh_view fixed, const separate_options& options) {
    return separate(prepared_mesh::borrow(moving), prepared_mesh::borrow(fixed), options);
}

placement measure_among(const prepared_mesh& moving, many fixed, const measure_among_options& o) {
    placing work(moving, fixed,
                 {.function = "measure_among",
                  .clearance = o.clearance,
                  .limit = o.limit,
                  .vertices = o.vertices,
                  .progress = o.progress});
    return work.run([](placing& p) { p.measure(); });
}

}  // namespace treeform
