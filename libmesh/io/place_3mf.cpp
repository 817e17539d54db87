#include <libmesh/io/colors_3mf.hpp>
#include <libmesh/io/name_giver.hpp>
#include <libmesh/io/place_3mf.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace treeform::detail::io {

namespace {

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
    void place(const object_key& key, const transform_3mf& t, const std::string& name) {
        const object_3mf& object = model_.objects.at(key);
        const std::string& mine = object.name.empty() ? name : object.name;
        if (!object.points.empty() || !object.faces.empty()) place_mesh(key, object, t, mine);
        for (const placed_3mf& c : object.components)
            place(c.object, compose(c.transform, t), mine);
    }

    void place_mesh(const object_key& key, const object_3mf& object, const transform_3mf& t,
                    const std::string& name) {
        const auto first_point = static_cast<std::uint32_t>(file_.mesh.points.size());
        const std::size_t first_face = file_.mesh.faces.size();
        for (const point3& p : object.points) {
            const point3 at = moved(t, p);
            if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z))
                in_.fail(model_.parts[key.part] + ": object " + std::to_string(key.id) +
                         ": its transform moves it beyond the range of doubles");
            file_.mesh.points.push_back(at);
        }
        const bool turned = mirrors(t);
        for (const face& f : object.faces) {
            file_.mesh.faces.push_back({first_point + f[0], first_point + f[turned ? 2 : 1],
                                        first_point + f[turned ? 1 : 2]});
        }
        if (!fits_single(object.points)) file_.stored_as = precision::float64;
        append_looks(looks_, first_face, object, turned);
        if (!object.faces.empty()) add_part(key, object, name, first_face);
    }

    /// A number is no name, and one object needs none to be told from others.
    void drop_name() {
        auto& parts = file_.attributes.parts;
        for (part& p : parts) p.object.clear();
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

}  // namespace

mesh_file place_3mf(const source& in, const model_3mf& model) {
    const amount total = counter(in, model).total();
    mesh_file file = placer(in, model, total).place();
    unread_3mf unread = model.unread;
    unread.other = count_users(model, &object_3mf::is_other);
    unread.support = count_users(model, &object_3mf::is_support);
    say_what_is_unread(unread, file.warnings);
    return file;
}

}  // namespace treeform::detail::io
