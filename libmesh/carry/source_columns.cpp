#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/carry.hpp>

#include <algorithm>

namespace treeform {
namespace {

bool is_printable(const std::string& text) {
    return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) >= 32; });
}

void drop_source_columns(mesh_file& file, const std::string& name) {
    for (element& e : file.attributes.elements)
        if (e.name == "face")
            std::erase_if(e.columns, [&](const column& c) {
                return c.name == name + "_mesh" || c.name == name + "_face";
            });
    std::erase_if(file.attributes.comments,
                  [&](const std::string& comment) { return comment.starts_with(name + "_mesh "); });
}

}  // namespace

void set_source_columns(mesh_file& file, const std::string& name,
                        std::span<const operand_element> face_source,
                        std::span<const std::string> inputs) {
    drop_source_columns(file, name);
    if (inputs.empty()) return;
    std::vector<std::uint32_t> meshes, faces;
    for (const operand_element& source : face_source) {
        meshes.push_back(source.operand);
        faces.push_back(source.index);
    }
    element& rows = file.attributes.find_or_add("face", file.mesh.faces.size());
    rows.columns.push_back(column::of<std::uint32_t>(name + "_mesh", meshes));
    rows.columns.push_back(column::of<std::uint32_t>(name + "_face", faces));
    for (std::size_t i = 0; i < inputs.size(); ++i)
        if (is_printable(inputs[i]))
            file.attributes.comments.push_back(name + "_mesh " + std::to_string(i) + " " +
                                               inputs[i]);
}

}  // namespace treeform
