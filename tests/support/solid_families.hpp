#pragma once
/// \file
/// Solids whose set operations are hard to write down: kinds of trouble, each a seeded series.

#include <treeform/mesh/boolean.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <support/random.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace test {

/// Operands, each a closed surface, and what is asked of them.
struct solid_case {
    std::vector<tf::mesh> operands;
    std::vector<tf::boolean_expression> asked;
};

struct solid_family {
    std::string_view name;
    solid_case (*make)(std::size_t number, random& source);  ///< case 0, 1, ...
};

/// In this order:
/// touching      the eleven ways of two boxes to share something, as they are, then turned
/// cubes         two cubes at random angles
/// tetrahedra    two that share a corner, an edge or a face
/// grids         flat slabs of many squares, turned by 1e-4 to 1e-16
/// balls         a ball and its copy, moved by 1e-3 to an ulp
/// sizes         from 1e-30 to 1e30
/// offsets       1 to 1e9 away from the origin
/// menger        cubes without rods, turned; each eighth of level 2, as it is
/// pencils       wedges about one edge
/// bricks        a dozen to thirty boxes of whole sizes on a lattice, all turned alike
/// noise         layers whose tops differ by noise of 1 to 2^-45
/// plates        thin ones, 1 to 2^-50, turned by up to 2^-30 against each other
/// copies        balls moved corner by corner by 2^-20 to 2^-53
/// ulps          boxes in a row, turned by some ulps
/// heaps         operands that overlap themselves, corners off by an ulp
[[nodiscard]] std::span<const solid_family> solid_families();

/// An axis of any direction.
[[nodiscard]] tf::point3 random_axis(random& source);

}  // namespace test
