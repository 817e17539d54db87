/// \file
/// Small meshes and planes, mostly through their vertices: sections of closed meshes are closed,
/// pieces that are certified are clean and closed, and add up.

#include "bytes.hpp"
#include <treeform/mesh/cut.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/section.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <stdexcept>

namespace {

using tf::fuzz::require;

void check_section(const tf::mesh& mesh, const tf::oriented_plane& plane, bool closed) {
    const tf::section_result made = tf::section(mesh, plane);
    const tf::section_layer& layer = made.layers.at(0);
    require(layer.loop_count == made.loops.size(), "all loops are of the layer");
    require(!closed || layer.open_count == 0, "sections of closed meshes are closed");
    for (const tf::section_loop& loop : made.loops) {
        require(loop.point_count >= (loop.closed ? 3U : 2U), "loops have sides");
        require((loop.parent == tf::section_loop::none) == (loop.depth == 0), "who is around");
    }
}

void check_piece(const tf::cut_piece& piece) {
    if (!piece.certificate || piece.mesh.faces.empty()) return;
    require(tf::find_invalid_faces(piece.mesh) == tf::invalid_faces{}, "no degenerate face");
    require(!tf::find_open_edge(piece.mesh), "no open edge");
    require(tf::self_intersections(piece.mesh).pairs.empty(), "no two faces meet");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    tf::fuzz::bytes in(data, size);
    const tf::mesh mesh = in.below(3) == 0 ? in.shape(8, 8) : in.solid();
    tf::oriented_plane plane{in.point(), in.point()};
    if (!mesh.points.empty() && in.below(4) != 0)
        plane.at = mesh.points[in.below(mesh.points.size())];
    if (in.below(2) == 0) plane.normal = {0, 0, in.below(2) == 0 ? 1.0 : -1.0};
    try {
        check_section(mesh, plane, !tf::find_open_edge(mesh));
        const tf::cut_result made = tf::cut(mesh, plane);
        if (!made.certificate) return 0;
        require(made.pieces.size() == 2, "two halves");
        for (const tf::cut_piece& piece : made.pieces) check_piece(piece);
    } catch (const std::invalid_argument&) {  // coordinates too large, or no plane
        return -1;
    }
    return 0;
}
