/// \file
/// Set operations of small solids: what is certified is clean and closed, and open operands are
/// told of.

#include "bytes.hpp"
#include <libmesh/boolean/boolean.hpp>
#include <libmesh/intersect/point_location.hpp>
#include <libmesh/intersect/self_intersections.hpp>
#include <libmesh/validate.hpp>

#include <array>
#include <stdexcept>

namespace {

void add(tf::mesh& to, const tf::mesh& shape) {
    const auto offset = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), shape.points.begin(), shape.points.end());
    for (const tf::face& f : shape.faces)
        to.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
}

/// One or two solids; now and then anything.
tf::mesh operand(tf::fuzz::bytes& in) {
    const std::size_t kind = in.below(8);
    if (kind == 7) return in.shape(8, 8);
    tf::mesh made = in.solid();
    if (kind > 4) add(made, in.solid());
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::boolean_expression;
    using tf::fuzz::require;
    tf::fuzz::bytes in(data, size);
    const std::size_t operation = in.below(3);
    tf::boolean_options options;
    options.to_float = in.below(2) == 1;
    options.inside = static_cast<tf::inside_rule>(in.below(3));
    const tf::mesh a = operand(in);
    const tf::mesh b = operand(in);
    const std::array<tf::mesh_view, 2> views{a, b};
    tf::solid_result result;
    try {
        result = tf::boolean(views,
                             operation == 0   ? boolean_expression::union_of(2)
                             : operation == 1 ? boolean_expression::intersection_of(2)
                                              : boolean_expression::difference_of(2),
                             options);
    } catch (const std::invalid_argument&) {
        return -1;  // coordinates beyond 2^1000
    }
    require(result.source_face.size() == result.surface.faces.size(), "a source for each face");
    require(result.source_point.size() == result.surface.points.size(), "a source for each point");
    if (result.open_count > 0) require(result.surface.faces.empty(), "open operands give nothing");
    if (!result.certified) return 0;
    require(tf::find_defects(result.surface) == tf::mesh_defects{}, "no degenerate face");
    require(!tf::find_open_edge(result.surface), "no open edge");
    require(tf::self_intersections(result.surface).pairs.empty(), "no two faces meet");
    return 0;
}
