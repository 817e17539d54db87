#pragma once
/// \file
/// The parsed JSON of a glTF. All indices are in range; counts and byte offsets are as in the file,
/// unchecked.

#include <libmesh/io/source.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/mesh.hpp>
#include <treeform/tree/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string_view>
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

/// Whether the quaternion can be normalized.
[[nodiscard]] bool is_rotation(const std::array<double, 4>& quaternion);
/// The transform that applies the scale, then the rotation by a quaternion x, y, z, w of any
/// length, then the translation.
///
/// \pre is_rotation(rotation)
[[nodiscard]] transform<3> transform_of(const point3& translation,
                                        const std::array<double, 4>& rotation, const point3& scale);

/// Accessors of EXT_mesh_gpu_instancing.
struct instances_gltf {
    std::optional<std::size_t> translation{};
    std::optional<std::size_t> rotation{};
    std::optional<std::size_t> scale{};
};

struct node_gltf {
    std::string name{};
    treeform::transform<3> transform{};
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

/// Reads what matters of the JSON of glTF 2.0; of 1.0, whether told so or found, nothing. Materials
/// count only for the texture coordinates that they use; cameras, lights, images, animations and
/// what `extras` hold are not looked at.
///
/// \throws io_error naming the byte, or the entry, as "accessors[3].count"; for values of a wrong
///         type, indices out of range, versions other than 1 and 2, and required extensions, except
///         for supported ones and those that only change how a surface looks
[[nodiscard]] model_gltf parse_gltf(const source& in, std::string_view json, bool is_version_1);

}  // namespace treeform::detail::io
