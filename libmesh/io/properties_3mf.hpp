#pragma once
/// \file
/// Materials, colors and texture coordinates of a 3MF model part.

#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/xml_part.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace treeform::detail::io {

/// A resource whose entries triangles refer to by number.
struct property_group_3mf {
    std::uint32_t count = 0;
    std::optional<std::uint32_t> first_color{};     ///< in the palette of the model
    std::optional<std::uint32_t> first_material{};  ///< in its materials
    std::optional<std::uint32_t> first_texture{};   ///< in its texture coordinates
};

/// By their numbers in the part.
using property_groups_3mf = std::map<std::uint32_t, property_group_3mf>;

/// Base materials, a group of colors or of texture coordinates, whose entries are appended to those
/// of the model. Mixtures of these are known by name only: they have no count. None for a resource
/// that is no group.
///
/// \throws io_error
[[nodiscard]] std::optional<property_group_3mf> read_property_group(const xml_part& part,
                                                                    pugi::xml_node resource,
                                                                    model_3mf& model);

/// Gives the triangles of an object what they refer to.
class triangle_properties {
  public:
    /// \throws io_error when the object refers to what is not there
    triangle_properties(const xml_part& part, const property_groups_3mf& groups,
                        pugi::xml_node object, object_3mf& to, unread_3mf& unread);

    /// For the triangle that was appended last.
    void add(pugi::xml_node triangle);

  private:
    [[nodiscard]] const property_group_3mf* find(pugi::xml_node user) const;
    void check(pugi::xml_node user, const property_group_3mf& group, std::uint32_t index) const;
    void set(const property_group_3mf& group, const face& indices);

    const xml_part& part_;
    const property_groups_3mf& groups_;
    object_3mf& to_;
    unread_3mf& unread_;
    const property_group_3mf* group_of_object_ = nullptr;
    std::optional<std::uint32_t> index_of_object_{};
};

}  // namespace treeform::detail::io
