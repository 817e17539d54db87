#pragma once
/// \file
/// Faces of a file in the colors of what they meet.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/placement.hpp>
#include <treeform/tree/export.hpp>

#include <span>

namespace treeform {

struct contact_color_options {
    /// A picture: each triangle becomes a face of its own. Otherwise polygons stay, and have the
    /// gravest class of their triangles.
    bool split_polygons = false;
    bool keep_colors = false;  ///< where the file has some
};

/// Gives the rows of the element "face" of `file` (of a cloud, "vertex") the property tf_class, a
/// number of `contact_class`, and the colors red, green and blue: gray for none, red for
/// penetrating, yellow for touching, cyan for near.
///
/// `classes` is by triangle of `file.mesh`, of a cloud by point.
///
/// \throws std::invalid_argument for another number of classes
/// \cost   O(F)
TREEFORM_API void color_contacts(mesh_file& file, std::span<const contact_class> classes,
                                 const contact_color_options& options = {});

}  // namespace treeform
