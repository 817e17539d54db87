#include <libmesh/carry/materials.hpp>
#include <treeform/mesh/carry.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace treeform::detail::carry {
namespace {

bool has_materials(const carry_source& input) {
    const auto& parts = input.file->attributes.parts;
    return std::any_of(parts.begin(), parts.end(),
                       [](const part& p) { return !p.material.empty(); });
}

}  // namespace

const std::string& material_of(const carry_source& input, std::uint32_t face) {
    static const std::string no_name;
    const auto& parts = input.file->attributes.parts;
    const auto behind =
        std::upper_bound(parts.begin(), parts.end(), input.stored_face(face),
                         [](std::uint32_t number, const part& p) { return number < p.first_face; });
    return behind == parts.begin() ? no_name : std::prev(behind)->material;
}

void carry_materials(mesh_file& file, std::span<const carry_source> inputs,
                     const carried_elements& made) {
    if (!inputs.empty())
        file.attributes.texture_files = inputs.front().file->attributes.texture_files;
    std::set<std::string> known;
    for (const carry_source& input : inputs)
        for (const std::string& name : input.file->attributes.material_files)
            if (known.insert(name).second) file.attributes.material_files.push_back(name);
    if (std::none_of(inputs.begin(), inputs.end(), has_materials)) return;
    std::string now;
    for (std::uint32_t f = 0; f < made.face_source.size(); ++f) {
        const auto [operand, index] = made.face_source[f];
        if (operand == operand_element::none) continue;
        const std::string& material = material_of(inputs[operand], index);
        if (material == now) continue;
        now = material;
        file.attributes.parts.push_back({.material = now, .first_face = f});
    }
}

}  // namespace treeform::detail::carry

namespace treeform {

std::vector<std::string> ambiguous_materials(std::span<const mesh_file* const> inputs) {
    std::map<std::string, const std::vector<std::string>*> files_of;
    std::set<std::string> found;
    for (const mesh_file* input : inputs) {
        const attributes& all = input->attributes;
        for (const part& p : all.parts) {
            if (p.material.empty()) continue;
            const auto [at, fresh] = files_of.try_emplace(p.material, &all.material_files);
            if (!fresh && *at->second != all.material_files) found.insert(p.material);
        }
    }
    return {found.begin(), found.end()};
}

}  // namespace treeform
