#pragma once
/// \file
/// Makes meshes of files, ready for every operation: drops unusable faces, joins equal points,
/// joins several files.

#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tree/detail/export.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace treeform {

/// A mesh without NaN or infinite coordinates, and the file's number of each face.
struct usable_mesh {
    treeform::mesh mesh{};
    /// [F] the file's triangle that each face is; empty: numbers are the same.
    std::vector<std::uint32_t> triangle_of_face{};
    /// [triangles] the file's face that each triangle is part of; empty: numbers are the same.
    std::vector<std::uint32_t> stored_face{};
    std::uint64_t dropped = 0;  ///< triangles with a coordinate that is not finite

    /// The number that face `f` has in the file.
    [[nodiscard]] std::uint32_t face_in_file(std::uint32_t f) const {
        const std::uint32_t t = triangle_of_face.empty() ? f : triangle_of_face[f];
        return stored_face.empty() ? t : stored_face[t];
    }
    operator mesh_view() const { return mesh; }  // NOLINT: meant to be implicit
};

/// The mesh of `file`. Triangles with a NaN or infinite coordinate are left out. Corners with equal
/// coordinates become one vertex. Vertices keep the numbers of the file; of equal ones, faces use
/// the lowest. Coordinates that are not finite become 0; no face uses them.
///
/// \throws std::invalid_argument naming a face with a corner that is no vertex
/// \cost   O(V + F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API usable_mesh as_mesh(mesh_file file);

/// Removes the faces of `mesh` with a corner that is not finite or out of range. Returns the old
/// number of each face that stays [F]; empty when all stay.
TREEFORM_API std::vector<std::uint32_t> drop_unusable_faces(mesh& mesh);

/// One file with the points and faces of all `files`, one after the other, in the format of the
/// first.
///
/// Columns of "vertex" and "face" are matched by name. Where a file lacks a column, its rows get
/// NaN, 0 or empty lists. Types are widened until they hold every value. Corners keep their texture
/// coordinates, normals and texture files. Other elements are left out (warning "left-out").
/// `names` has one name for each file, for the warnings.
///
/// \throws std::invalid_argument when a column holds lists in one file and single values in
///         another, when no type holds all values, or when there is not one name for each file;
///         std::length_error for more points or triangles than 32 bits can number
/// \cost   O(size of all files)
[[nodiscard]] TREEFORM_API mesh_file join(std::vector<mesh_file> files,
                                          std::span<const std::string> names);

/// Which points have equal coordinates.
struct equal_points {
    std::vector<std::uint32_t> new_of_old;    ///< [V] number of the distinct point each one is
    std::vector<std::uint32_t> first_of_new;  ///< [U] lowest-numbered point of each, ascending
};

/// Finds the points whose coordinates are equal as doubles (-0 equals +0).
///
/// Distinct points are numbered in the order in which they first appear. Points that differ in one
/// bit stay distinct, however close they are (only -0 and +0 are equal). An infinity equals itself.
/// A point with a NaN coordinate equals no other, not even a copy of itself.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points
/// \cost   O(V) expected time, also when all points are equal; about 12 bytes a point besides the
///         result's `first_of_new`
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API equal_points find_equal_points(points_view points);

/// `mesh` with equal points joined. Points are in the order in which they first appear, with the
/// coordinates of the first, bit for bit. Nothing is dropped: faces keep their order, even those
/// that now repeat a corner, and points that no face uses stay.
///
/// \throws std::invalid_argument for more than 2^32 - 1 points, or naming the lowest face with a
///         corner out of range
/// \cost   as `find_equal_points`, and O(F)
/// \same   on any number of threads
[[nodiscard]] TREEFORM_API mesh join_equal_points(mesh_view mesh);

}  // namespace treeform
