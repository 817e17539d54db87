#include <libmesh/io/face_sink.hpp>
#include <libmesh/io/obj_corners.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/scratch.hpp>
#include <libmesh/io/text.hpp>
#include <libmesh/io/vertex_columns.hpp>
#include <treeform/mesh/mesh_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace treeform::detail::io {

namespace {

/// What a material file says.
struct material_look {
    std::optional<std::array<double, 3>> diffuse{};
    double opacity = 1.0;

    /// 0xRRGGBBAA.
    [[nodiscard]] std::uint32_t color() const {
        std::uint32_t color = 0;
        for (const double share : {(*diffuse)[0], (*diffuse)[1], (*diffuse)[2], opacity})
            color = color << 8 |
                    static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0));
        return color;
    }
};

/// By name; the first of a name is meant, as where files say the same twice.
using material_looks = std::map<std::string, material_look, std::less<>>;

/// Of a regular file: nothing else is waited for, and one that cannot be read is as one that is not
/// there.
void read_material_file(const std::filesystem::path& path, material_looks& looks,
                        bool& has_transparency) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return;
    try {
        const source in = source::open(path);
        text t(in);
        const auto number = [&]() -> std::optional<double> {
            if (t.line_done()) return std::nullopt;
            const parsed<double> n = parse_number(t.at, t.end);
            if (n.end == nullptr || !std::isfinite(n.value)) return std::nullopt;
            return t.take(n);
        };
        for (material_look* now = nullptr; !t.text_done(); t.skip_line()) {
            const std::string_view keyword = t.word();
            if (keyword == "newmtl") {
                const auto [at, is_new] =
                    looks.try_emplace(std::string(t.rest_of_line()), material_look{});
                now = is_new ? &at->second : nullptr;
            } else if (now != nullptr && keyword == "Kd") {
                const auto r = number(), g = number(), b = number();
                if (r) now->diffuse = {*r, g.value_or(*r), b.value_or(*r)};
            } else if (now != nullptr && keyword == "d") {
                now->opacity = number().value_or(1.0);
            } else if (now != nullptr && keyword == "Tr") {
                has_transparency = has_transparency || number().value_or(0.0) != 0.0;
            }
        }
    } catch (const io_error&) {
        return;
    }
}

/// Gives the faces of the OBJ at `path` the diffuse colors of their materials (`Kd`, `d`), as
/// columns red, green, blue, and alpha unless all are opaque. Faces without a material with a color
/// are white. Changes nothing if no material file exists (as with an empty `path`), or none has a
/// color of a used material. Invalid numbers in these files are ignored.
void add_material_colors(mesh_file& file, const std::filesystem::path& path) {
    const auto& names = file.attributes.material_files;
    if (path.empty() || names.empty()) return;
    material_looks looks;
    bool has_transparency = false;
    for (const std::string& name : names)
        read_material_file(path.parent_path() / name, looks, has_transparency);
    const auto& parts = file.attributes.parts;
    std::vector<std::uint32_t> colors(file.stored_faces, 0xffffffffU);
    bool used = false;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto found = looks.find(parts[p].material);
        if (found == looks.end() || !found->second.diffuse) continue;
        used = used || !parts[p].material.empty();
        const std::size_t end = p + 1 < parts.size() ? parts[p + 1].first_face : file.stored_faces;
        std::fill(colors.begin() + parts[p].first_face,
                  colors.begin() + static_cast<std::ptrdiff_t>(end), found->second.color());
    }
    if (!used) return;
    add_color_columns(file.attributes.find_or_add("face", colors.size()), colors);
    if (has_transparency)
        file.warnings.push_back({"materials",
                                 "transparency Tr of materials was not read, since programs "
                                 "disagree on its meaning; d is read"});
}

struct line_counts {
    std::size_t vertices = 0;
    std::size_t textures = 0;
    std::size_t normals = 0;
    std::size_t faces = 0;
};

/// Lines that start with "v ", "vt ", "vn " and "f ", so that arrays get their size at once. Only a
/// hint: files with carriage returns alone, or indented ones, make the arrays grow.
line_counts count_lines(const source& in) {
    line_counts counts;
    const char* at = in.begin();
    while (in.end() - at > 1) {
        if (at[1] == ' ') {
            counts.vertices += *at == 'v' ? 1U : 0U;
            counts.faces += *at == 'f' ? 1U : 0U;
        } else if (*at == 'v' && in.end() - at > 2 && at[2] == ' ') {
            counts.textures += at[1] == 't' ? 1U : 0U;
            counts.normals += at[1] == 'n' ? 1U : 0U;
        }
        const void* newline = std::memchr(at, '\n', static_cast<std::size_t>(in.end() - at));
        if (newline == nullptr) break;
        at = static_cast<const char*>(newline) + 1;
        in.release_before(at);
    }
    in.rewind();
    return counts;
}

/// One pass over the text. Faces may name rows that follow; what they may name at most is known
/// only at the end, so the first pass takes any number, and when one proves too large a second pass
/// with the right limits finds its line.
class obj_reader {
  public:
    explicit obj_reader(const source& in, const obj_row_counts& limits = {})
        : text_(in), vertices_("vertex", limits.vertices), corners_(limits), faces_(file_) {
        file_.format = "obj";
    }

    void reserve(const line_counts& counts) {
        reserve_large(file_.mesh.points, counts.vertices);
        reserve_large(file_.mesh.faces, counts.faces);
        corners_.reserve(counts.textures, counts.normals, counts.faces);
    }

    void read() {
        while (!text_.text_done()) {
            statement();
            text_.skip_line();
            text_.file.release_before(text_.at);
        }
        const auto [vertices, textures, normals] = counts();
        if (std::max({vertices, textures, normals, std::uint64_t{file_.mesh.faces.size()}}) >
            obj_row_counts::any)
            text_.file.fail("more vertices or triangles than 32-bit numbers can name");
        if (file_.mesh.points.empty() && file_.mesh.faces.empty() && has_other_lines_)
            text_.file.fail("no vertices or faces found: not an OBJ file?");
    }

    /// True when each row that a corner names is there.
    [[nodiscard]] bool in_range() const {
        return vertices_.needed() <= file_.mesh.points.size() && corners_.in_range();
    }
    [[nodiscard]] obj_row_counts counts() const {
        return {file_.mesh.points.size(), corners_.values().texture.size(),
                corners_.values().normals.size()};
    }

    [[nodiscard]] mesh_file take() {
        store_colors();
        if (skipped_elements_ > 0)
            file_.warnings.push_back(
                {"skipped-elements",
                 std::to_string(skipped_elements_) + " point and line elements were not read"});
        if (odd_vertices_ > 0)
            file_.warnings.push_back(
                {"skipped-numbers", std::to_string(odd_vertices_) +
                                        " vertices have more numbers, such as weights, which "
                                        "were not read"});
        faces_.remark(file_.warnings);
        text_.remark(file_.warnings);
        file_.attributes.corners = corners_.take(file_.warnings);
        if (file_.mesh.faces.empty()) store_looks();
        file_.stored_as = fits_float32(file_.mesh.points) ? precision::float32 : precision::float64;
        return std::move(file_);
    }

  private:
    void statement() {
        const char first = *text_.at;
        const char second = text_.end - text_.at > 1 ? text_.at[1] : '\n';
        const bool one_letter = is_space(second);
        if (first == 'v' && one_letter) return vertex();
        if (first == 'f' && one_letter) return face_line();
        if ((first == 'l' || first == 'p') && one_letter) ++skipped_elements_;
        if ((first == 'o' || first == 'g') && one_letter) return name(first);
        if (first == 'u' && text_.starts_with("usemtl")) return name(first);
        if (first == '\0') text_.fail("a zero byte: binary data, not text");
        if (starts_statement("mtllib")) return material_files();
        has_other_lines_ = true;
        if (starts_statement("vt")) return corners_.texture(text_);
        if (starts_statement("vn")) return corners_.normal(text_);
        // Anything else is left out. Where such a statement is continued, the next line starts with
        // a number and is left out in its turn.
    }

    [[nodiscard]] bool starts_statement(std::string_view keyword) const {
        const auto length = static_cast<std::ptrdiff_t>(keyword.size());
        return text_.starts_with(keyword) && text_.end - text_.at > length &&
               is_space(text_.at[length]);
    }

    void vertex() {
        ++text_.at;
        const double x = coordinate();
        const double y = coordinate();
        const double z = coordinate();
        if (!statement_done(text_)) rest_of_vertex();
        file_.mesh.points.push_back({x, y, z});
    }
    [[nodiscard]] double coordinate() {
        (void)statement_done(text_);
        return text_.number("a coordinate");
    }

    /// One more number is the weight of a rational curve's point, which is no coordinate; three are
    /// a color. What else there is, is counted.
    void rest_of_vertex() {
        double more[3] = {};
        std::size_t count = 0;
        for (; !statement_done(text_); ++count) {
            const double value = text_.number("a number");
            if (count < 3) more[count] = value;
        }
        if (count > 3 || (count == 1 && more[0] != 1.0) || count == 2) ++odd_vertices_;
        if (count < 3) return;
        has_colors_ = true;
        if (colors_.size() == 3 * file_.mesh.points.size())
            colors_.insert(colors_.end(), more, more + 3);
    }

    void face_line() {
        ++text_.at;
        faces_.begin();
        for (std::size_t i = 0; !statement_done(text_); ++i) corner(i);
        if (faces_.finish() && new_part_) start_part();
    }

    /// v, v/vt, v//vn or v/vt/vn; a slash too many at the end is none.
    void corner(std::size_t number) {
        const char* const start = text_.at;
        const std::size_t triangles = file_.mesh.faces.size();
        faces_.add(vertices_.read(text_, file_.mesh.points.size()));
        corners_.add(text_, number, triangles);
        if (text_.done() || is_space(*text_.at) || *text_.at == '#' || *text_.at == '\\') return;
        text_.at = start;
        text_.fail("expected a corner, found " + quoted(start, text_.end));
    }

    /// Names of files, between blanks; those within a name can be told only where names end as
    /// usual.
    void material_files() {
        (void)text_.word();
        std::string_view names = text_.rest_of_line();
        while (!names.empty()) {
            const std::size_t end = end_of_name(names);
            add_material_file(std::string(names.substr(0, end)));
            names.remove_prefix(end);
            while (!names.empty() && is_blank(names.front())) names.remove_prefix(1);
        }
    }
    [[nodiscard]] static std::size_t end_of_name(std::string_view names) {
        constexpr std::string_view ending = ".mtl";
        for (std::size_t i = 0; i + ending.size() < names.size(); ++i)
            if (is_blank(names[i + ending.size()]) &&
                starts_with_word(names.data() + i, names.data() + names.size(), ending))
                return i + ending.size();
        return names.size();
    }
    void add_material_file(std::string name) {
        if (known_material_files_.insert(name).second)
            file_.attributes.material_files.push_back(std::move(name));
    }

    void name(char kind) {
        (void)text_.word();
        const std::string_view name = text_.rest_of_line();
        (kind == 'o' ? part_.object : kind == 'g' ? part_.group : part_.material) = name;
        if (kind == 'o') part_.group.clear();
        new_part_ = true;
    }
    void start_part() {
        part_.first_face = static_cast<std::uint32_t>(file_.stored_faces - 1);
        file_.attributes.parts.push_back(part_);
        new_part_ = false;
    }

    void store_colors() {
        if (!has_colors_) return;
        const std::size_t count = file_.mesh.points.size();
        if (colors_.size() != 3 * count) {
            file_.warnings.push_back(
                {"vertex-colors", "only some vertices have a color; no colors were kept"});
            return;
        }
        element& vertices = file_.attributes.find_or_add("vertex", count);
        for (std::size_t c = 0; c < 3; ++c)
            vertices.columns.push_back(
                column_of<double>(std::array{"red", "green", "blue"}[c], count,
                                  [&](std::size_t v) { return colors_[3 * v + c]; }));
    }

    /// Of a cloud, normals and texture coordinates are those of its points where there is one of
    /// each.
    void store_looks() {
        corner_values& corners = file_.attributes.corners;
        const std::size_t count = file_.mesh.points.size();
        const auto add = [&](auto& rows, std::initializer_list<const char*> names) {
            if (count == 0 || rows.size() != count) return;
            element& vertices = file_.attributes.find_or_add("vertex", count);
            std::size_t k = 0;
            for (const char* const name : names) {
                vertices.columns.push_back(
                    column_of<double>(name, count, [&](std::size_t v) { return rows[v][k]; }));
                ++k;
            }
            rows.clear();
        };
        add(corners.texture, {"s", "t"});
        add(corners.normals, {"nx", "ny", "nz"});
    }

    text text_;
    obj_numbers vertices_;
    obj_corners corners_;
    mesh_file file_{};
    face_sink faces_;
    named_faces part_{};
    std::set<std::string> known_material_files_{};
    bool new_part_ = false;
    std::size_t skipped_elements_ = 0;
    std::size_t odd_vertices_ = 0;
    bool has_other_lines_ = false;  ///< than comments, vertices, faces, elements, names
    bool has_colors_ = false;
    std::vector<double> colors_{};  ///< [3 * vertices] as long as every vertex has one
};

}  // namespace

mesh_file read_obj(const source& in, const std::filesystem::path& path) {
    obj_reader reader(in);
    reader.reserve(count_lines(in));
    reader.read();
    if (!reader.in_range()) {
        obj_row_counts limits = reader.counts();
        if (limits.textures == 0) limits.textures = obj_row_counts::any;
        if (limits.normals == 0) limits.normals = obj_row_counts::any;
        obj_reader(in, limits).read();
    }
    mesh_file file = reader.take();
    add_material_colors(file, path);
    return file;
}

}  // namespace treeform::detail::io
