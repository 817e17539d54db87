#pragma once
/// \file
/// The meshes of a glTF, each with coordinates of its own.

#include <libmesh/io/bytes_gltf.hpp>
#include <libmesh/io/model_gltf.hpp>
#include <treeform/mesh/attributes.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace treeform::detail::io {

/// Triangles of a mesh, or points without any. Primitives whose attributes are the same accessors
/// share their points.
struct shape_gltf {
    const primitive_gltf* primitive = nullptr;
    std::size_t first_point = 0;
    bool adds_points = false;
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// What a mesh amounts to.
struct outline_gltf {
    std::vector<shape_gltf> shapes{};
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// Which attributes points get, over all meshes that are shown, and what of the file is not read.
struct survey_gltf {
    std::uint64_t points = 0;  ///< of each mesh once
    std::uint64_t with_normals = 0;
    std::uint64_t with_texture = 0;
    std::uint64_t with_colors = 0;
    std::optional<scalar_type> color_type{};  ///< float32 where types differ
    bool has_alpha = false;
    std::uint64_t lines = 0;
    std::uint64_t corners_left_over = 0;  ///< after whole triangles
    std::uint64_t without_positions = 0;  ///< primitives
    bool morphs = false;
    std::set<std::string> unread{};  ///< names of attributes
    std::set<std::string> unread_of_faces{};
    std::set<std::size_t> checked{};  ///< accessors whose bytes are there

    [[nodiscard]] std::size_t channels() const { return has_alpha ? 4 : 3; }
};

/// A mesh in its own coordinates, with the attributes that the survey names.
struct local_mesh_gltf {
    std::vector<point3> points{};
    std::vector<face> faces{};
    std::vector<point3> normals{};                ///< [V] or empty
    std::vector<std::array<float, 2>> texture{};  ///< [V] or empty; from the lower left corner
    std::vector<std::byte> colors{};              ///< [V][channels] or empty
    std::vector<std::size_t> materials{};         ///< [F] number from 1; 0: none
};

/// Looks at what the mesh announces, and whether the bytes for that are there; adds to the survey.
///
/// \throws io_error where they are not, and for attributes of types that they cannot have
[[nodiscard]] outline_gltf outline_of(buffers_gltf& buffers, const model_gltf& model,
                                      std::size_t mesh, survey_gltf& survey);

/// \throws io_error naming the first index that is out of range
[[nodiscard]] local_mesh_gltf decode(buffers_gltf& buffers, const model_gltf& model,
                                     std::size_t mesh, const outline_gltf& outline,
                                     const survey_gltf& survey);

}  // namespace treeform::detail::io
