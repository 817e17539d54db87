#pragma once
/// \file
/// The named parts of a scene.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// Faces of a mesh that form a body.
struct scene_part {
    std::string name{};                  ///< as of `part_name`
    std::vector<std::uint32_t> faces{};  ///< ascending
    std::optional<box3> box{};           ///< of their corners that are finite
};

/// "object", "object/group", "group" or empty.
[[nodiscard]] inline std::string part_name(const named_faces& p) {
    return p.object.empty() || p.group.empty() ? p.object + p.group : p.object + "/" + p.group;
}

/// The parts of `mesh`, in the order of their first faces. Each face is in exactly one part.
///
/// Faces with the same object and group are one part, whatever their material. With
/// `joined_at_points`, parts with a point in common are patches of one surface, and so are one
/// part, with the name of the first. Nodes of
/// a scene are parts; `read` has already applied their transforms.
///
/// `number` is [F], the file's number of each face, ascending; or empty when that is its number in
/// `mesh`. Faces before the first of `names` have no name.
///
/// \pre    equal corners have been joined; otherwise parts that touch stay separate
/// \throws std::invalid_argument for a `number` of another length, or naming the lowest face with a
///         corner out of range
/// \cost   O(F + P log P) for P of `names`
[[nodiscard]] TREEFORM_API std::vector<scene_part> scene_parts(
    mesh_view mesh, std::span<const named_faces> names, std::span<const std::uint32_t> number = {},
    bool joined_at_points = true);

}  // namespace treeform
