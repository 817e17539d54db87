#pragma once
/// \file
/// The content of a mesh or point file: points, triangles, attributes, parts of a scene. Errors of
/// files.

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

/// Something that a person should know about a file that was read or written.
struct io_warning {
    std::string code;  ///< stable, for scripts: "trailing-bytes", "precision"
    std::string text;  ///< for people
};

/// The content of a file. Points and faces keep the order and the numbers that they have in it:
/// nothing is joined, split, reordered or dropped.
struct mesh_file {
    treeform::mesh mesh{};  ///< polygons are cut into a fan from their first corner
    /// [F] the file's number of the face that each triangle comes from; empty when all faces are
    /// triangles.
    std::vector<std::uint32_t> stored_face{};
    std::size_t stored_faces = 0;  ///< faces in the file
    bool indexed = true;           ///< the format numbers its vertices (STL does not)
    /// float32 when every coordinate is a float32 value, or was one before the transform of its
    /// node.
    precision stored_as = precision::float64;
    std::string format{};  ///< "stl-binary", "ply-ascii", "obj", ...
    std::vector<io_warning> warnings{};
    treeform::attributes attributes{};  ///< everything else that was read
};

/// Makes each triangle a face of its own, for callers who then give each triangle a value. Rows of
/// the element "face" are repeated for the triangles of a polygon, parts are renumbered, and
/// `stored_face` becomes empty.
TREEFORM_API void split_polygons(mesh_file& file);

/// Whether float32 holds every coordinate exactly, or it is NaN or infinite.
[[nodiscard]] TREEFORM_API bool fits_single(std::span<const point3> points);

/// Faces of a mesh that form a body.
struct scene_part {
    std::string name{};                  ///< "object", "object/group", "group" or empty
    std::vector<std::uint32_t> faces{};  ///< ascending
    std::optional<box3> box{};           ///< of their corners that are finite
};

/// The parts of `mesh`, in the order of their first faces. Each face is in exactly one part.
///
/// Faces with the same object and group are one part, whatever their material. Parts with a point
/// in common are patches of one surface, and so are one part, with the name of the first. Nodes of
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
    mesh_view mesh, std::span<const part> names, std::span<const std::uint32_t> number = {});

}  // namespace treeform
