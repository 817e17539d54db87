#include "tools/common/scene_file.hpp"

#include "tools/common/material_words.hpp"
#include <treeform/mesh/carry.hpp>
#include <treeform/tf.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace tools {
namespace {

/// The parts of a file in a scene, to be known there by the names they have, or by the
/// file's where it has one part.
std::vector<tf::part> parts_in_scene(const scene_input& b, std::vector<tf::part> parts) {
    const std::string file_name =
        b.path == "-" ? "stdin" : std::filesystem::path(b.path).stem().string();
    const bool one = std::all_of(parts.begin(), parts.end(), [&](const tf::part& p) {
        return p.object == parts[0].object && p.group == parts[0].group;
    });
    for (tf::part& p : parts)
        if (one) p = {.object = file_name, .material = p.material, .first_face = p.first_face};
    if (parts.empty() || parts[0].first_face > 0)
        parts.insert(parts.begin(), {.object = file_name});
    if (one)
        parts.erase(std::unique(parts.begin(), parts.end(),
                                [](const tf::part& p, const tf::part& q) {
                                    return p.material == q.material;
                                }),
                    parts.end());
    return parts;
}

/// What a scene takes of a file, except for points and faces.
tf::mesh_file described(const scene_input& b) {
    tf::mesh_file one{.stored_face = b.file->stored_face, .stored_faces = b.file->stored_faces};
    const tf::attributes& all = b.file->attributes;
    one.attributes = {.corners = all.corners,
                      .parts = all.parts,
                      .material_files = all.material_files,
                      .texture_files = all.texture_files};
    if (const tf::column* numbers = tf::texture_numbers(*b.file))
        one.attributes.elements = {{"face", one.stored_faces, {*numbers}}};
    return one;
}

/// The files of `inputs` with one list of texture files.
std::vector<tf::mesh_file> described(job& work, std::span<const scene_input> inputs,
                                     const std::string& format) {
    std::vector<tf::mesh_file> all;
    std::vector<std::string> names;
    for (const scene_input& b : inputs) {
        all.push_back(described(b));
        names.push_back(name_of_input(b.path));
    }
    std::vector<tf::mesh_file*> files;
    files.reserve(all.size());
    for (tf::mesh_file& one : all) files.push_back(&one);
    for (const tf::io_warning& w : tf::unite_textures(files, names)) work.warn(w.code, w.text);
    if (format == "obj")
        warn_of_ambiguous_materials(work,
                                    std::vector<const tf::mesh_file*>(files.begin(), files.end()));
    return all;
}

/// Gives the faces of `scene` that come next, `faces` in number, the numbers of `one`.
void append_texture_numbers(tf::mesh_file& scene, const tf::mesh_file& one, std::size_t faces) {
    const tf::column* const more = tf::texture_numbers(one);
    if (more == nullptr || scene.attributes.texture_files.empty()) return;
    tf::element& rows = tf::obtain_element(scene.attributes, "face", 0);
    rows.rows += faces;
    if (rows.columns.empty()) return rows.columns.push_back(*more);
    auto& values = rows.columns[0].values;
    values.insert(values.end(), more->values.begin(), more->values.end());
}

}  // namespace

tf::mesh_file scene_of(job& work, std::span<const scene_input> inputs, const std::string& format) {
    tf::mesh_file scene;
    scene.format = inputs[0].file->format;
    scene.stored_as = inputs[0].file->stored_as;
    const auto add = [&](const scene_input& b, tf::mesh_file one) {
        const tf::mesh& mesh = b.file->mesh;
        tf::split_polygons(one);
        append_texture_numbers(scene, one, mesh.faces.size());
        const auto first = static_cast<std::uint32_t>(scene.mesh.points.size());
        const auto first_face = static_cast<std::uint32_t>(scene.mesh.faces.size());
        for (tf::part& p : parts_in_scene(b, std::move(one.attributes.parts))) {
            p.first_face += first_face;
            scene.attributes.parts.push_back(std::move(p));
        }
        tf::append(scene.attributes.corners, first_face, one.attributes.corners, mesh.faces.size());
        auto& names = scene.attributes.material_files;
        for (const std::string& name : one.attributes.material_files)
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        scene.mesh.points.insert(scene.mesh.points.end(), mesh.points.begin(), mesh.points.end());
        for (const tf::face& f : mesh.faces)
            scene.mesh.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
    };
    std::vector<tf::mesh_file> files = described(work, inputs, format);
    scene.attributes.texture_files = files[0].attributes.texture_files;
    for (std::size_t i = 0; i < inputs.size(); ++i) add(inputs[i], std::move(files[i]));
    scene.stored_faces = scene.mesh.faces.size();
    return scene;
}

}  // namespace tools
