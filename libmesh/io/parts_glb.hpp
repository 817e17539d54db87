#pragma once
/// \file
/// Divides a mesh for GLB: nodes by name, primitives by color, vertices with one value of each
/// attribute.

#include <libmesh/io/writers.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace treeform::detail::io {

using color_glb = std::array<double, 4>;

/// Triangles of one color, in the order of the mesh.
struct primitive_glb {
    std::size_t material = 0;
    std::vector<std::uint32_t> triangles{};
};

/// A point, and rows of `corner_values`, or `corner_values::none`.
struct vertex_glb {
    std::uint32_t point = 0;
    std::uint32_t texture = corner_values::none;
    std::uint32_t normal = corner_values::none;

    friend auto operator<=>(const vertex_glb&, const vertex_glb&) = default;
};

/// Consecutive faces of one object and group.
struct part_glb {
    std::string name{};
    std::vector<primitive_glb> primitives{};
    std::vector<vertex_glb> vertices{};  ///< ascending by point
    std::vector<face> faces{};           ///< by numbers in `vertices`; primitive after primitive
};

struct layout_glb {
    std::vector<color_glb> materials{};  ///< in the order of first use
    bool has_colors = false;             ///< if false, there is one material, without a color
    std::vector<part_glb> parts{};
};

/// If faces have no names, one part with all points; else parts with the points that they use. Adds
/// warnings if colors or points are omitted.
[[nodiscard]] layout_glb lay_out(const write_job& job);

/// The attributes of vertices besides positions.
class attributes_glb {
  public:
    explicit attributes_glb(const write_job& job);

    /// How many vertices of the part have a normal that has a length, and texture coordinates.
    [[nodiscard]] std::size_t count_normals(const part_glb& part) const;
    [[nodiscard]] std::size_t count_texture(const part_glb& part) const;
    [[nodiscard]] bool has_colors() const { return !colors_.empty(); }

    /// Of length 1.
    [[nodiscard]] std::array<float, 3> normal(const vertex_glb& v) const;
    /// The texture coordinates, with v from the upper edge; 0 0 if there are none.
    [[nodiscard]] std::array<float, 2> texture(const vertex_glb& v) const;

    [[nodiscard]] const std::vector<const column*>& colors() const { return colors_; }
    /// uint8 or uint16 if all columns have this type, else float32.
    [[nodiscard]] scalar_type color_type() const { return color_type_; }
    /// The value of a color column, from 0 to 1.
    [[nodiscard]] static double color_share(const column& c, std::size_t row);

    /// Names of columns of points that GLB cannot store.
    [[nodiscard]] std::vector<std::string> left_out() const;

  private:
    [[nodiscard]] point3 stored_normal(const vertex_glb& v) const;
    [[nodiscard]] std::array<double, 2> stored_texture(const vertex_glb& v) const;

    const mesh_file& file_;
    const element* vertices_;
    std::vector<const column*> normals_{};
    std::vector<const column*> texture_{};
    std::vector<const column*> colors_{};
    scalar_type color_type_ = scalar_type::float32;
};

}  // namespace treeform::detail::io
