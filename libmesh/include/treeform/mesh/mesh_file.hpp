#pragma once
/// \file
/// What a mesh file holds, as stored.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/export.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform {

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

}  // namespace treeform
