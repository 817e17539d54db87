// Made by tools/bindings of streams.h and the headers of C++: see its README.
#include <tools/c/made/structs.hpp>

namespace tf = treeform;

void glue::fill(keeper&, const tf::weld_stream_result& from, treeform_weld_stream_result& to) {
    to.points = from.survey.points;
    to.non_finite = from.survey.non_finite;
    to.tolerance = from.survey.tolerance;
    to.tiles = from.survey.tiles;
    to.finished_tiles = from.survey.finished_tiles;
    to.kept = from.counts.kept;
    to.groups = from.counts.groups;
    to.max_displacement = from.counts.max_displacement + from.survey.las_moved;
    to.faces = from.counts.faces;
    to.triangles = from.counts.triangles;
    to.collapsed = from.counts.collapsed;
    to.degenerate = from.counts.degenerate;
    to.nonmanifold_before = from.counts.nonmanifold_before;
    to.nonmanifold_after = from.counts.nonmanifold_after;
    to.flipped = from.counts.flipped;
    to.format = from.written.welded ? from.written.welded->format.c_str() : "";
    to.still_within = from.written.still_within.value_or(0);
    to.still_within_known = from.written.still_within.has_value();
}
