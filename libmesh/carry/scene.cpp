#include <treeform/mesh/as_mesh.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace treeform {

namespace {

constexpr const char* number_name = "texnumber";
constexpr std::int32_t no_texture = -1;

/// The column "texnumber" of faces, with indices into `texture_files`; null if there is none.
const column* texture_numbers(const mesh_file& file) {
    const element* faces = file.attributes.find("face");
    const column* c = faces == nullptr ? nullptr : faces->find(number_name);
    return c == nullptr || c->role != column_role::data || c->list_length ? nullptr : c;
}

class renumberer {
  public:
    /// Whether faces have to say which texture is theirs.
    [[nodiscard]] bool enter(const mesh_file& file) {
        const attributes& all = file.attributes;
        for (const std::string& name : all.texture_files)
            if (place_of_.try_emplace(name, static_cast<std::int32_t>(names_.size())).second)
                names_.push_back(name);
        return texture_numbers(file) != nullptr ||
               (all.texture_files.empty() && !all.corners.texture_of_corner.empty());
    }

    void renumber(mesh_file& file, const std::string& name) {
        std::vector<std::int32_t> places;
        for (const std::string& own : file.attributes.texture_files)
            places.push_back(place_of_.at(own));
        std::vector<std::int32_t> numbers(file.stored_faces,
                                          places.empty() ? no_texture : places.front());
        const column* const given = texture_numbers(file);
        std::uint64_t wrong = 0;
        for (std::size_t f = 0; given != nullptr && f < numbers.size(); ++f) {
            const double n = given->number(f);
            const bool names_one =
                n >= 0.0 && n < static_cast<double>(places.size()) && n == std::floor(n);
            numbers[f] = names_one ? places[static_cast<std::size_t>(n)] : no_texture;
            if (!names_one && n != no_texture) ++wrong;
        }
        if (wrong > 0)
            warn(name, std::to_string(wrong) + (wrong == 1 ? " face has a" : " faces have a") +
                           " " + number_name + " without a texture file; replaced by -1");
        const bool was_there = given != nullptr;
        element& faces = file.attributes.find_or_add("face", file.stored_faces);
        if (faces.set(column::of<std::int32_t>(number_name, numbers)) && !was_there)
            warn(name, std::string("lists ") + number_name + " of faces are replaced by numbers");
    }

    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] std::vector<io_warning>& warnings() { return warnings_; }

  private:
    void warn(const std::string& name, const std::string& text) {
        warnings_.push_back({"textures", name + ": " + text});
    }

    std::map<std::string, std::int32_t> place_of_{};
    std::vector<std::string> names_{};
    std::vector<io_warning> warnings_{};
};

/// The parts of a file in a scene, to be known there by the names they have, or by the
/// file's where it has one part.
std::vector<named_faces> parts_in_scene(const std::string& name, std::vector<named_faces> parts) {
    const bool one = std::all_of(parts.begin(), parts.end(), [&](const named_faces& p) {
        return p.object == parts[0].object && p.group == parts[0].group;
    });
    for (named_faces& p : parts)
        if (one) p = {.object = name, .material = p.material, .first_face = p.first_face};
    if (parts.empty() || parts[0].first_face > 0) parts.insert(parts.begin(), {.object = name});
    if (one)
        parts.erase(std::unique(parts.begin(), parts.end(),
                                [](const named_faces& p, const named_faces& q) {
                                    return p.material == q.material;
                                }),
                    parts.end());
    return parts;
}

/// What a scene takes of a file, except for points and faces.
mesh_file described(const mesh_file& file) {
    mesh_file one{.face_of_triangle = file.face_of_triangle, .stored_faces = file.stored_faces};
    const attributes& all = file.attributes;
    one.attributes = {.corners = all.corners,
                      .parts = all.parts,
                      .material_files = all.material_files,
                      .texture_files = all.texture_files};
    if (const column* numbers = texture_numbers(file))
        one.attributes.elements = {{"face", one.stored_faces, {*numbers}}};
    return one;
}

/// Gives the faces of `scene` that come next, `faces` in number, the numbers of `one`.
void append_texture_numbers(mesh_file& scene, const mesh_file& one, std::size_t faces) {
    const column* const more = texture_numbers(one);
    if (more == nullptr || scene.attributes.texture_files.empty()) return;
    element& rows = scene.attributes.find_or_add("face", 0);
    rows.rows += faces;
    if (rows.columns.empty()) return rows.columns.push_back(*more);
    auto& values = rows.columns[0].values;
    values.insert(values.end(), more->values.begin(), more->values.end());
}

void append(mesh_file& scene, const mesh& added, const std::string& name, mesh_file one) {
    one.split_polygons();
    append_texture_numbers(scene, one, added.faces.size());
    const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
    const auto first_face = static_cast<std::uint32_t>(scene.mesh.faces.size());
    for (named_faces& p : parts_in_scene(name, std::move(one.attributes.parts))) {
        p.first_face += first_face;
        scene.attributes.parts.push_back(std::move(p));
    }
    scene.attributes.corners.append(first_face, one.attributes.corners, added.faces.size());
    auto& names = scene.attributes.material_files;
    for (const std::string& name : one.attributes.material_files)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    scene.mesh.points.insert(scene.mesh.points.end(), added.points.begin(), added.points.end());
    for (const face& f : added.faces)
        scene.mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
}

}  // namespace

std::vector<io_warning> unite_textures(std::span<mesh_file* const> files,
                                       std::span<const std::string> names) {
    if (files.size() < 2) return {};
    renumberer all;
    bool numbered = false;
    for (const mesh_file* file : files) numbered |= all.enter(*file);
    if (all.names().empty()) return {};
    numbered = numbered || all.names().size() > 1;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (numbered && files[i]->stored_faces > 0) all.renumber(*files[i], names[i]);
        files[i]->attributes.texture_files = all.names();
    }
    return std::move(all.warnings());
}

mesh_file scene_of(std::span<const mesh_file* const> given, std::span<const std::string> names,
                   std::span<const std::string> labels) {
    std::vector<mesh_file> files;
    for (const mesh_file* one : given) files.push_back(described(*one));
    std::vector<mesh_file*> all(files.size());
    std::transform(files.begin(), files.end(), all.begin(), [](mesh_file& one) { return &one; });
    mesh_file scene;
    scene.warnings = unite_textures(all, labels);
    scene.format = given[0]->format;
    scene.stored_as = given[0]->stored_as;
    scene.attributes.texture_files = files[0].attributes.texture_files;
    for (std::size_t i = 0; i < given.size(); ++i)
        append(scene, given[i]->mesh, names[i], std::move(files[i]));
    scene.stored_faces = scene.mesh.faces.size();
    return scene;
}

}  // namespace treeform
