#pragma once
/// \file
/// What a file holds: points, triangles, attributes, the parts of a scene; and how reading fails.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace treeform {

/// A file that cannot be read or written; `what()` names the path, the line or byte, and the
/// reason: "part.obj:17: vertex index 0 (OBJ counts from 1)".
class TREEFORM_API io_error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

struct io_warning {
    std::string code;  ///< stable, for scripts: "trailing-bytes", "precision"
    std::string text;  ///< for people
};

/// The contents of a file. Points and faces keep the order and the numbers they have in it:
/// nothing is joined, split, reordered or dropped.
struct mesh_file {
    treeform::mesh mesh{};  ///< polygons are cut into a fan from their first corner
    /// [F] number in the file of the face each triangle comes from; empty when each face is one
    /// triangle.
    std::vector<std::uint32_t> stored_face{};
    std::size_t stored_faces = 0;  ///< faces in the file
    bool indexed = true;           ///< the format numbers its vertices (STL does not)
    /// float32: every coordinate is a float32 value, or was one before the transform of its node.
    precision stored_as = precision::float64;
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    std::vector<io_warning> warnings{};
    treeform::attributes attributes{};  ///< everything else that was read; see there
};

/// Makes each triangle a face of its own: rows of the element "face" are repeated for the triangles
/// of a polygon, parts are renumbered, `stored_face` becomes empty. For callers who then give each
/// triangle a value of its own.
TREEFORM_API void split_polygons(mesh_file& file);

/// True when float32 holds every coordinate exactly; NaN and infinity count as held.
[[nodiscard]] TREEFORM_API bool fits_single(std::span<const point3> points);

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
/// a scene are parts where they have been placed: `read` has applied their transforms.
///
/// `number` is [F], the number in the file of each face, ascending, or empty where that is its
/// number in `mesh`; faces before the first of `names` have no name.
///
/// \pre    equal corners have been joined, or else parts that touch stay apart
/// \throws std::invalid_argument for a `number` of another length, or naming the lowest face with a
///         corner out of range
/// \cost   O(F + P log P) for P of `names`
[[nodiscard]] TREEFORM_API std::vector<scene_part> scene_parts(
    mesh_view mesh, std::span<const part> names, std::span<const std::uint32_t> number = {});

}  // namespace treeform
