// Made by tools/bindings of the headers of C++: see its README.
#include "../bindings.hpp"

namespace binding {

template <class Visit>
void each_field(tf::cloud_inputs& how, const Visit& visit) {
    visit("paths", how.paths);
    visit("columns", how.columns);
    visit("mixed", how.mixed);
}

template <class Visit>
void each_field(tf::read_options& how, const Visit& visit) {
    visit("columns", how.columns);
    visit("drop_non_finite", how.drop_non_finite);
}

template <class Visit>
void each_field(tf::write_options& how, const Visit& visit) {
    visit("format", how.format);
    visit("ascii", how.ascii);
    visit("precision", how.precision);
    visit("drop", how.drop);
    visit("rename", how.rename);
    visit("las_scale", how.las_scale);
    visit("las_offset", how.las_offset);
    visit("round", how.round);
}

template <class Visit>
void each_field(tf::boolean_options& how, const Visit& visit) {
    visit("inside", how.inside);
    visit("precision", how.precision);
    visit("max_displacement", how.max_displacement);
    visit("keep_cuts", how.keep_cuts);
    visit("simplify", how.simplify);
    visit("volumes", how.volumes);
    visit("min_volume", how.min_volume);
    visit("gap", how.gap);
}

template <class Visit>
void each_field(tf::cut_options& how, const Visit& visit) {
    visit("precision", how.precision);
    visit("max_displacement", how.max_displacement);
    visit("caps", how.caps);
}

template <class Visit>
void each_field(tf::resolve_options& how, const Visit& visit) {
    visit("inside", how.inside);
    visit("precision", how.precision);
    visit("max_displacement", how.max_displacement);
    visit("keep_cuts", how.keep_cuts);
    visit("touching", how.touching);
    visit("max_loss", how.max_loss);
}

template <class Visit>
void each_field(tf::repair_options& how, const Visit& visit) {
    visit("join", how.join);
    visit("orient", how.orient);
    visit("fill", how.fill);
    visit("resolve", how.resolve);
    visit("detach", how.detach);
    visit("gap", how.gap);
    visit("largest_hole", how.largest_hole);
    visit("strays", how.strays);
    visit("inside", how.inside);
    visit("max_loss", how.max_loss);
    visit("sheet", how.sheet);
    visit("precision", how.precision);
    visit("max_displacement", how.max_displacement);
    visit("keep_cuts", how.keep_cuts);
}

template <class Visit>
void each_field(tf::offset_options& how, const Visit& visit) {
    visit("resolution", how.resolution);
    visit("offset", how.offset);
    visit("shift", how.shift);
    visit("precision", how.precision);
}

template <class Visit>
void each_field(tf::simplify_options& how, const Visit& visit) {
    visit("precision", how.precision);
    visit("target_faces", how.target_faces);
    visit("feature_angle", how.feature_angle);
}

template <class Visit>
void each_field(tf::feature_options& how, const Visit& visit) {
    visit("tolerance", how.tolerance);
    visit("plane_angle", how.plane_angle);
    visit("facet_angle", how.facet_angle);
    visit("arc", how.arc);
}

template <class Visit>
void each_field(tf::intersection_options& how, const Visit& visit) {
    visit("vertices", how.vertices);
    visit("move_a", how.move_a);
    visit("move_b", how.move_b);
    visit("first_only", how.first_only);
    visit("kinds", how.kinds);
    visit("limit", how.limit);
}

template <class Visit>
void each_field(tf::stream_search_options& how, const Visit& visit) {
    visit("vertices", how.vertices);
    visit("kinds", how.kinds);
    visit("format", how.format);
    visit("memory", how.memory);
    visit("folder", how.folder);
    visit("faces_per_tile", how.faces_per_tile);
}

template <class Visit>
void each_field(tf::weld_options& how, const Visit& visit) {
    visit("tolerance", how.tolerance);
    visit("chain", how.chain);
    visit("same", how.same);
    visit("keep_seams", how.keep_seams);
    visit("across", how.across);
    visit("keep", how.keep);
    visit("keep_by", how.keep_by);
    visit("order_by", how.order_by);
    visit("highest_first", how.highest_first);
    visit("only_borders", how.only_borders);
    visit("keep_manifold", how.keep_manifold);
    visit("keep_degenerate", how.keep_degenerate);
}

template <class Visit>
void each_field(tf::weld_stream_options& how, const Visit& visit) {
    visit("tolerance", how.tolerance);
    visit("relative", how.relative);
    visit("chain", how.chain);
    visit("same", how.same);
    visit("keep", how.keep);
    visit("keep_by", how.keep_by);
    visit("order_by", how.order_by);
    visit("highest_first", how.highest_first);
    visit("keep_seams", how.keep_seams);
    visit("across", how.across);
    visit("keep_degenerate", how.keep_degenerate);
    visit("as_las", how.as_las);
    visit("memory", how.memory);
    visit("folder", how.folder);
    visit("points_per_tile", how.points_per_tile);
}

template <class Visit>
void each_field(tf::placement_options& how, const Visit& visit) {
    visit("clearance", how.clearance);
    visit("max_travel", how.max_travel);
    visit("flip", how.flip);
    visit("max_angle", how.max_angle);
    visit("tolerance", how.tolerance);
    visit("precision", how.precision);
    visit("bed", how.bed);
    visit("effort", how.effort);
}

template <class Visit>
void each_field(tf::measure_options& how, const Visit& visit) {
    visit("radius", how.radius);
    visit("vertices", how.vertices);
    visit("directions", how.directions);
    visit("effort", how.effort);
}

template <class Visit>
void each_field(tf::impact_options& how, const Visit& visit) {
    visit("move_a", how.move_a);
    visit("move_b", how.move_b);
    visit("latest", how.latest);
}

template <class Visit>
void each_field(tf::lay_flat_options& how, const Visit& visit) {
    visit("normal", how.normal);
    visit("point", how.point);
    visit("most_stable", how.most_stable);
    visit("keep_spin", how.keep_spin);
    visit("tolerance", how.tolerance);
    visit("bed", how.bed);
    visit("overhang_angle", how.overhang_angle);
    visit("precision", how.precision);
}

template <class Visit>
void each_field(tf::align_options& how, const Visit& visit) {
    visit("method", how.method);
    visit("overlap", how.overlap);
    visit("robust", how.robust);
    visit("max_distance", how.max_distance);
    visit("scale", how.scale);
    visit("least_scale", how.least_scale);
    visit("most_scale", how.most_scale);
    visit("max_iterations", how.max_iterations);
    visit("tolerance", how.tolerance);
    visit("starts", how.starts);
    visit("samples", how.samples);
    visit("start", how.start);
    visit("precision", how.precision);
}

template <class Visit>
void each_field(tf::pack_options& how, const Visit& visit) {
    visit("size", how.size);
    visit("corner", how.corner);
    visit("spacing", how.spacing);
    visit("turns", how.turns);
    visit("stack", how.stack);
    visit("plates", how.plates);
    visit("plate_step", how.plate_step);
    visit("seed", how.seed);
    visit("tries", how.tries);
    visit("seconds", how.seconds);
    visit("precision", how.precision);
}

template <class Visit>
void each_field(tf::deviation_options& how, const Visit& visit) {
    visit("band", how.band);
    visit("bins", how.bins);
    visit("both_ways", how.both_ways);
}

template <class Visit>
void each_field(tf::clash_options& how, const Visit& visit) {
    visit("clearance", how.clearance);
    visit("volumes", how.volumes);
    visit("depths", how.depths);
    visit("limit", how.limit);
    visit("first_only", how.first_only);
    visit("vertices", how.vertices);
}

void add_options(py::module_& module) {
    add_options_of<tf::cloud_inputs>(module, "CloudInputs");
    add_options_of<tf::read_options>(module, "ReadOptions");
    add_options_of<tf::write_options>(module, "WriteOptions");
    add_options_of<tf::boolean_options>(module, "BooleanOptions");
    add_options_of<tf::cut_options>(module, "CutOptions");
    add_options_of<tf::resolve_options>(module, "ResolveOptions");
    add_options_of<tf::repair_options>(module, "RepairOptions");
    add_options_of<tf::offset_options>(module, "OffsetOptions");
    add_options_of<tf::simplify_options>(module, "SimplifyOptions");
    add_options_of<tf::feature_options>(module, "FeatureOptions");
    add_options_of<tf::intersection_options>(module, "IntersectionOptions");
    add_options_of<tf::stream_search_options>(module, "StreamSearchOptions");
    add_options_of<tf::weld_options>(module, "WeldOptions");
    add_options_of<tf::weld_stream_options>(module, "WeldStreamOptions");
    add_options_of<tf::placement_options>(module, "PlacementOptions");
    add_options_of<tf::measure_options>(module, "MeasureOptions");
    add_options_of<tf::impact_options>(module, "ImpactOptions");
    add_options_of<tf::lay_flat_options>(module, "LayFlatOptions");
    add_options_of<tf::align_options>(module, "AlignOptions");
    add_options_of<tf::pack_options>(module, "PackOptions");
    add_options_of<tf::deviation_options>(module, "DeviationOptions");
    add_options_of<tf::clash_options>(module, "ClashOptions");
}

}  // namespace binding
