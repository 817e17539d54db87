#include "tools/tf-weld/welding.hpp"

#include <treeform/tf.hpp>

#include <utility>

namespace tools {

welding weld(job& work, const tf::mesh_file& file, const weld_settings& settings) {
    const job::timer timing = work.time("weld");
    welding w;
    w.points = file.mesh.points.size();
    w.polygons = file.stored_faces;
    w.triangles = file.mesh.faces.size();
    if (w.points == 0) throw failure(bad_input, "no-points", work.name + ": no points");
    if (settings.options.only_borders && w.triangles == 0)
        throw failure(bad_input, "no-faces", work.name + ": no faces, so --borders finds no edge");
    w.box = tf::bounding_box(file.mesh.points);
    w.tolerance = settings.tolerance.used(w.box ? w.box->diagonal() : 0.0);
    tf::weld_options options = settings.options;
    options.tolerance = w.tolerance;
    options.progress = work.progress("weld");
    try {
        w.conditions = options.conditions(file.attributes, w.triangles > 0);
        w.result = tf::weld(file, options);
    } catch (const tf::weld_property_error& error) {
        throw property_failure(error, file.attributes);
    }
    work.call_ended(w.result.status == tf::status::cancelled);
    return w;
}

std::optional<std::uint64_t> mergeable(job& work, const tf::mesh_file& welded, const welding& w,
                                       const weld_settings& settings, tf::precision written_as) {
    tf::weld_options options = settings.options;
    options.tolerance = w.tolerance;
    options.same = w.conditions;
    options.keep_seams = false;
    options.progress = work.progress("check");
    const auto again = tf::count_mergeable(welded, options, written_as);
    work.call_ended();
    return again;
}

}  // namespace tools
