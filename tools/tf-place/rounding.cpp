#include "tools/tf-place/rounding.hpp"

#include "tools/common/console.hpp"
#include "tools/common/folds.hpp"
#include "tools/common/written_form.hpp"
#include <treeform/tf.hpp>

#include <algorithm>

namespace tools {
namespace {

rounding together(const std::vector<rounding>& all) {
    rounding sum;
    for (const rounding& one : all) {
        sum.max_move = std::max(sum.max_move, one.max_move);
        sum.step = std::max(sum.step, one.step);
        sum.noticeable = sum.noticeable || one.noticeable;
        if (!one.harm) continue;
        if (!sum.harm) sum.harm.emplace();
        sum.harm->collapsed += one.harm->collapsed;
        sum.harm->meeting += one.harm->meeting;
    }
    return sum;
}

}  // namespace

rounding look_at_rounding(job& work, const body& b, const tf::transform<3>& matrix,
                          const std::vector<tf::point3>& placed, bool to_single) {
    const auto timing = work.time("settle");
    const bool was_single = is_single(*b.file);
    rounding found{.max_move = tf::largest_move(b.mesh.points, matrix, placed),
                   .step = tf::coordinate_step(placed, to_single)};
    found.noticeable = found.max_move > 0.0 &&
                       ((to_single && !was_single) || found.max_move > 1e-6 * tf::diagonal(*b.box));
    const bool coarser = found.step > tf::coordinate_step(b.mesh.points, was_single);
    if (b.cloud || !coarser || !(found.max_move > 0.0)) return found;
    found.harm = tf::harm_of_rounding(b.mesh, placed, work.progress("rounding"));
    work.out.end_progress();
    work.keeper.check();
    return found;
}

void enter_rounding(job& work, const std::vector<rounding>& all, bool to_single) {
    const rounding sum = together(all);
    work.entry["rounding"] = {
        {"max_move", sum.max_move},
        {"step", sum.step},
        {"collapsed_faces", sum.harm ? json(sum.harm->collapsed) : json(nullptr)},
        {"new_pairs", sum.harm ? json(sum.harm->meeting) : json(nullptr)}};
    if (sum.noticeable)
        work.warn("rounded", std::string(to_single ? "written in single precision: " : "") +
                                 "coordinates move by up to " + shortest(sum.max_move));
    if (sum.harm) warn_of_folds(work, *sum.harm, to_single);
}

}  // namespace tools
