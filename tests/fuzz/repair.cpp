/// \file
/// Repair of any small mesh: what is certified is clean.

#include "bytes.hpp"
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::fuzz::require;
    tf::fuzz::bytes in(data, size);
    tf::resolve_options options;
    const auto mode = static_cast<tf::resolve_mode>(in.below(3));
    options.precision = in.below(2) == 1 ? tf::precision::float32 : tf::precision::float64;
    const tf::mesh mesh = in.below(4) == 0 ? in.solid() : in.shape(40, 20);
    options.touching = in.below(2) == 1;
    tf::repair_result result;
    try {
        result = tf::resolve_self_intersections(mesh, mode, options);
    } catch (const std::invalid_argument&) {
        return -1;  // coordinates beyond 2^1000
    }
    require(result.face_source.size() == result.mesh.faces.size(), "a source for each face");
    require(result.vertex_source.size() == result.mesh.points.size(), "a source for each point");
    if (!result.certificate) return 0;
    require(tf::find_invalid_faces(result.mesh) == tf::invalid_faces{}, "no degenerate face");
    const bool may_touch = mode == tf::resolve_mode::remove && !options.touching;
    for (const tf::face_pair& pair : tf::self_intersections(result.mesh).pairs)
        require(may_touch && pair.kind == tf::pair_kind::touching, "no two faces meet");
    if (mode == tf::resolve_mode::outer) require(!tf::find_open_edge(result.mesh), "no open edge");
    return 0;
}
