#pragma once
/// \file
/// Volumes in rational numbers.

#include <libmesh/mesh.hpp>

#include <gmpxx.h>

#include <array>

namespace tf::bench {

/// Six times the signed volume of the cone from the origin over a triangle.
[[nodiscard]] mpq_class six_volumes(const std::array<mpq_class, 3>& a,
                                    const std::array<mpq_class, 3>& b,
                                    const std::array<mpq_class, 3>& c);

/// The volume inside a closed mesh of doubles, without any error.
[[nodiscard]] mpq_class exact_volume(mesh_view mesh);

}  // namespace tf::bench
