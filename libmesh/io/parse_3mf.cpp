#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/number.hpp>
#include <libmesh/io/xml_part.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

/// A resource to whose entries triangles refer by number.
struct property_group_3mf {
    std::uint32_t count = 0;
    std::optional<std::uint32_t> first_color{};     ///< number in the palette of the model
    std::optional<std::uint32_t> first_material{};  ///< number in its materials
    std::optional<std::uint32_t> first_texture{};   ///< number in its texture coordinates
};

/// Groups by id in the part.
using property_groups_3mf = std::map<std::uint32_t, property_group_3mf>;

constexpr std::size_t longest_name = 1024;

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

/// Reads base materials, or a group of colors or texture coordinates, and appends its entries to
/// those of the model. Mixtures have no entries: their count is 0. None if the resource is not a
/// group.
///
/// \throws io_error
std::optional<property_group_3mf> read_property_group(const xml_part& part, pugi::xml_node resource,
                                                      model_3mf& model) {
    const std::string_view kind = local_name(resource.name());
    const std::string prefix(prefix_of(resource.name()));
    const std::string_view space = namespace_of(resource, prefix);
    property_group_3mf group;
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    const auto for_each = [&](const char* name, const auto& add) {
        const std::string full = prefix + name;
        for (const pugi::xml_node entry : resource.children(full.c_str())) {
            add(entry);
            ++group.count;
        }
    };
    if (space == core_3mf && kind == "basematerials") {
        group.first_color = size(model.palette);
        group.first_material = size(model.materials);
        for_each("base", [&](pugi::xml_node base) {
            std::string material = part.required(base, "name");
            if (material.size() > longest_name) part.fail(base, "has a name that is too long");
            model.palette.push_back(color_of(part, base, "displaycolor"));
            model.materials.push_back(std::move(material));
        });
        return group;
    }
    if (space != materials_3mf) return std::nullopt;
    if (kind == "colorgroup") {
        group.first_color = size(model.palette);
        for_each("color", [&](pugi::xml_node color) {
            model.palette.push_back(color_of(part, color, "color"));
        });
    } else if (kind == "texture2dgroup") {
        group.first_texture = size(model.texture);
        for_each("tex2coord", [&](pugi::xml_node place) {
            model.texture.push_back({part.number(place, "u"), part.number(place, "v"), 0.0});
        });
        model.unread.images = true;
    } else if (kind != "compositematerials" && kind != "multiproperties") {
        return std::nullopt;
    }
    return group;
}

/// Sets the properties to which the triangles of an object refer.
class triangle_properties {
  public:
    /// \throws io_error if the object refers to a missing group
    triangle_properties(const xml_part& part, const property_groups_3mf& groups,
                        pugi::xml_node object, object_3mf& to, unread_3mf& unread)
        : part_(part), groups_(groups), to_(to), unread_(unread) {
        group_of_object_ = find(object);
        if (group_of_object_ == nullptr) return;
        index_of_object_ = part.optional_integer(object, "pindex").value_or(no_index);
        if (index_of_object_ != no_index) check(object, *group_of_object_, index_of_object_);
    }

    /// Adds the properties of the triangle that was appended last.
    void add(pugi::xml_node triangle) {
        const property_group_3mf* group = find(triangle);
        const std::optional<std::uint32_t> first = part_.optional_integer(triangle, "p1");
        if (group != nullptr && !first) part_.fail(triangle, "has a pid but no p1");
        if (group == nullptr) group = group_of_object_;
        if (group == nullptr || (!first && index_of_object_ == no_index)) return;
        face indices{};
        indices.fill(first.value_or(index_of_object_));
        if (first) {
            indices[1] = part_.optional_integer(triangle, "p2").value_or(*first);
            indices[2] = part_.optional_integer(triangle, "p3").value_or(*first);
            for (const std::uint32_t index : indices) check(triangle, *group, index);
        }
        set(*group, indices);
    }

  private:
    static constexpr std::uint32_t no_index = 0xffffffffU;  ///< numbers of the format have 31 bits

    [[nodiscard]] const property_group_3mf* find(pugi::xml_node user) const {
        const std::optional<std::uint32_t> id = part_.optional_integer(user, "pid");
        if (!id) return nullptr;
        const auto found = groups_.find(*id);
        if (found == groups_.end())
            part_.fail(user, "pid=" + std::to_string(*id) + " is not a property group");
        return &found->second;
    }

    void check(pugi::xml_node user, const property_group_3mf& group, std::uint32_t index) const {
        const bool mixture = !group.first_color && !group.first_texture;
        if (!mixture && index >= group.count)
            part_.fail(user, "property " + std::to_string(index) +
                                 " is out of range: its group has " + std::to_string(group.count));
    }

    void set(const property_group_3mf& group, const face& indices) {
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
            to_.texture.resize(last, no_texture);
            to_.texture.push_back(shifted(*group.first_texture));
        }
        if (!group.first_color && !group.first_texture) ++unread_.property_uses;
    }

    const xml_part& part_;
    const property_groups_3mf& groups_;
    object_3mf& to_;
    unread_3mf& unread_;
    const property_group_3mf* group_of_object_ = nullptr;
    std::uint32_t index_of_object_ = no_index;
};

/// Which objects of which parts are needed. Parts are numbered in the order in which they are
/// named.
struct needed_objects {
    std::vector<std::string> parts{};
    std::deque<std::set<std::uint32_t>> ids{};  ///< stay where they are as parts are added
    std::map<std::string, std::uint32_t, std::less<>> numbers{};

    std::uint32_t number_of(std::string_view path) {
        if (path.starts_with('/')) path.remove_prefix(1);
        const auto found = numbers.find(path);
        if (found != numbers.end()) return found->second;
        const auto number = static_cast<std::uint32_t>(parts.size());
        parts.emplace_back(path);
        ids.emplace_back();
        numbers.emplace(path, number);
        return number;
    }
};

/// Reads one part. The tree of its elements takes several times the memory of what is kept, so
/// there is one at a time.
class part_reader {
  public:
    part_reader(const xml_part& xml, std::uint32_t number, model_3mf& model, needed_objects& needed)
        : xml_(xml),
          number_(number),
          core_(prefix_of(xml.root().name())),
          item_(core_ + "item"),
          component_(core_ + "component"),
          vertex_(core_ + "vertex"),
          triangle_(core_ + "triangle"),
          model_(model),
          needed_(needed) {}

    void read() {
        const pugi::xml_node root = xml_.root();
        if (local_name(root.name()) != "model" || namespace_of(root, core_) != core_3mf)
            xml_.fail(root, "is not the model of a 3MF");
        refuse_unknown_extensions(root);
        index_resources(child(root, "resources"));
        if (number_ == 0) {
            read_unit(root);
            read_build(root);
        }
        read_objects();
    }

  private:
    [[nodiscard]] pugi::xml_node child(pugi::xml_node node, const char* name) const {
        return node.child((core_ + name).c_str());
    }

    void refuse_unknown_extensions(pugi::xml_node root) const {
        std::string_view list = root.attribute("requiredextensions").value();
        while (!list.empty()) {
            const std::size_t size = std::min(list.find_first_of(" \t\r\n"), list.size());
            const std::string prefix(list.substr(0, size));
            list.remove_prefix(std::min(size + 1, list.size()));
            if (prefix.empty()) continue;
            const std::string_view space = namespace_of(root, prefix + ":");
            if (space != core_3mf && space != materials_3mf && space != production_3mf &&
                space != triangle_sets_3mf)
                xml_.fail(root, "requires the extension '" + prefix.substr(0, 40) + "' (" +
                                    std::string(space.substr(0, 120)) +
                                    "), which is not supported");
        }
    }

    void read_unit(pugi::xml_node root) {
        const pugi::xml_attribute unit = root.attribute("unit");
        if (!unit) return;
        const auto found = std::ranges::find(units_3mf, std::string_view(unit.value()));
        if (found == units_3mf.end()) xml_.fail(root, "has a unit that 3MF does not define");
        model_.unit = *found;
    }

    /// Objects wait until they are known to be needed; groups of properties are few and small.
    void index_resources(pugi::xml_node resources) {
        for (const pugi::xml_node resource : resources.children()) {
            if (core_ + "object" == resource.name()) {
                if (!object_of_.emplace(xml_.integer(resource, "id"), resource).second)
                    xml_.fail(resource, "has the id of another object");
            } else if (const auto group = read_property_group(xml_, resource, model_)) {
                if (!groups_.emplace(xml_.integer(resource, "id"), *group).second)
                    xml_.fail(resource, "has the id of another group");
            }
        }
    }

    void read_build(pugi::xml_node root) {
        for (const pugi::xml_node item : child(root, "build").children(item_.c_str())) {
            model_.items.push_back(read_reference(item));
            if (!item.attribute("printable").as_bool(true)) ++model_.unread.not_printable;
        }
    }

    void read_objects() {
        std::set<std::uint32_t>& waiting = needed_.ids[number_];
        std::size_t read = 0;
        for (; !waiting.empty(); ++read) {
            const std::uint32_t id = *waiting.begin();
            waiting.erase(waiting.begin());
            const auto found = object_of_.find(id);
            if (found == object_of_.end())
                xml_.fail("has no object " + std::to_string(id) +
                          ", to which an item or a component of the root model refers");
            read_object(found->second, model_.objects[{number_, id}]);
        }
        if (number_ == 0) model_.unread.not_built = object_of_.size() - read;
    }

    /// An item or a component.
    [[nodiscard]] placed_3mf read_reference(pugi::xml_node user) {
        placed_3mf placed{.object = {number_, xml_.integer(user, "objectid")},
                          .transform = read_transform(user)};
        placed.part_number = name_in(user, "partnumber");
        if (const char* const path = path_of(user)) {
            if (number_ != 0) xml_.fail(user, "has a path, which only the root model may have");
            if (*path != '/') xml_.fail(user, "has a path that does not start with '/'");
            placed.object.part = needed_.number_of(path);
        } else if (!object_of_.contains(placed.object.id)) {
            xml_.fail(user, "objectid=" + std::to_string(placed.object.id) + " is not an object");
        }
        if (!model_.objects.contains(placed.object))
            needed_.ids[placed.object.part].insert(placed.object.id);
        return placed;
    }

    /// The path of the production extension; null when there is none.
    [[nodiscard]] static const char* path_of(pugi::xml_node user) {
        for (const pugi::xml_attribute a : user.attributes())
            if (local_name(a.name()) == "path" && !prefix_of(a.name()).empty() &&
                namespace_of(user, prefix_of(a.name())) == production_3mf)
                return a.value();
        return nullptr;
    }

    [[nodiscard]] transform<3> read_transform(pugi::xml_node user) const {
        transform<3> t;
        const pugi::xml_attribute attribute = user.attribute("transform");
        if (!attribute) return t;
        const char* at = attribute.value();
        const char* const end = at + std::strlen(at);
        const auto skip = [&] {
            while (at < end && is_space(*at)) ++at;
        };
        for (std::size_t n = 0; n < 12; ++n) {
            skip();
            const parsed<double> number = parse_number(at, end);
            if (number.end == nullptr || (number.end < end && !is_space(*number.end)) ||
                !std::isfinite(number.value) || number.hexadecimal)
                xml_.fail(user, "has a transform that is not twelve finite numbers");
            t.rows[n % 3][n / 3] = number.value;
            at = number.end;
        }
        skip();
        if (at != end) xml_.fail(user, "has a transform of more than twelve numbers");
        return t;
    }

    [[nodiscard]] std::string name_in(pugi::xml_node node, const char* attribute) const {
        std::string name = node.attribute(attribute).value();
        if (name.size() > longest_name) xml_.fail(node, "has a name that is too long");
        return name;
    }

    void read_object(pugi::xml_node node, object_3mf& object) {
        object.name = name_in(node, "name");
        if (object.name.empty()) object.name = name_in(node, "partnumber");
        const std::string_view type = node.attribute("type").value();
        object.is_other = type == "other";
        object.is_support = type == "support" || type == "solidsupport";
        if (object.is_other) return;
        const pugi::xml_node mesh = child(node, "mesh");
        const pugi::xml_node components = child(node, "components");
        if (!mesh && !components) xml_.fail(node, "has neither a mesh nor components");
        if (mesh && components) xml_.fail(node, "has both a mesh and components");
        if (mesh) read_mesh(node, mesh, object);
        for (const pugi::xml_node c : components.children(component_.c_str()))
            object.components.push_back(read_reference(c));
    }

    void read_mesh(pugi::xml_node node, pugi::xml_node mesh, object_3mf& object) {
        for (const pugi::xml_node part : mesh.children()) {
            const std::string_view space = namespace_of(part, prefix_of(part.name()));
            if (space != core_3mf && space != triangle_sets_3mf) ++model_.unread.extensions;
        }
        const pugi::xml_node vertices = child(mesh, "vertices");
        const pugi::xml_node triangles = child(mesh, "triangles");
        if (!vertices || !triangles) xml_.fail(mesh, "has no vertices or no triangles");
        for (const pugi::xml_node v : vertices.children(vertex_.c_str()))
            object.points.push_back(
                {xml_.number(v, "x"), xml_.number(v, "y"), xml_.number(v, "z")});
        triangle_properties properties(xml_, groups_, node, object, model_.unread);
        for (const pugi::xml_node t : triangles.children(triangle_.c_str())) {
            face f{};
            constexpr std::array<const char*, 3> names{"v1", "v2", "v3"};
            for (std::size_t k = 0; k < 3; ++k) {
                f[k] = xml_.integer(t, names[k]);
                if (f[k] >= object.points.size())
                    xml_.fail(t, std::string(names[k]) + "=" + std::to_string(f[k]) +
                                     " is out of range: there are " +
                                     std::to_string(object.points.size()) + " vertices");
            }
            object.faces.push_back(f);
            properties.add(t);
        }
        if (!object.colors.empty()) object.colors.resize(object.faces.size());
        if (!object.materials.empty()) object.materials.resize(object.faces.size());
        if (!object.texture.empty()) object.texture.resize(object.faces.size(), no_texture);
    }

    const xml_part& xml_;
    std::uint32_t number_;
    std::string core_;  ///< prefix of the core namespace
    std::string item_;  ///< names of elements with it
    std::string component_;
    std::string vertex_;
    std::string triangle_;
    std::map<std::uint32_t, pugi::xml_node> object_of_{};
    property_groups_3mf groups_{};
    model_3mf& model_;
    needed_objects& needed_;
};

}  // namespace

model_3mf parse_3mf(const source& in, zip_archive& archive, std::string_view root) {
    model_3mf model;
    needed_objects needed;
    (void)needed.number_of(root);
    for (std::uint32_t n = 0; n < needed.parts.size(); ++n) {
        const std::string name = needed.parts[n];
        const xml_part xml(in, name, archive.read(name));
        part_reader(xml, n, model, needed).read();
    }
    model.parts = std::move(needed.parts);
    return model;
}

}  // namespace treeform::detail::io
