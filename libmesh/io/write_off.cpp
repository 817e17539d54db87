#include <libmesh/io/writers.hpp>

#include <cmath>
#include <string>

namespace treeform::detail::io {

namespace {

/// True for the whole numbers that are written with neither point nor exponent, as far as colors
/// and their like go; std::to_chars gives an exponent where that is shorter.
[[nodiscard]] bool is_whole(double value) {
    return value == std::floor(value) && std::abs(value) < 1e5;
}

/// Values of a row. A point in the number says that it is not a whole one, which matters for
/// colors: 1 is a 255th and 1.0 is full.
void put_values(sink& out, const std::vector<const column*>& columns, std::size_t row) {
    for (const column* c : columns) {
        out.put(' ');
        put_number(out, *c, row);
        if (c->type >= scalar_type::float32 && is_whole(c->number(row))) out.put(".0");
    }
}

struct vertex_columns {
    std::vector<const column*> normal, color, texture;

    explicit vertex_columns(const element* vertices)
        : normal(scalar_columns(vertices, {"nx", "ny", "nz"})),
          color(color_columns(vertices)),
          texture(scalar_columns(vertices, {"s", "t"})) {}
    [[nodiscard]] std::string word() const {
        std::string word = texture.empty() ? "" : "ST";
        if (!color.empty()) word += 'C';
        if (!normal.empty()) word += 'N';
        return word + "OFF\n";
    }
};

/// The list that `read_off` makes of colors that differ in kind from face to face.
void put_list(sink& out, const column* list, std::size_t row) {
    if (list == nullptr || !list->list_length) return;
    for (std::uint64_t i = list->list_begin[row]; i < list->list_begin[row + 1]; ++i) {
        out.put(' ');
        out.number(list->number(i));
    }
}

}  // namespace

void write_off(const write_job& job) {
    const mesh_file& file = job.file;
    const vertex_columns columns(job.vertices);
    sink& out = job.out;
    out.put(columns.word());
    out.number(file.mesh.points.size());
    out.put(' ');
    out.number(stored_face_count(file));
    out.put(" 0\n");
    for (std::size_t v = 0; v < file.mesh.points.size(); ++v) {
        job.point(file.mesh.points[v]);
        put_values(out, columns.normal, v);
        put_values(out, columns.color, v);
        put_values(out, columns.texture, v);
        out.put('\n');
    }
    const element* face_element = file.attributes.find("face");
    const column* list = face_element == nullptr ? nullptr : face_element->find("off_color");
    auto colors = color_columns(face_element);
    if (colors.empty()) colors = scalar_columns(face_element, {"color_index"});
    for_each_stored_face(file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
        out.number(corners.size());
        for (const std::uint32_t corner : corners) {
            out.put(' ');
            out.number(corner);
        }
        put_values(out, colors, face_row(file, first));
        if (colors.empty()) put_list(out, list, face_row(file, first));
        out.put('\n');
    });
}

}  // namespace treeform::detail::io
