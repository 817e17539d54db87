#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/io/writers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace treeform::detail::io {

namespace {

using vector3 = std::array<float, 3>;

/// The corners of a triangle as they are written.
using corners = std::array<point3, 3>;

[[nodiscard]] corners written(const write_job& job, const face& f) {
    corners abc;
    for (std::size_t c = 0; c < 3; ++c) {
        const point3& p = job.file.mesh.points[f[c]];
        abc[c] = {job.rounded(p.x), job.rounded(p.y), job.rounded(p.z)};
    }
    return abc;
}

/// The unit normal of a triangle; zero where there is none.
[[nodiscard]] vector3 normal(const corners& abc) {
    const auto& [a, b, c] = abc;
    const point3 u{b.x - a.x, b.y - a.y, b.z - a.z};
    const point3 v{c.x - a.x, c.y - a.y, c.z - a.z};
    const point3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    if (!(length > 0.0) || !std::isfinite(length)) return {};
    // + 0.0f turns -0 into 0.
    return {static_cast<float>(n.x / length) + 0.0F, static_cast<float>(n.y / length) + 0.0F,
            static_cast<float>(n.z / length) + 0.0F};
}

void put_vector(sink& out, const vector3& v) {
    for (const float x : v) out.raw<std::endian::little>(x);
}

void binary_facet(const write_job& job, std::size_t f, const std::vector<const column*>& bits) {
    const mesh_file& file = job.file;
    put_vector(job.out, normal(written(job, file.mesh.faces[f])));
    for (const std::uint32_t corner : file.mesh.faces[f]) {
        const point3& p = file.mesh.points[corner];
        put_vector(job.out,
                   {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    const double value = bits.empty() ? 0.0 : bits[0]->number(face_row(file, f));
    const bool fits = value >= 0.0 && value <= 65535.0;
    job.out.raw<std::endian::little>(static_cast<std::uint16_t>(fits ? value : 0.0));
}

void text_facet(const write_job& job, const face& f) {
    sink& out = job.out;
    out.put("facet normal");
    for (const float x : normal(written(job, f))) {
        out.put(' ');
        out.number(x);
    }
    out.put("\n outer loop\n");
    for (const std::uint32_t corner : f) {
        out.put("  vertex ");
        job.point(job.file.mesh.points[corner]);
        out.put('\n');
    }
    out.put(" endloop\nendfacet\n");
}

/// The 80 bytes ahead of the facets. Programs print them as text that a NUL ends, and take a file
/// that begins with "solid" for a text STL.
[[nodiscard]] std::string binary_header(const std::string& kept) {
    constexpr std::string_view solid = "solid";
    std::string header = kept.size() == 80 ? kept : "treeform";
    while (header.starts_with(solid)) header.erase(0, header.find_first_not_of(' ', solid.size()));
    // Not \0 alone at the end: blanks that filled the rest go, too.
    if (header.find('\0') == std::string::npos) {
        header.resize(std::min(header.find_last_not_of(' ') + 1, std::size_t{79}));
    }
    header.resize(80, '\0');
    return header;
}

[[nodiscard]] bool differ_in_material_alone(const named_faces& a, const named_faces& b) {
    return a.object == b.object && a.group == b.group && a.material != b.material;
}

}  // namespace

void write_stl_binary(const write_job& job) {
    const mesh_file& file = job.file;
    job.out.put(binary_header(file.attributes.header));
    job.out.raw<std::endian::little>(static_cast<std::uint32_t>(file.mesh.faces.size()));
    const auto bits = scalar_columns(file.attributes.find("face"), {"stl_attribute"});
    put_by_pieces(job, file.mesh.faces.size(), [&](const write_job& piece, auto first, auto last) {
        for (std::size_t f = first; f < last; ++f) binary_facet(piece, f, bits);
    });
}

void write_stl_text(const write_job& job) {
    const mesh_file& file = job.file;
    const auto& parts = file.attributes.parts;
    // Faces ahead of the first part have no name.
    std::size_t next_part = !parts.empty() && parts[0].first_face == 0 ? 1 : 0;
    named_faces now = next_part > 0 ? parts[0] : named_faces{};
    const auto put_name = [&](std::string_view keyword) {
        job.out.put(keyword);
        const std::string name = part_name(now);
        if (!name.empty()) job.out.put(' ' + one_line(name));
        job.out.put('\n');
    };
    put_name("solid");
    for (std::size_t f = 0; f < file.mesh.faces.size();) {
        for (; next_part < parts.size() && parts[next_part].first_face <= face_row(file, f);
             ++next_part) {
            const bool goes_on = differ_in_material_alone(now, parts[next_part]);
            if (!goes_on) put_name("endsolid");
            now = parts[next_part];
            if (!goes_on) put_name("solid");
        }
        const std::size_t stop =
            next_part < parts.size() ? parts[next_part].first_face : file.mesh.faces.size();
        std::size_t last = f + 1;
        while (last < file.mesh.faces.size() && face_row(file, last) < stop) ++last;
        put_by_pieces(job, last - f, [&](const write_job& piece, auto from, auto to) {
            for (std::size_t i = from; i < to; ++i) text_facet(piece, file.mesh.faces[f + i]);
        });
        f = last;
    }
    put_name("endsolid");
}

}  // namespace treeform::detail::io
