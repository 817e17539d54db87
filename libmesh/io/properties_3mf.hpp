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

/// A resource to whose entries triangles refer by number.
struct property_group_3mf {
    std::uint32_t count = 0;
    std::optional<std::uint32_t> first_color{};     ///< number in the palette of the model
    std::optional<std::uint32_t> first_material{};  ///< number in its materials
    std::optional<std::uint32_t> first_texture{};   ///< number in its texture coordinates
};

/// Groups by id in the part.
using property_groups_3mf = std::map<std::uint32_t, property_group_3mf>;

/// Reads base materials, or a group of colors or texture coordinates, and appends its entries to
/// those of the model. Mixtures have no entries: their count is 0. None if the resource is not a
/// group.
///
/// \throws io_error
[[nodiscard]] std::optional<property_group_3mf> read_property_group(const xml_part& part,
                                                                    pugi::xml_node resource,
                                                                    model_3mf& model);

/// Sets the properties to which the triangles of an object refer.
class triangle_properties {
  public:
    /// \throws io_error if the object refers to a missing group
    triangle_properties(const xml_part& part, const property_groups_3mf& groups,
                        pugi::xml_node object, object_3mf& to, unread_3mf& unread);

    /// Adds the properties of the triangle that was appended last.
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
