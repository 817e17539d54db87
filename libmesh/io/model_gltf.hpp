#pragma once
/// \file
/// What the JSON of a glTF says, before it becomes one mesh. All numbers that name something are in
/// range; counts and offsets in bytes are as the file has them.

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
    std::uint64_t stride = 0;   ///< 0: elements follow each other
    std::string compression{};  ///< the extension that its bytes need, if any
};

/// Where the values of a sparse accessor differ from those below.
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

/// What of a material matters here: its color, and which texture coordinates that takes, and how.
struct material_gltf {
    std::optional<std::array<double, 4>> color{};  ///< linear
    std::size_t texture_set = 0;
    std::optional<texture_transform_gltf> transform{};
};

/// A view of packed values, and the numbers that attributes have there.
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
    std::set<std::string> face_properties{};  ///< names in `extras`, as treeform writes them
    std::optional<draco_gltf> draco{};        ///< where KHR_draco_mesh_compression has its values
};

struct mesh_gltf {
    std::string name{};
    std::vector<primitive_gltf> primitives{};
};

/// A place in the scene, row by row.
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
/// A normal as the transform's surface has it: of length 1, or 0.
[[nodiscard]] point3 turned(const transform_gltf& t, const point3& normal);
/// Whether it has a length to divide by.
[[nodiscard]] bool is_rotation(const std::array<double, 4>& quaternion);
/// First the scale, then the rotation by a quaternion x, y, z, w of any length, then the
/// translation.
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
    std::vector<std::size_t> roots{};  ///< nodes of the scene
    std::size_t scenes = 0;
    bool has_textures = false;  ///< of materials
    bool is_version_1 = false;  ///< glTF 1.0, of which nothing was parsed
};

}  // namespace treeform::detail::io
