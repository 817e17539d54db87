#pragma once
/// \file
/// The bodies of a scene: what a file puts under names of its own.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/bounding_box.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// Some faces of a mesh that are a body by themselves.
struct scene_part {
    std::string name{};                  ///< "object", "object/group", "group" or empty
    std::vector<std::uint32_t> faces{};  ///< ascending
    std::optional<box3> box{};           ///< of their corners that are finite
};

/// The parts of `mesh` in the order of their first faces: each face is in one of them.
///
/// Faces with the same object and group are one part, whatever their material, and so are parts
/// with a point in common, which are patches of one surface; it has the name of the first. Nodes of
/// a scene are parts where they have been placed: `read_mesh` has applied their transforms.
///
/// `number` is [F], the number in the file of each face, ascending, or empty where that is its
/// number in `mesh`; faces before the first of `names` have no name.
///
/// \pre    equal corners have been joined, or else parts that touch stay apart
/// \throws std::invalid_argument for a `number` of another length, or naming the lowest face with a
///         corner that is no point
/// \cost   O(F + P log P) for P of `names`
[[nodiscard]] TREEFORM_API std::vector<scene_part> scene_parts(
    mesh_view mesh, std::span<const part> names, std::span<const std::uint32_t> number = {});

}  // namespace treeform
