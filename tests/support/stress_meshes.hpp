#pragma once
/// \file
/// Meshes that are hard to decide about: the families of hard pairs at any size.

#include <treeform/mesh/mesh.hpp>

#include <support/stress_families.hpp>

#include <cstddef>
#include <cstdint>

namespace treeform::test {

/// A mesh of the family with about `faces` faces: from a third of that to all, and at least one.
/// About unit size at the origin except for the families that say otherwise; all coordinates
/// finite. Its faces meet others of it, but each only few, however many there are; around the
/// corners of `fans` any number shares it. The same bytes on every machine.
[[nodiscard]] mesh stress_mesh(stress_family family, std::size_t faces, std::uint64_t seed);

}  // namespace treeform::test
