#pragma once
/// \file
/// Material and texture files, which a file names relative to its own folder.

#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tools {

/// Without links; none for a standard stream, or where it cannot be found out.
[[nodiscard]] inline std::optional<std::filesystem::path> known_folder_of(
    const std::filesystem::path& file) {
    if (file.empty() || file == "-") return std::nullopt;
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(file, error);
    if (error) return std::nullopt;
    std::filesystem::path folder = std::filesystem::weakly_canonical(whole.parent_path(), error);
    return error ? std::nullopt : std::optional(std::move(folder));
}

/// Also of another system: a name with a drive or a host, as "C:/a.mtl".
[[nodiscard]] inline bool is_absolute(std::string_view name) {
    const bool has_drive = name.size() > 2 && name[1] == ':' && (name[2] == '/' || name[2] == '\\');
    return has_drive || name.starts_with("\\\\") || std::filesystem::path(name).is_absolute();
}

/// Puts the folder of `input` in front of names that are relative to it, with "/./" in between.
inline void keep_folder(treeform::attributes& all, const std::filesystem::path& input) {
    const auto folder = known_folder_of(input);
    if (!folder) return;
    for (auto* names : {&all.material_files, &all.texture_files})
        for (std::string& name : *names)
            if (!is_absolute(name)) name = folder->generic_string() + "/./" + name;
}

/// `treeform::read`; names of files get the folder of `path`.
[[nodiscard]] inline treeform::mesh_file read_linked(const std::filesystem::path& path,
                                                     std::string_view format,
                                                     const treeform::read_options& options) {
    treeform::mesh_file file = treeform::read(path, format, options);
    keep_folder(file.attributes, path);
    return file;
}

/// Names with such a folder, relative to the folder of `output`. As in the input if the folders are
/// equal, or `output` is "-".
inline void link_from(const std::filesystem::path& output, treeform::attributes& all) {
    const auto to = known_folder_of(output);
    for (auto* names : {&all.material_files, &all.texture_files})
        for (std::string& name : *names) {
            const std::size_t end = name.find("/./");
            if (end == std::string::npos || !is_absolute(name)) continue;
            const std::filesystem::path whole = name,
                                        from = whole.root_path() / name.substr(0, end);
            name = name.substr(end + 3);
            if (!to || *to == from) continue;
            const auto there = whole.lexically_normal().lexically_relative(*to);
            if (!there.empty()) name = there.generic_string();
        }
}

inline constexpr std::string_view same_material = "same-material";

/// Which materials of the inputs have the same name, in words; empty if none have.
[[nodiscard]] inline std::string ambiguous_materials_in_words(
    const treeform::attribute_sources& from) {
    const std::vector<std::string> names = from.ambiguous_materials();
    if (names.empty()) return {};
    return "inputs with different material files use the same name for " +
           (names.size() == 1
                ? "material " + names.front()
                : std::to_string(names.size()) + " materials, such as " + names.front()) +
           "; an OBJ can have only one material of a name";
}

/// Adds a warning to the result of inputs that use the same name for different materials.
inline void warn_of_materials(treeform::mesh_file& made, const treeform::attribute_sources& from) {
    for (const treeform::attribute_source& input : from.all())
        for (const treeform::io_warning& one : input.file->warnings)
            if (one.code == same_material) made.warnings.push_back(one);
    std::string text = ambiguous_materials_in_words(from);
    if (!text.empty()) made.warnings.push_back({std::string(same_material), std::move(text)});
}

/// `treeform::scene_of` with such warnings.
[[nodiscard]] inline treeform::mesh_file scene_of(
    const std::vector<const treeform::mesh_file*>& members, const std::vector<std::string>& names) {
    treeform::mesh_file made = treeform::scene_of(members, names, names);
    std::vector<treeform::attribute_source> sources;
    for (const treeform::mesh_file* const one : members) sources.push_back({one, {}});
    warn_of_materials(made, sources);
    return made;
}

/// `put` of the file as it is written to `output`. The file is copied only if it names files.
template <class Put>
auto write_linked(const std::filesystem::path& output, const treeform::mesh_file& file,
                  const Put& put) {
    const treeform::attributes& all = file.attributes;
    if (all.material_files.empty() && all.texture_files.empty()) return put(file);
    treeform::mesh_file linked = file;
    link_from(output, linked.attributes);
    auto written = put(linked);
    if constexpr (requires { written.warnings; })
        for (const treeform::io_warning& one : file.warnings)
            if (written.format == "obj" && one.code == same_material)
                written.warnings.push_back(one);
    return written;
}

}  // namespace tools
