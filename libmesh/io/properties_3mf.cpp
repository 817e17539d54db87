#include <libmesh/io/properties_3mf.hpp>
#include <treeform/mesh/attributes.hpp>

#include <charconv>
#include <string>
#include <string_view>

namespace treeform::detail::io {

namespace {

constexpr std::size_t longest_name = 1024;

[[nodiscard]] std::uint32_t size_of_list(std::size_t size) {
    return static_cast<std::uint32_t>(size);
}

/// "#RRGGBB" or "#RRGGBBAA".
[[nodiscard]] std::uint32_t color_of(const xml_part& part, pugi::xml_node element,
                                     const char* attribute) {
    const std::string_view text = part.required(element, attribute);
    std::uint32_t value = 0;
    if (text.starts_with('#') && (text.size() == 7 || text.size() == 9)) {
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + 1, end, value, 16);
        if (stop == end && error == std::errc())
            return text.size() == 9 ? value : value << 8 | 0xffU;
    }
    part.fail(element, std::string(attribute) + " is not a color #RRGGBB or #RRGGBBAA");
}

/// Calls f(entry) for each child of that name, and returns how many there were.
template <class F>
[[nodiscard]] std::uint32_t for_each_entry(pugi::xml_node group, const std::string& name, F&& f) {
    std::uint32_t count = 0;
    for (const pugi::xml_node entry : group.children(name.c_str())) {
        f(entry);
        ++count;
    }
    return count;
}

[[nodiscard]] property_group_3mf read_base_materials(const xml_part& part, pugi::xml_node group,
                                                     model_3mf& model) {
    property_group_3mf read{.first_color = size_of_list(model.palette.size()),
                            .first_material = size_of_list(model.materials.size())};
    const std::string name = std::string(prefix_of(group.name())) + "base";
    read.count = for_each_entry(group, name, [&](pugi::xml_node base) {
        std::string material = part.required(base, "name");
        if (material.size() > longest_name) part.fail(base, "has a name that is too long");
        model.palette.push_back(color_of(part, base, "displaycolor"));
        model.materials.push_back(std::move(material));
    });
    return read;
}

[[nodiscard]] property_group_3mf read_colors(const xml_part& part, pugi::xml_node group,
                                             model_3mf& model) {
    property_group_3mf read{.first_color = size_of_list(model.palette.size())};
    const std::string name = std::string(prefix_of(group.name())) + "color";
    read.count = for_each_entry(group, name, [&](pugi::xml_node color) {
        model.palette.push_back(color_of(part, color, "color"));
    });
    return read;
}

[[nodiscard]] property_group_3mf read_texture(const xml_part& part, pugi::xml_node group,
                                              model_3mf& model) {
    property_group_3mf read{.first_texture = size_of_list(model.texture.size())};
    const std::string name = std::string(prefix_of(group.name())) + "tex2coord";
    read.count = for_each_entry(group, name, [&](pugi::xml_node place) {
        model.texture.push_back({part.number(place, "u"), part.number(place, "v"), 0.0});
    });
    model.unread.images = true;
    return read;
}

}  // namespace

std::optional<property_group_3mf> read_property_group(const xml_part& part, pugi::xml_node resource,
                                                      model_3mf& model) {
    const std::string_view kind = local_name(resource.name());
    const std::string_view space = namespace_of(resource, prefix_of(resource.name()));
    if (space == core_3mf && kind == "basematerials")
        return read_base_materials(part, resource, model);
    if (space != materials_3mf) return std::nullopt;
    if (kind == "colorgroup") return read_colors(part, resource, model);
    if (kind == "texture2dgroup") return read_texture(part, resource, model);
    if (kind == "compositematerials" || kind == "multiproperties") return property_group_3mf{};
    return std::nullopt;
}

triangle_properties::triangle_properties(const xml_part& part, const property_groups_3mf& groups,
                                         pugi::xml_node object, object_3mf& to, unread_3mf& unread)
    : part_(part), groups_(groups), to_(to), unread_(unread) {
    group_of_object_ = find(object);
    if (group_of_object_ == nullptr) return;
    index_of_object_ = part.optional_integer(object, "pindex");
    if (index_of_object_) check(object, *group_of_object_, *index_of_object_);
}

void triangle_properties::add(pugi::xml_node triangle) {
    const property_group_3mf* group = find(triangle);
    const std::optional<std::uint32_t> first = part_.optional_integer(triangle, "p1");
    if (group != nullptr && !first) part_.fail(triangle, "has a pid but no p1");
    if (group == nullptr) group = group_of_object_;
    if (group == nullptr) return;
    face indices{};
    if (first) {
        indices = {*first, part_.optional_integer(triangle, "p2").value_or(*first),
                   part_.optional_integer(triangle, "p3").value_or(*first)};
        for (const std::uint32_t index : indices) check(triangle, *group, index);
    } else if (index_of_object_) {
        indices.fill(*index_of_object_);
    } else {
        return;
    }
    set(*group, indices);
}

const property_group_3mf* triangle_properties::find(pugi::xml_node user) const {
    const std::optional<std::uint32_t> id = part_.optional_integer(user, "pid");
    if (!id) return nullptr;
    const auto found = groups_.find(*id);
    if (found == groups_.end())
        part_.fail(user, "pid=" + std::to_string(*id) + " is not a property group");
    return &found->second;
}

void triangle_properties::check(pugi::xml_node user, const property_group_3mf& group,
                                std::uint32_t index) const {
    const bool mixture = !group.first_color && !group.first_texture;
    if (!mixture && index >= group.count)
        part_.fail(user, "property " + std::to_string(index) + " is out of range: its group has " +
                             std::to_string(group.count));
}

void triangle_properties::set(const property_group_3mf& group, const face& indices) {
    const std::size_t last = to_.faces.size() - 1;
    const auto shifted = [&](std::uint32_t first) {
        return face{first + indices[0], first + indices[1], first + indices[2]};
    };
    if (group.first_color) {
        to_.colors.resize(last, face{});
        to_.colors.push_back(shifted(*group.first_color));
    }
    if (group.first_material) {
        to_.materials.resize(last, 0);
        to_.materials.push_back(*group.first_material + indices[0]);
    }
    if (group.first_texture) {
        constexpr std::uint32_t none = corner_values::none;
        to_.texture.resize(last, face{none, none, none});
        to_.texture.push_back(shifted(*group.first_texture));
    }
    if (!group.first_color && !group.first_texture) ++unread_.property_uses;
}

}  // namespace treeform::detail::io
