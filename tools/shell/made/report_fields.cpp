// Made by tools/bindings.
#include "tools/shell/made/report_fields.hpp"

namespace tools {
namespace {

template <class T>
json list_of(const std::vector<T>& values, json entry(const T&)) {
    json list = json::array();
    for (const T& one : values) list.push_back(entry(one));
    return list;
}

}  // namespace

json join_entry(const tf::repair_statistics& from) {
    return {{"tetrahedra", from.tetrahedra},      {"degenerate", from.degenerate},
            {"repeated", from.repeated},          {"closed_edges", from.closed_edges},
            {"split_edges", from.split_edges},    {"gap_limit", from.gap_limit},
            {"widest_closed", from.widest_closed}};
}

json orient_entry(const tf::repair_statistics& from) {
    return {{"flipped", from.flipped},
            {"turned_outward", from.turned_outward},
            {"strays", from.strays}};
}

json fill_entry(const tf::repair_statistics& from) {
    return {{"holes", from.holes}, {"edges", from.hole_edges}, {"faces", from.filled}};
}

json cut_entry(const tf::repair_statistics& from) {
    return {{"pairs", from.pairs},
            {"removed", from.removed},
            {"separated_points", from.split_vertices},
            {"labeled_cells", from.labeled_cells},
            {"dropped_area", from.dropped_area},
            {"flipped_area", from.flipped_area}};
}

json detach_entry(const tf::repair_statistics& from) {
    return {{"moved", from.detached}, {"touching", from.touching}};
}

json effort_entry(const tf::search_effort& from) {
    return {{"pairs", from.pairs}, {"bound", from.bound}, {"cut", from.cut}};
}

json deviations_entry(const tf::deviation_result& from) {
    return {{"mean", from.mean},      {"mean_absolute", from.mean_absolute},
            {"rms", from.rms},        {"p50", from.p50},
            {"p95", from.p95},        {"p99", from.p99},
            {"max", from.max},        {"lowest", from.lowest},
            {"highest", from.highest}};
}

json freedom_entry(const tf::align_freedom& from) {
    return {{"turn", from.turn}, {"shift", from.shift}, {"stiffness", from.stiffness}};
}

json fit_entry(const tf::align_result& from) {
    return {{"rms", from.rms},
            {"rms_at_start", from.rms_at_start},
            {"overlap", from.overlap},
            {"inliers", from.inliers},
            {"correlation", from.correlation},
            {"uncertainty", from.uncertainty},
            {"scale", from.scale},
            {"converged", from.converged},
            {"end", tf::name_of(from.end)},
            {"iterations", from.iterations},
            {"start", from.start},
            {"pivot", from.pivot},
            {"pivot_moved", from.pivot_moved},
            {"freedoms", list_of(from.freedoms, freedom_entry)}};
}

}  // namespace tools
