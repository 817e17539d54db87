/// \file
/// Repair of any small mesh: what is certified is clean.

#include "bytes.hpp"
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/repair.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/mesh/validate.hpp>
#include <treeform/tf.hpp>

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::fuzz::require;
    tf::fuzz::bytes in(data, size);
    tf::repair_options options;
    options.mode = static_cast<tf::repair_mode>(in.below(3));
    options.to_float = in.below(2) == 1;
    const tf::mesh mesh = in.below(4) == 0 ? in.solid() : in.shape(40, 20);
    options.touching = in.below(2) == 1;
    tf::repaired_mesh result;
    try {
        result = tf::repair(mesh, options);
    } catch (const std::invalid_argument&) {
        return -1;  // coordinates beyond 2^1000
    }
    require(result.face_of.size() == result.surface.faces.size(), "a source for each face");
    require(result.point_of.size() == result.surface.points.size(), "a source for each point");
    if (!result.certified) return 0;
    require(tf::find_defects(result.surface) == tf::mesh_defects{}, "no degenerate face");
    const bool may_touch = options.mode == tf::repair_mode::remove && !options.touching;
    for (const tf::face_pair& pair : tf::self_intersections(result.surface).pairs)
        require(may_touch && pair.kind == tf::pair_kind::touching, "no two faces meet");
    if (options.mode == tf::repair_mode::outer)
        require(!tf::find_open_edge(result.surface), "no open edge");
    return 0;
}
