#include <libmesh/base/words.hpp>
#include <treeform/mesh/repair.hpp>

#include <cstdint>
#include <string>
#include <utility>

namespace treeform {

const mesh& repair_result::value() const& {
    if (!certificate) throw not_certified_error(certificate);
    return mesh;
}

treeform::mesh repair_result::value() && {
    if (!certificate) throw not_certified_error(std::move(certificate));
    return std::move(mesh);
}

std::string repair_statistics::message() const {
    using detail::base::brief;
    using detail::base::counted;
    std::string text;
    const auto add = [&](std::uint64_t n, const char* one, const char* several,
                         const std::string& more = {}) {
        if (n > 0) text += (text.empty() ? "" : ", ") + counted(n, one, several) + more;
    };
    if (tetrahedra > 0)
        text += "boundary kept of " + counted(tetrahedra, "tetrahedron", "tetrahedra");
    add(degenerate, "face without area dropped", "faces without area dropped");
    add(repeated, "repeated face dropped", "repeated faces dropped");
    add(closed_edges, "crack edge closed", "crack edges closed",
        " (" + brief(widest_closed) + " wide at most)");
    add(split_edges, "edge split at a vertex", "edges split at vertices");
    add(flipped, "face flipped", "faces flipped");
    add(turned_outward, "part turned outward", "parts turned outward");
    add(strays, "stray face dropped", "stray faces dropped");
    add(holes, "hole filled", "holes filled", " (" + counted(hole_edges, "edge", "edges") + ")");
    add(pairs, "pair cut", "pairs cut");
    add(labeled_cells, "cell labeled inside or outside", "cells labeled inside or outside",
        dropped_area > 0.0 ? " (area " + brief(dropped_area) + " dropped)" : "");
    add(dropped_shells, "shell within another dropped", "shells within others dropped");
    add(removed, "face removed", "faces removed");
    add(covered, "face merged into others", "faces merged into others");
    if (holes == 0) add(filled, "face filled in", "faces filled in");
    add(left_open, "edge left open", "edges left open");
    add(vanished_components, "part vanished", "parts vanished");
    if (detached == 0)
        add(split_vertices, "vertex split where parts touch", "vertices split where parts touch");
    add(detached, "vertex moved apart", "vertices moved apart");
    return text;
}

}  // namespace treeform
