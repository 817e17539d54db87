#include <libmesh/io/writers.hpp>

#include <string_view>

namespace treeform::detail::io {

namespace {

/// What vertices have of what an OBJ gives to corners: it is written behind each of them, and
/// corners then have the numbers of their vertices.
struct vertex_looks {
    std::vector<const column*> texture{};
    std::vector<const column*> normal{};

    /// Unless corners have values of their own.
    vertex_looks(const write_job& job, const element* vertices) {
        const corner_values& corners = job.file.attributes.corners;
        if (corners.texture.empty()) texture = scalar_columns(vertices, {"s", "t"});
        if (corners.normals.empty()) normal = scalar_columns(vertices, {"nx", "ny", "nz"});
    }
};

void put_look(sink& out, std::string_view keyword, const std::vector<const column*>& values,
              std::size_t row) {
    if (values.empty()) return;
    out.put(keyword);
    for (const column* c : values) {
        out.put(' ');
        put_number(out, *c, row);
    }
    out.put('\n');
}

void put_vertices(const write_job& job, std::span<const point3> points, const element* vertices) {
    auto colors = color_columns(vertices);
    if (colors.size() == 4) colors.pop_back();
    const vertex_looks looks(job, vertices);
    put_by_pieces(job, points.size(), [&](const write_job& piece, auto first, auto last) {
        for (std::size_t v = first; v < last; ++v) {
            piece.out.put("v ");
            piece.point(points[v]);
            for (const column* c : colors) {
                piece.out.put(' ');
                piece.out.number(color_value(*c, v));
            }
            piece.out.put('\n');
            put_look(piece.out, "vt", looks.texture, v);
            put_look(piece.out, "vn", looks.normal, v);
        }
    });
}

void put_row(sink& out, std::string_view keyword, std::span<const double> values) {
    out.put(keyword);
    for (const double value : values) {
        out.put(' ');
        out.number(value);
    }
    out.put('\n');
}

void put_corner_values(sink& out, const corner_values& corners) {
    for (const auto& row : corners.texture)
        put_row(out, "vt", std::span(row).first(corners.has_w ? 3 : 2));
    for (const point3& n : corners.normals) put_row(out, "vn", std::array{n.x, n.y, n.z});
}

/// The numbers that corners have for one kind of value.
struct row_numbers {
    const std::vector<face>& fans;
    bool by_vertex;  ///< those of their vertices

    /// Of corner `corner` of the face whose first triangle is `first`, from 1; 0 where it has none.
    [[nodiscard]] std::uint64_t of(std::size_t first, std::size_t corner,
                                   std::uint32_t vertex) const {
        if (by_vertex) return std::uint64_t{vertex} + 1;
        if (fans.empty()) return 0;
        const auto [triangle, place] = place_in_fan(corner);
        const std::uint32_t row = fans[first + triangle][place];
        return row == corner_values::none ? 0 : std::uint64_t{row} + 1;
    }
};

/// "f 1/1/1 2/2/2 3/3/3"
struct face_lines {
    row_numbers textures;
    row_numbers normals;

    /// Of the face whose first triangle is `first`.
    void put(sink& out, std::size_t first, std::span<const std::uint32_t> corners) const {
        out.put('f');
        for (std::size_t i = 0; i < corners.size(); ++i) {
            out.put(' ');
            out.number(std::uint64_t{corners[i]} + 1);
            const std::uint64_t texture = textures.of(first, i, corners[i]);
            const std::uint64_t normal = normals.of(first, i, corners[i]);
            if (texture + normal > 0) out.put('/');
            if (texture > 0) out.number(texture);
            if (normal == 0) continue;
            out.put('/');
            out.number(normal);
        }
        out.put('\n');
    }
};

void put_name(sink& out, std::string_view keyword, const std::string& name) {
    out.put(keyword);
    out.put(' ');
    out.put(one_line(name));
    out.put('\n');
}

/// The names that differ from those in force.
void put_names(sink& out, const named_faces& now, const named_faces& before) {
    if (now.object != before.object) put_name(out, "o", now.object);
    // A new object has no group until one is named.
    if (now.group != (now.object != before.object ? std::string() : before.group))
        put_name(out, "g", now.group);
    if (now.material != before.material) put_name(out, "usemtl", now.material);
}

void put_head(const write_job& job, std::uint64_t points) {
    // A file of no bytes would be taken for one that was cut off.
    if (points == 0) job.out.put("# no vertices\n");
    for (const std::string& name : job.file.attributes.material_files)
        put_name(job.out, "mtllib", name);
}

void put_faces(const write_job& job, const row_block& block) {
    if (block.rows.name != "face") return;
    put_by_pieces(job, block.rows.rows, [&](const write_job& piece, auto first, auto last) {
        const std::span<const std::uint32_t> all(block.corners);
        const std::vector<face> none;
        const vertex_looks looks(job, job.vertices);
        const face_lines lines{{none, !looks.texture.empty()}, {none, !looks.normal.empty()}};
        for (std::size_t f = first; f < last; ++f)
            lines.put(piece.out, f,
                      all.subspan(block.first_corner[f],
                                  block.first_corner[f + 1] - block.first_corner[f]));
    });
}

}  // namespace

void write_obj(const write_job& job) {
    put_head(job, job.file.mesh.points.size());
    put_vertices(job, job.file.mesh.points, job.vertices);
    const vertex_looks looks(job, job.vertices);
    const corner_values& values = job.file.attributes.corners;
    put_corner_values(job.out, values);
    const face_lines lines{{values.texture_of_corner, !looks.texture.empty()},
                           {values.normal_of_corner, !looks.normal.empty()}};
    const mesh_file& file = job.file;
    const auto& parts = file.attributes.parts;
    if (parts.empty() && file.face_of_triangle.empty()) {
        put_by_pieces(job, file.mesh.faces.size(),
                      [&](const write_job& piece, auto first, auto last) {
                          for (std::size_t f = first; f < last; ++f)
                              lines.put(piece.out, f, file.mesh.faces[f]);
                      });
        return;
    }
    std::size_t part_index = 0;
    named_faces current;
    for_each_stored_face(file, [&](std::size_t first, std::span<const std::uint32_t> corners) {
        for (; part_index < parts.size() && parts[part_index].first_face <= face_row(file, first);
             ++part_index) {
            put_names(job.out, parts[part_index], current);
            current = parts[part_index];
        }
        lines.put(job.out, first, corners);
    });
}

point_sink start_obj_points(const write_job& job, std::uint64_t count) {
    put_head(job, count);
    return {.rows = [job](std::span<const point3> points,
                          const element* vertices) { put_vertices(job, points, vertices); },
            .behind = [job](const row_block& block) { put_faces(job, block); }};
}

}  // namespace treeform::detail::io
