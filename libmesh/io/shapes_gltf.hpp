#pragma once
/// \file
/// Decodes the meshes of a glTF, each in its own coordinates.

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

/// A primitive of a mesh, with triangles or only points. Primitives with the same attribute
/// accessors share their points.
struct shape_gltf {
    const primitive_gltf* primitive = nullptr;
    std::size_t first_point = 0;
    bool adds_points = false;
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// The sizes of a mesh.
struct outline_gltf {
    std::vector<shape_gltf> shapes{};
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
};

/// The attributes of points over all used meshes, and counts of content that is not read.
struct survey_gltf {
    std::uint64_t points = 0;  ///< counted once for each mesh
    std::uint64_t with_normals = 0;
    std::uint64_t with_texture = 0;
    std::uint64_t with_colors = 0;
    std::optional<scalar_type> color_type{};  ///< float32 if types differ
    bool has_alpha = false;
    std::uint64_t lines = 0;
    std::uint64_t corners_left_over = 0;  ///< corners left over after whole triangles
    std::uint64_t without_positions = 0;  ///< number of primitives without positions
    bool morphs = false;
    std::set<std::string> unread{};  ///< names of attributes that are not read
    std::set<std::string> unread_of_faces{};
    std::set<std::size_t> checked{};  ///< accessors whose bytes were checked

    [[nodiscard]] std::size_t channels() const { return has_alpha ? 4 : 3; }
};

/// A mesh in its own coordinates, with the attributes in the survey.
struct local_mesh_gltf {
    std::vector<point3> points{};
    std::vector<face> faces{};
    std::vector<point3> normals{};  ///< [V] or empty
    /// [V] or empty; with the origin at the lower left corner
    std::vector<std::array<float, 2>> texture{};
    std::vector<std::byte> colors{};       ///< [V][channels] or empty
    std::vector<std::size_t> materials{};  ///< [F] number of the material, from 1; 0: none
};

/// Counts the content of a mesh, checks that its bytes exist, and adds to the survey.
///
/// \throws io_error where they are not, and for attributes of types that they cannot have
[[nodiscard]] outline_gltf outline_of(buffers_gltf& buffers, std::size_t mesh, survey_gltf& survey);

/// \throws io_error naming the first index that is out of range
[[nodiscard]] local_mesh_gltf decode(buffers_gltf& buffers, std::size_t mesh,
                                     const outline_gltf& outline, const survey_gltf& survey);

}  // namespace treeform::detail::io
