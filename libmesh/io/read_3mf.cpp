#include <libmesh/base/point_math.hpp>
#include <libmesh/io/model_3mf.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <libmesh/io/xml_part.hpp>
#include <libmesh/io/zip_archive.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

/// [triangles of the build]; shorter or empty if the remaining ones have none.
struct looks_3mf {
    std::vector<face> colors{};  ///< palette entries of corners
    /// texture coordinates of corners, as numbers of those of the model
    std::vector<face> texture{};
};

/// The palette number of each point; none where a face or two faces want several.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> colors_of_points(
    const mesh& mesh, const std::vector<face>& colors) {
    std::vector<std::uint32_t> of_point(mesh.points.size(), 0);
    for (std::size_t f = 0; f < colors.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& at = of_point[mesh.faces[f][k]];
            if (colors[f][k] == 0 || (at != 0 && at != colors[f][k])) return std::nullopt;
            at = colors[f][k];
        }
    return of_point;
}

/// Makes equal colors of several groups one number.
void unite_equal_colors(const model_3mf& model, std::vector<face>& colors) {
    std::unordered_map<std::uint32_t, std::uint32_t> number_of_color;
    std::vector<std::uint32_t> number(model.palette.size(), 0);
    for (std::uint32_t n = 1; n < number.size(); ++n)
        number[n] = number_of_color.emplace(model.palette[n], n).first->second;
    for (face& c : colors)
        for (std::uint32_t& n : c) n = number[n];
}

void add_colors(const model_3mf& model, std::vector<face>&& colors, mesh_file& file) {
    if (colors.empty()) return;
    colors.resize(file.mesh.faces.size());
    unite_equal_colors(model, colors);
    const auto mixed = std::count_if(colors.begin(), colors.end(),
                                     [](const face& c) { return c[0] != c[1] || c[0] != c[2]; });
    const auto of_points = mixed > 0 ? colors_of_points(file.mesh, colors) : std::nullopt;
    std::vector<std::uint32_t> rows;
    if (of_points)
        rows = *of_points;
    else
        for (const face& c : colors) rows.push_back(c[0]);
    for (std::uint32_t& n : rows) n = model.palette[n];
    add_color_columns(file.attributes.find_or_add(of_points ? "vertex" : "face", rows.size()),
                      rows);
    if (mixed > 0 && !of_points)
        file.warnings.push_back(
            {"colors",
             std::to_string(mixed) + " faces have several colors, of which one was read"});
}

/// Appends the values of an object whose first triangle is `first_face`. `turned`: the second and
/// third corner of each triangle were swapped.
void append_looks(looks_3mf& to, std::size_t first_face, const object_3mf& object, bool turned) {
    const auto append = [&](std::vector<face>& all, std::span<const face> more, const face& none) {
        if (more.empty()) return;
        all.resize(first_face, none);
        append_faces(all, more, 0, turned);
    };
    append(to.colors, object.colors, face{});
    append(to.texture, object.texture, no_texture);
}

/// Sets the colors of the file: of faces if each has a single color; of points if each point has a
/// single color; else of faces, by their first corners, with a warning. Also sets the texture
/// coordinates of corners.
void add_looks(const model_3mf& model, looks_3mf&& looks, mesh_file& file) {
    add_colors(model, std::move(looks.colors), file);
    if (looks.texture.empty()) return;
    looks.texture.resize(file.mesh.faces.size(), no_texture);
    file.attributes.corners.texture = model.texture;
    file.attributes.corners.texture_of_corner = std::move(looks.texture);
}

constexpr std::size_t deepest_component = 1000;
constexpr std::uint64_t most_placed = std::uint64_t{1} << 18;
constexpr std::uint64_t most_numbered = std::numeric_limits<std::uint32_t>::max();

/// What an object amounts to with all that is in it.
struct amount {
    std::uint64_t placed = 0;  ///< objects, itself too
    std::uint64_t points = 0;
    std::uint64_t faces = 0;
    std::size_t depth = 0;
};

/// Counts, and finds objects that are their own components. Each object is looked at once, however
/// often it is placed.
class counter {
  public:
    counter(const source& in, const model_3mf& model) : in_(in), model_(model) {}

    [[nodiscard]] amount total() {
        amount sum;
        for (const placed_3mf& item : model_.items) add(sum, of(item.object, 1), item.object);
        return sum;
    }

  private:
    [[nodiscard]] amount of(const object_key& key, std::size_t level) {
        if (level > deepest_component) fail_deep(key);
        const auto [at, is_new] = known_.try_emplace(key);
        if (!is_new) {
            if (at->second.placed == 0) fail(key, "is a component of itself");
            return at->second;
        }
        const object_3mf& object = model_.objects.at(key);
        amount sum{.placed = 1, .points = object.points.size(), .faces = object.faces.size()};
        for (const placed_3mf& c : object.components) add(sum, of(c.object, level + 1), key);
        ++sum.depth;
        if (sum.depth > deepest_component) fail_deep(key);
        known_[key] = sum;
        return sum;
    }

    void add(amount& to, const amount& more, const object_key& key) const {
        to.placed += more.placed;
        to.points += more.points;
        to.faces += more.faces;
        to.depth = std::max(to.depth, more.depth);
        if (to.placed > most_placed)
            fail(key, "makes more than " + std::to_string(most_placed) + " objects in the build");
        if (to.points > most_numbered || to.faces > most_numbered)
            fail(key, "makes more points or faces than 32-bit numbers can count");
    }

    [[noreturn]] void fail_deep(const object_key& key) const {
        fail(key, "is more than " + std::to_string(deepest_component) + " components deep");
    }

    [[noreturn]] void fail(const object_key& key, const std::string& reason) const {
        in_.fail(model_.parts[key.part] + ": object " + std::to_string(key.id) + " " + reason);
    }

    const source& in_;
    const model_3mf& model_;
    std::map<object_key, amount> known_{};
};

/// First `inner`, then `outer`; either as it is where the other changes nothing, -0 included.
[[nodiscard]] transform<3> composed(const transform<3>& inner, const transform<3>& outer) {
    if (inner == transform<3>{}) return outer;
    return outer == transform<3>{} ? inner : outer.after(inner);
}

class placer {
  public:
    placer(const source& in, const model_3mf& model, const amount& total) : in_(in), model_(model) {
        file_.mesh.points.reserve(total.points);
        file_.mesh.faces.reserve(total.faces);
    }

    [[nodiscard]] mesh_file place() {
        file_.format = "3mf";
        file_.stored_as = precision::float32;
        for (const placed_3mf& item : model_.items) {
            name_of_item_ = &item.part_number;
            place(item.object, item.transform, {});
        }
        file_.stored_faces = file_.mesh.faces.size();
        if (objects_ == 1 && is_nameless_) drop_name();
        add_looks(model_, std::move(looks_), file_);
        file_.attributes.obj_info.push_back("unit " + model_.unit);
        return std::move(file_);
    }

  private:
    /// `name` is that of the object around it.
    void place(const object_key& key, const transform<3>& t, const std::string& name) {
        const object_3mf& object = model_.objects.at(key);
        const std::string& mine = object.name.empty() ? name : object.name;
        if (!object.points.empty() || !object.faces.empty()) place_mesh(key, object, t, mine);
        for (const placed_3mf& c : object.components)
            place(c.object, composed(c.transform, t), mine);
    }

    void place_mesh(const object_key& key, const object_3mf& object, const transform<3>& t,
                    const std::string& name) {
        const auto first_point = static_cast<std::uint32_t>(file_.mesh.points.size());
        const std::size_t first_face = file_.mesh.faces.size();
        for (const point3& p : object.points) {
            const point3 at = moved(t, p);
            if (!base::is_finite(at))
                in_.fail(model_.parts[key.part] + ": object " + std::to_string(key.id) +
                         ": its transform moves it beyond the range of doubles");
            file_.mesh.points.push_back(at);
        }
        const bool turned = t.mirrors();
        append_faces(file_.mesh.faces, object.faces, first_point, turned);
        if (!fits_float32(object.points)) file_.stored_as = precision::float64;
        append_looks(looks_, first_face, object, turned);
        if (!object.faces.empty()) add_part(key, object, name, first_face);
    }

    /// A number is no name, and one object needs none to be told from others.
    void drop_name() {
        auto& parts = file_.attributes.parts;
        for (named_faces& p : parts) p.object.clear();
        if (parts.size() == 1 && parts[0].material.empty()) parts.clear();
    }

    void add_part(const object_key& key, const object_3mf& object, const std::string& name,
                  std::size_t first_face) {
        ++objects_;
        const std::string& given = name.empty() ? *name_of_item_ : name;
        is_nameless_ = given.empty();
        const std::string unique =
            names_.name(given.empty() ? "object " + std::to_string(key.id) : given);
        auto& parts = file_.attributes.parts;
        for (std::size_t f = 0; f < object.faces.size(); ++f) {
            const std::uint32_t material = object.materials.empty() ? 0 : object.materials[f];
            if (f > 0 && (object.materials.empty() || material == object.materials[f - 1]))
                continue;
            parts.push_back({.object = unique,
                             .material = model_.materials[material],
                             .first_face = static_cast<std::uint32_t>(first_face + f)});
        }
    }

    const source& in_;
    const model_3mf& model_;
    mesh_file file_{};
    looks_3mf looks_{};
    name_giver names_{};
    const std::string* name_of_item_ = nullptr;
    std::size_t objects_ = 0;
    bool is_nameless_ = false;
};

void say_what_is_unread(const unread_3mf& unread, std::vector<io_warning>& warnings) {
    const auto say = [&](std::size_t count, const char* code, const char* what) {
        if (count > 0) warnings.push_back({code, std::to_string(count) + what});
    };
    say(unread.not_built, "not-built", " objects are not in the build and were not read");
    say(unread.other, "not-built", " items and components of type 'other' were not read");
    say(unread.support, "support", " items and components are supports; they were read, too");
    say(unread.not_printable, "support", " items are not printable; they were read, too");
    say(unread.extensions, "skipped-elements", " elements of extensions in meshes were not read");
    say(unread.property_uses, "materials", " faces have mixed materials, which were not read");
    if (unread.images) warnings.push_back({"materials", "images of textures were not read"});
}

/// Items and components with objects of a type.
[[nodiscard]] std::size_t count_users(const model_3mf& model, bool object_3mf::*of_type) {
    const auto is_one = [&](const placed_3mf& p) { return model.objects.at(p.object).*of_type; };
    auto count = std::count_if(model.items.begin(), model.items.end(), is_one);
    for (const auto& [key, object] : model.objects)
        count += std::count_if(object.components.begin(), object.components.end(), is_one);
    return static_cast<std::size_t>(count);
}

/// The objects of all items, transformed, each as a part of its own. Sizes are counted before
/// anything is built.
///
/// \throws io_error for an object that is its own component, and for too many objects, points or
///         faces
mesh_file place_3mf(const source& in, const model_3mf& model) {
    const amount total = counter(in, model).total();
    mesh_file file = placer(in, model, total).place();
    unread_3mf unread = model.unread;
    unread.other = count_users(model, &object_3mf::is_other);
    unread.support = count_users(model, &object_3mf::is_support);
    say_what_is_unread(unread, file.warnings);
    return file;
}

constexpr const char* package_relationships = "_rels/.rels";

/// The model part that the package starts with.
[[nodiscard]] std::string root_of(const source& in, zip_archive& archive) {
    if (!archive.holds(package_relationships))
        in.fail("not a 3MF: the archive has no " + std::string(package_relationships));
    const xml_part relationships(in, package_relationships, archive.read(package_relationships));
    std::string root;
    for (const pugi::xml_node relationship : relationships.root().children()) {
        if (local_name(relationship.name()) != "Relationship") continue;
        if (std::strcmp(relationships.required(relationship, "Type"), model_relationship_3mf) != 0)
            continue;
        if (!root.empty()) relationships.fail(relationship, "is a second root model");
        root = relationships.required(relationship, "Target");
        if (root.starts_with('/')) root.erase(0, 1);
        if (!archive.holds(root))
            relationships.fail(relationship, "refers to a file that is not in the archive");
    }
    if (root.empty()) relationships.fail("no relationship refers to a model: not a 3MF");
    return root;
}

}  // namespace

mesh_file read_3mf(const source& in) {
    zip_archive archive(in);
    const std::string root = root_of(in, archive);
    mesh_file file = place_3mf(in, parse_3mf(in, archive, root));
    if (archive.bytes_ahead() > 0)
        file.warnings.push_back({"bytes-ahead", std::to_string(archive.bytes_ahead()) +
                                                    " bytes before the archive were skipped"});
    return file;
}

}  // namespace treeform::detail::io
