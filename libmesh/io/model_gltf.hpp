#pragma once
/// \file
/// The parsed JSON of a glTF. All indices are in range; counts and byte offsets are as in the file,
/// unchecked.

#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace treeform::detail::io {

struct buffer_gltf {
    std::optional<std::string> uri{};  ///< none: the binary part of a GLB
    std::uint64_t size = 0;
};

struct view_gltf {
    std::size_t buffer = 0;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::uint64_t stride = 0;   ///< 0: elements are contiguous
    std::string compression{};  ///< name of the extension that compresses its bytes, if any
};

/// The replaced values of a sparse accessor.
struct sparse_gltf {
    std::uint64_t count = 0;
    std::size_t index_view = 0;
    std::uint64_t index_offset = 0;
    scalar_type index_type = scalar_type::uint32;
    std::size_t value_view = 0;
    std::uint64_t value_offset = 0;
};

struct accessor_gltf {
    std::optional<std::size_t> view{};  ///< none: zeros
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
    scalar_type type = scalar_type::float32;
    std::size_t components = 1;  ///< 0: a matrix
    bool normalized = false;
    std::optional<sparse_gltf> sparse{};
};

/// KHR_texture_transform.
struct texture_transform_gltf {
    std::array<double, 2> offset{0, 0};
    double rotation = 0;
    std::array<double, 2> scale{1, 1};
};

/// The used data of a material: its color, and the texture coordinates of its base color.
struct material_gltf {
    std::optional<std::array<double, 4>> color{};  ///< linear
    std::size_t texture_set = 0;
    std::optional<texture_transform_gltf> transform{};
};

/// A view of compressed values, and the ids of attributes in it.
struct draco_gltf {
    std::size_t view = 0;
    std::map<std::string, std::uint32_t> attributes{};
};

struct primitive_gltf {
    std::map<std::string, std::size_t> attributes{};  ///< accessors
    std::optional<std::size_t> indices{};
    std::optional<std::size_t> material{};
    unsigned mode = 4;
    bool morphs = false;
    std::set<std::string> face_properties{};  ///< names in `extras`, as written by treeform
    std::optional<draco_gltf> draco{};        ///< compressed values (KHR_draco_mesh_compression)
};

struct mesh_gltf {
    std::string name{};
    std::vector<primitive_gltf> primitives{};
};

/// An affine transform, row by row.
struct transform_gltf {
    std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    friend bool operator==(const transform_gltf&, const transform_gltf&) = default;
};

/// First `inner`, then `outer`.
[[nodiscard]] transform_gltf compose(const transform_gltf& inner, const transform_gltf& outer);
/// As it is for the identity, -0 included.
[[nodiscard]] point3 moved(const transform_gltf& t, const point3& p);
/// Whether it turns a surface inside out.
[[nodiscard]] bool mirrors(const transform_gltf& t);
/// The transformed normal, of length 1; or 0.
[[nodiscard]] point3 turned(const transform_gltf& t, const point3& normal);
/// Whether the quaternion can be normalized.
[[nodiscard]] bool is_rotation(const std::array<double, 4>& quaternion);
/// The transform that applies the scale, then the rotation by a quaternion x, y, z, w of any
/// length, then the translation.
///
/// \pre is_rotation(rotation)
[[nodiscard]] transform_gltf transform_of(const point3& translation,
                                          const std::array<double, 4>& rotation,
                                          const point3& scale);

/// Accessors of EXT_mesh_gpu_instancing.
struct instances_gltf {
    std::optional<std::size_t> translation{};
    std::optional<std::size_t> rotation{};
    std::optional<std::size_t> scale{};
};

struct node_gltf {
    std::string name{};
    transform_gltf transform{};
    std::optional<std::size_t> mesh{};
    std::optional<instances_gltf> instances{};
    std::vector<std::size_t> children{};
    bool has_skin = false;
};

struct model_gltf {
    std::vector<buffer_gltf> buffers{};
    std::vector<view_gltf> views{};
    std::vector<accessor_gltf> accessors{};
    std::vector<material_gltf> materials{};
    std::vector<mesh_gltf> meshes{};
    std::vector<node_gltf> nodes{};
    std::vector<std::size_t> roots{};  ///< root nodes of the scene
    std::size_t scenes = 0;
    bool has_textures = false;  ///< whether materials have textures
    bool is_version_1 = false;  ///< glTF 1.0, which was not parsed
};

}  // namespace treeform::detail::io
