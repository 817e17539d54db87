#pragma once
/// \file
/// A file's mesh made ready to be placed.

#include "tools/common/run.hpp"
#include <treeform/mesh/bounding_box.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/mesh/mesh_file.hpp>
#include <treeform/mesh/still_part.hpp>
#include <treeform/tf.hpp>
#include <treeform/tree/transform.hpp>
#include <treeform/tree/tree.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// A file's mesh, or a part of it, or a cloud. Faces of `mesh` are finite triangles of the file;
/// equal corners are one point in it. Those of a cloud are its finite points, and so are what is
/// called triangles and stored faces here.
struct body {
    std::string path{};
    std::string part{};  ///< its name; empty where the file has no other
    /// As read, or as moved by --start; the parts of a file share it.
    std::shared_ptr<tf::mesh_file> file = std::make_shared<tf::mesh_file>();
    std::size_t file_number = 0;  ///< among the fixed files
    tf::mesh mesh{};              ///< only points that its faces use
    bool cloud = false;
    std::vector<std::uint32_t> triangle_of_face{};  ///< in the file's mesh; empty: the same
    std::optional<tf::box3> box{};                  ///< of `mesh`
    std::uint64_t non_finite = 0;                   ///< triangles of the file left out, or points
    std::unique_ptr<tf::tree<3>> tree{};            ///< made when first asked for
    /// A part that nothing has asked for yet: `mesh` will be these faces of that mesh.
    std::shared_ptr<const tf::mesh> whole{};
    std::vector<std::uint32_t> faces_of_whole{};

    [[nodiscard]] std::uint32_t triangle(std::uint32_t face) const {
        return triangle_of_face.empty() ? face : triangle_of_face[face];
    }
    /// The number in the file.
    [[nodiscard]] std::uint32_t stored_face(std::uint32_t face) const {
        const std::uint32_t t = triangle(face);
        return file->stored_face.empty() ? t : file->stored_face[t];
    }
    [[nodiscard]] std::size_t face_count() const {
        return whole ? faces_of_whole.size() : mesh.faces.size();
    }
    /// Makes `mesh` and `tree`. \pre called before anything else looks at the `mesh` of a part
    [[nodiscard]] tf::still_part still();
    [[nodiscard]] const tf::tree<3>& faces() { return *still().faces; }
    [[nodiscard]] std::string name() const;   ///< of the file, without folders
    [[nodiscard]] std::string label() const;  ///< for people: the path, and the part
};

/// `file` made ready; what is left out is said by `work`.
/// \throws failure (bad_input) when there is nothing to place
[[nodiscard]] body make_body(job& work, const std::string& path, tf::mesh_file file);

/// The parts of `file` as `tf::scene_parts` has them, each a body; the file itself where it has
/// one. \throws failure as `make_body`
[[nodiscard]] std::vector<body> make_parts(job& work, const std::string& path, tf::mesh_file file);

/// Gives the points of `b.file` that faces use, of a cloud those that are finite, the places of
/// `placed`, which is by the points of `b.mesh`; all others are moved by `matrix`, and rounded to
/// float32 if `to_single`.
void take_places(body& b, const std::vector<tf::point3>& placed, const tf::transform<3>& matrix,
                 bool to_single);

/// Rounds every point of the file to float32; how far a coordinate has moved at most.
double round_to_single(tf::mesh_file& file);

}  // namespace tools
