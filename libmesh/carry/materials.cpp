#include <libmesh/carry/carried.hpp>
#include <treeform/mesh/attribute_sources.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace treeform::detail::carry {
namespace {

bool has_materials(const attribute_source& input) {
    const auto& parts = input.file->attributes.parts;
    return std::ranges::any_of(parts, [](const named_faces& p) { return !p.material.empty(); });
}

/// The part of a face of an input; one without names where it is in none.
const named_faces& part_of(const attribute_source& input, std::uint32_t face) {
    static const named_faces no_part;
    const auto& parts = input.file->attributes.parts;
    const auto behind = std::upper_bound(
        parts.begin(), parts.end(), input.face_in_file(face),
        [](std::uint32_t number, const named_faces& p) { return number < p.first_face; });
    return behind == parts.begin() ? no_part : *std::prev(behind);
}

/// [V] the lowest face with a source at each vertex, for what fills holes between such faces; empty
/// where all have one.
std::vector<std::uint32_t> sourced_faces(const mesh_file& file, const carried_elements& made) {
    std::vector<std::uint32_t> at;
    if (std::ranges::count(made.face_source, operand_element{}) == 0) return at;
    at.resize(file.mesh.points.size(), operand_element::none);
    for (auto f = static_cast<std::uint32_t>(made.face_source.size()); f-- > 0;)
        if (made.face_source[f].operand != operand_element::none)
            for (const std::uint32_t corner : file.mesh.faces[f]) at[corner] = f;
    return at;
}

}  // namespace

const std::string& material_of(const attribute_source& input, std::uint32_t face) {
    return part_of(input, face).material;
}

void carry_materials(mesh_file& file, std::span<const attribute_source> inputs,
                     const carried_elements& made) {
    if (!inputs.empty())
        file.attributes.texture_files = inputs.front().file->attributes.texture_files;
    std::set<std::string> known;
    for (const attribute_source& input : inputs)
        for (const std::string& name : input.file->attributes.material_files)
            if (known.insert(name).second) file.attributes.material_files.push_back(name);
    const bool keeps_names = inputs.size() == 1;
    if (!keeps_names && std::none_of(inputs.begin(), inputs.end(), has_materials)) return;
    const std::vector<std::uint32_t> sourced = sourced_faces(file, made);
    named_faces now;
    for (std::uint32_t f = 0; f < made.face_source.size(); ++f) {
        operand_element source = made.face_source[f];
        if (source.operand == operand_element::none) {
            std::uint32_t beside = operand_element::none;
            for (const std::uint32_t corner : file.mesh.faces[f])
                beside = std::min(beside, sourced[corner]);
            if (beside == operand_element::none) continue;
            source = made.face_source[beside];
        }
        const auto [operand, index] = source;
        named_faces next = part_of(inputs[operand], index);
        next.first_face = now.first_face;
        if (!keeps_names) next.object = next.group = {};
        if (next == now) continue;
        now = std::move(next);
        now.first_face = f;
        file.attributes.parts.push_back(now);
    }
}

}  // namespace treeform::detail::carry

namespace treeform {

std::vector<std::string> attribute_sources::ambiguous_materials() const {
    std::map<std::string, const std::vector<std::string>*> files_of;
    std::set<std::string> found;
    for (const attribute_source& input : all_) {
        const attributes& all = input.file->attributes;
        for (const named_faces& p : all.parts) {
            if (p.material.empty()) continue;
            const auto [at, fresh] = files_of.try_emplace(p.material, &all.material_files);
            if (!fresh && *at->second != all.material_files) found.insert(p.material);
        }
    }
    return {found.begin(), found.end()};
}

}  // namespace treeform
