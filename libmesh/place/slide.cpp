#include <libmesh/base/prepared_ref.hpp>
#include <libmesh/place/placing.hpp>
#include <treeform/mesh/slide.hpp>

#include <stdexcept>

namespace treeform {
namespace {

using detail::place::looking;
using detail::place::placing;

template <class Find>
placement placed(const char* function, const mesh_ref& moving, const mesh_refs& fixed,
                 const placement_options& options, const Find& find,
                 looking where = looking::everywhere) {
    const detail::base::prepared_ref one(moving);
    const detail::base::prepared_refs others(fixed);
    return placing(function, one, others, options, where).run(find);
}

placement_options without_bed(placement_options options) {
    options.bed.reset();
    return options;
}

}  // namespace

placement slide(const mesh_ref& moving, const mesh_refs& fixed, const point3& direction,
                const placement_options& options) {
    return placed(
        "slide", moving, fixed, options, [&](placing& p) { p.slide(direction); },
        looking::on_the_way);
}

placement drop(const mesh_ref& moving, const mesh_refs& fixed, const placement_options& options,
               const point3& direction) {
    placement_options o = options;
    if (fixed.empty() && !o.bed) o.bed = 0.0;
    return placed(
        "drop", moving, fixed, o, [&](placing& p) { p.slide(direction); }, looking::on_the_way);
}

placement drop(const mesh_ref& moving, const placement_options& options, const point3& direction) {
    return drop(moving, mesh_refs(), options, direction);
}

placement mate(const mesh_ref& moving, const mesh_refs& fixed, const placement_options& options) {
    return placed("mate", moving, fixed, without_bed(options), [](placing& p) { p.mate(); });
}

placement separate(const mesh_ref& moving, const mesh_refs& fixed,
                   const placement_options& options) {
    return placed("separate", moving, fixed, without_bed(options),
                  [](placing& p) { p.separate(); });
}

placement measure_in_place(const mesh_ref& moving, const mesh_refs& fixed,
                           const placement_options& o) {
    return placed("measure_in_place", moving, fixed,
                  {.clearance = o.clearance,
                   .limit = o.limit,
                   .vertices = o.vertices,
                   .progress = o.progress},
                  [](placing& p) { p.measure(); });
}

}  // namespace treeform
