#include <libmesh/attributes/class_colors.hpp>
#include <treeform/mesh/attribute_sources.hpp>
#include <treeform/mesh/attributes.hpp>
#include <treeform/mesh/weld.hpp>

#include <algorithm>

namespace treeform {
namespace {

/// By `pair_kind`: faces in pairs of several kinds show the gravest.
constexpr std::array<int, pair_kind_count> gravity{7, 5, 4, 3, 6, 2, 1};

void mark(std::uint8_t& present, pair_kind kind) {
    const auto index = static_cast<std::size_t>(kind);
    if (present == 0 || gravity[present - 1U] < gravity[index])
        present = static_cast<std::uint8_t>(index + 1);
}

/// A vertex shows the mark of a face at it that is in a pair, of the first one if there are more.
std::vector<std::uint8_t> marks_of_vertices(const mesh& mesh,
                                            const std::vector<std::uint8_t>& faces) {
    std::vector<std::uint8_t> vertices(mesh.points.size(), 0);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const std::uint32_t corner : mesh.faces[f])
            if (vertices[corner] == 0) vertices[corner] = faces[f];
    return vertices;
}

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

face_marks::face_marks(std::size_t face_count, std::span<const face_pair> pairs,
                       std::span<const intersection_region> regions)
    : kind(face_count, 0), region(face_count, -1) {
    for (const face_pair& pair : pairs)
        for (const std::uint32_t f : {pair.a, pair.b}) mark(kind[f], pair.kind);
    for (std::size_t r = 0; r < regions.size(); ++r)
        for (const std::uint32_t f : regions[r].faces) region[f] = static_cast<std::int32_t>(r);
}

void face_marks::color(mesh_file& file, const usable_mesh& searched) const {
    std::vector<std::int32_t> kinds(file.mesh.faces.size(), 0), regions(kinds.size(), -1);
    std::vector<std::uint8_t> classes(kinds.size(), 0);
    for (std::uint32_t f = 0; f < kind.size(); ++f) {
        const std::uint32_t t = searched.triangle(f);
        kinds[t] = classes[t] = kind[f];
        regions[t] = region[f];
    }
    if (!file.face_of_triangle.empty()) file.split_polygons();
    if (!file.indexed) {  // a soup becomes a mesh; where vertices have numbers they keep them
        file.mesh = join_equal_points(file.mesh);
        file.attributes = {};
        file.indexed = true;
    }
    using detail::attribute::set_colors;
    element& vertices = file.attributes.find_or_add("vertex", file.mesh.points.size());
    set_colors(vertices, marks_of_vertices(file.mesh, classes), mark_colors);
    element& faces = file.attributes.find_or_add("face", file.mesh.faces.size());
    set_colors(faces, classes, mark_colors);
    faces.set(column::of<std::int32_t>("tf_class", kinds));
    faces.set(column::of<std::int32_t>("tf_region", regions));
}

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
