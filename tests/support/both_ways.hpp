#pragma once
/// \file
/// The exact surface of a set operation, found in two ways: by cutting all faces, and by leaving
/// out what is hidden, however little that is.

#include <libmesh/boolean/bundled_operands.hpp>
#include <libmesh/boolean/interaction_zone.hpp>
#include <libmesh/boolean/joined_operands.hpp>
#include <libmesh/boolean/near_labels.hpp>
#include <libmesh/boolean/operand_edges.hpp>
#include <libmesh/boolean/partial_expression.hpp>
#include <libmesh/boolean/surface_components.hpp>
#include <libmesh/boolean/undecided_part.hpp>
#include <treeform/mesh/boolean.hpp>
#include <treeform/tf.hpp>

#include <support/exact_chain.hpp>
#include <support/rational_volume.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace test {

/// All faces are cut along each other, and each cell is asked about by itself.
/// \pre each operand bounds a solid
inline exact_chain surface_of_all(std::span<const tf::mesh> operands,
                                  const tf::boolean_expression& expression, tf::fill_rule rule,
                                  exact_numbers& numbers) {
    const exact_arrangement arranged(operands, rule);
    std::vector<tf::triangle3> given;
    for (const tf::mesh& operand : operands)
        for (const auto& [a, b, c] : operand.faces)
            given.push_back({operand.points[a], operand.points[b], operand.points[c]});
    const tf::mesh_arrangement& cut = arranged.cut();
    exact_chain chain;
    for (std::size_t f = 0; f < cut.faces.size(); ++f) {
        const int sign = arranged.sign(f, expression);
        const auto& [a, b, c] = cut.faces[f];
        if (sign != 0)
            add(chain, numbers, {cut.point(a), cut.point(b), cut.point(c)},
                given[cut.covers_of(f).front().face], sign);
    }
    return chain;
}

struct surface_of_some {
    exact_chain chain{};
    std::size_t left_out = 0;  ///< faces
    std::size_t uncut = 0;     ///< pairs of the other faces that were not looked at
};

/// As `boolean` does where operands hide each other, but always, and in boxes as small as `limits`
/// says.
/// \pre each operand bounds a solid
inline surface_of_some surface_of_undecided(std::span<const tf::mesh> operands,
                                            const tf::boolean_expression& expression,
                                            tf::fill_rule rule,
                                            const tf::detail::boolean::division_limits& limits,
                                            exact_numbers& numbers) {
    namespace detail = tf::detail::boolean;
    const std::vector<tf::mesh_view> views(operands.begin(), operands.end());
    detail::joined_operands joined = detail::join_operands(views);
    const std::vector<std::uint32_t> operand_of_face = joined.operand_of_face();
    detail::surface_components components(joined.all, operand_of_face,
                                          detail::find_operand_edges(joined.all, operand_of_face));
    detail::bundled_operands bundled({}, std::make_unique<const detail::undecided_part>(
                                             std::move(joined), std::move(components),
                                             detail::partial_expression(expression, rule), limits));
    bundled.find_pairs({});
    const detail::bundles& all = bundled.all();
    detail::cut_faces cut = detail::cut_near(bundled, detail::cut_what::near_beside_far, {});
    const detail::interaction_zone& near = cut.near;
    const tf::arrange_faces_result& arranged = cut.arranged;
    const auto chosen =
        detail::near_labels(all, near, arranged.cut,
                            {std::move(*cut.far[0]), std::move(*cut.far[1])}, bundled.part())
            .choose(expression, rule);

    surface_of_some result;
    result.left_out = bundled.part()->left_out();
    result.uncut = detail::own_pairs(*all[0].mesh, {}).size() - all[0].pairs.size();
    const auto triangle = [](tf::mesh_view mesh, std::size_t f) {
        const auto& [a, b, c] = mesh.faces[f];
        return tf::triangle3{mesh.points[a], mesh.points[b], mesh.points[c]};
    };
    for (std::size_t f = 0; f < chosen.near.faces.size(); ++f) {
        const auto& [a, b, c] = chosen.near.faces[f];
        add(result.chain, numbers,
            {arranged.cut.point(a), arranged.cut.point(b), arranged.cut.point(c)},
            triangle(near.local, arranged.cut.covers_of(chosen.near.face_of[f]).front().face));
    }
    const tf::mesh_view whole = all[0].view();
    for (std::size_t f = 0; f < whole.faces.size(); ++f) {
        const detail::disposition of = chosen.dispositions[f];
        if (of != detail::disposition::kept && of != detail::disposition::turned) continue;
        const tf::triangle3 t = triangle(whole, f);
        const bool kept = of == detail::disposition::kept;
        add(result.chain, numbers, {t[0], kept ? t[1] : t[2], kept ? t[2] : t[1]}, t);
    }
    return result;
}

}  // namespace test
