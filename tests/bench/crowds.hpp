#pragma once
/// \file
/// Crowds of solids for set operations of many operands, the same in every run.

#include <treeform/mesh/mesh.hpp>
#include <treeform/tf.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace treeform::bench {

using meshes = std::vector<mesh>;
/// Solids that are made when somebody asks, and gone with the last who holds them.
using crowd = std::function<std::shared_ptr<const meshes>()>;
[[nodiscard]] crowd crowd_of(std::function<meshes()> make);

enum class poles { joined, apart };

/// 960 faces each, of radius 0.5 to 1, in a cube of side 4. With their poles apart they are open:
/// of the corners of faces at the lower pole, the rounded sine of pi leaves no two equal.
[[nodiscard]] meshes spheres(std::size_t count, poles poles);

/// `models` in turn, scaled to a size of 1 to 2, turned at random, in a cube of side 4; every tenth
/// is inside out: as an operand it is as solid as others, in one mesh it takes away from them.
[[nodiscard]] meshes copies(const meshes& models, std::size_t count);

/// Trefoil knots about one middle, each turned at random: tubes of 1,000 faces, so thick that they
/// meet themselves.
[[nodiscard]] meshes torus_knots(std::size_t count);

/// A plate, and then side * side cylinders of 64 sides that go through it.
[[nodiscard]] meshes plate_and_cylinders(std::size_t side);

/// x * y * z cubes of side 1, each face to face with its neighbors.
[[nodiscard]] meshes touching_cubes(std::size_t x, std::size_t y, std::size_t z);

/// Cubes with sides 0.03 to 0.1, turned at random, in a cube of side 1.
[[nodiscard]] meshes random_cubes(std::size_t count);

/// All as one mesh, one after the other.
[[nodiscard]] mesh in_one_mesh(const meshes& solids);

}  // namespace treeform::bench
