/// \file
/// Set operations of small solids: what is certified is clean and closed, open operands are told
/// of, and operands that are known to be sound get the same result.

#include "bytes.hpp"
#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/point_location.hpp>
#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/self_intersections.hpp>
#include <treeform/tf.hpp>

#include <array>
#include <span>
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

void check(const tf::boolean_result& result) {
    using tf::fuzz::require;
    const tf::mesh& surface = result.mesh;
    require(result.face_source.size() == surface.faces.size(), "a source for each face");
    require(result.vertex_source.size() == surface.points.size(), "a source for each point");
    if (result.certificate.open_count > 0)
        require(surface.faces.empty(), "open operands give nothing");
    if (!result.certificate) return;
    require(tf::find_invalid_faces(surface) == tf::invalid_faces{}, "no degenerate face");
    require(!tf::find_open_edge(surface), "no open edge");
    require(tf::self_intersections(surface).pairs.empty(), "no two faces meet");
}

/// Looks at both operands by themselves; where both become sound, at what they make.
void check_sound(const tf::mesh& a, const tf::mesh& b, const tf::boolean_expression& expression) {
    const auto alone = [](const tf::mesh_view& operand) {
        return tf::boolean(std::span(&operand, 1), tf::boolean_expression::union_of(1));
    };
    const tf::boolean_result of_a = alone(a);
    const tf::boolean_result of_b = alone(b);
    check(of_a);
    check(of_b);
    for (const tf::boolean_result* result : {&of_a, &of_b}) {
        if (!result->certificate) return;
        tf::fuzz::require(alone(result->mesh).mesh == result->mesh,
                          "a certified solid united is what it was");
    }
    const std::array<tf::mesh_view, 2> views{of_a.mesh, of_b.mesh};
    const tf::boolean_result looked_at = tf::boolean(views, expression);
    const auto ready_a = tf::prepared_mesh::borrow(of_a.mesh);
    const auto ready_b = tf::prepared_mesh::borrow(of_b.mesh);
    const tf::boolean_result taken = tf::boolean({ready_a, ready_b}, expression);
    check(looked_at);
    tf::fuzz::require(looked_at.certificate.status == taken.certificate.status,
                      "the same certificate");
    tf::fuzz::require(looked_at.mesh == taken.mesh, "the same surface");
    tf::fuzz::require(looked_at.face_source == taken.face_source, "the same sources");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using tf::boolean_expression;
    tf::fuzz::bytes in(data, size);
    const std::size_t operation = in.below(3);
    const auto expression = operation == 0   ? boolean_expression::union_of(2)
                            : operation == 1 ? boolean_expression::intersection_of(2)
                                             : boolean_expression::difference_of(2);
    tf::boolean_options options;
    options.precision = in.below(2) == 1 ? tf::precision::float32 : tf::precision::float64;
    options.fill_rule = static_cast<tf::fill_rule>(in.below(3));
    const std::size_t more = in.below(8);
    options.merge_coplanar = (more & 1) != 0;
    options.volumes = (more & 2) != 0;
    const tf::mesh a = operand(in);
    const tf::mesh b = operand(in);
    const std::array<tf::mesh_view, 2> views{a, b};
    try {
        check(tf::boolean(views, expression, options));
        if (more > 5) check_sound(a, b, expression);
    } catch (const std::invalid_argument&) {
        return -1;  // coordinates beyond 2^1000
    }
    return 0;
}
