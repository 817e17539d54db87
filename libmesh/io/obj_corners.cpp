#include <libmesh/io/obj_corners.hpp>
#include <libmesh/io/scratch.hpp>

#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace treeform::detail::io {

namespace {

/// What programs print where a computation has no number: "-nan(ind)", "1.#QNAN0", "-1.#IND".
/// Normals of faces without an area are full of them, and no reason to refuse the mesh.
[[nodiscard]] bool stands_for_nan(std::string_view word) {
    return word.find(".#") != std::string_view::npos || word.find("nan(") != std::string_view::npos;
}

[[nodiscard]] double number(text& t, std::string_view what) {
    const char* const start = t.at;
    const parsed<double> n = parse_number(t.at, t.end);
    if (n.end == nullptr || n.end == t.end || is_space(*n.end)) return t.number(what);
    if (stands_for_nan(t.word())) return std::numeric_limits<double>::quiet_NaN();
    t.at = start;
    return t.number(what);
}

/// The numbers of a statement, `least` to three of them; how many.
std::size_t numbers(text& t, std::size_t least, std::string_view what,
                    std::array<double, 3>& values) {
    t.at += 2;  // the keyword
    std::size_t count = 0;
    for (; !statement_done(t); ++count) {
        if (count == 3) t.fail("more than three numbers");
        values[count] = number(t, what);
    }
    if (count < least) t.fail("expected " + std::string(what) + ", but the line ends");
    return count;
}

/// A number behind a slash, if there is one.
[[nodiscard]] std::uint32_t number_behind_slash(text& t, obj_numbers& numbers, std::size_t count) {
    if (t.at == t.end || *t.at != '/') return corner_values::none;
    ++t.at;
    const bool given = t.at < t.end && (is_digit(*t.at) || *t.at == '-' || *t.at == '+');
    return given ? numbers.read(t, count) : corner_values::none;
}

}  // namespace

void obj_numbers::refuse(const text& t, const parsed<std::int64_t>& index) const {
    const std::string kind(kind_);
    if (index.end == nullptr) t.fail("expected a " + kind + " index, found " + quoted(t.at, t.end));
    if (index.value == 0) t.fail(kind + " index 0 (OBJ counts from 1)");
    t.fail(kind + " index " + quoted(t.at, index.end) + " is out of range");
}

void corner_fans::start(std::size_t triangles, std::size_t expected, std::vector<face>& fans) {
    used_ = true;
    reserve_large(fans, std::max(expected, triangles));
    fans.assign(triangles, {corner_values::none, corner_values::none, corner_values::none});
}

void obj_corners::reserve(std::size_t textures, std::size_t normals, std::size_t triangles) {
    reserve_large(values_.texture, textures);
    reserve_large(values_.normals, normals);
    expected_triangles_ = triangles;
}

void obj_corners::texture(text& t) {
    std::array<double, 3> row{};
    if (numbers(t, 1, "a texture coordinate", row) == 3) values_.has_w = true;
    values_.texture.push_back(row);
}

void obj_corners::normal(text& t) {
    std::array<double, 3> row{};
    (void)numbers(t, 3, "a coordinate of a normal", row);
    values_.normals.push_back({row[0], row[1], row[2]});
}

corner_values obj_corners::take(std::vector<io_warning>& warnings) {
    if (lacks_textures()) {
        values_.texture_of_corner.clear();
        warnings.push_back({"no-texture-coordinates",
                            "corners refer to texture coordinates, but the file has none"});
    }
    if (lacks_normals()) {
        values_.normal_of_corner.clear();
        warnings.push_back({"no-normals", "corners refer to normals, but the file has none"});
    }
    return std::move(values_);
}

void obj_corners::add_numbers(text& t, std::size_t corner, std::size_t triangles) {
    const std::uint32_t texture = number_behind_slash(t, textures_, values_.texture.size());
    const std::uint32_t normal = number_behind_slash(t, normals_, values_.normals.size());
    texture_fans_.add(texture, corner, triangles, expected_triangles_, values_.texture_of_corner);
    normal_fans_.add(normal, corner, triangles, expected_triangles_, values_.normal_of_corner);
}

}  // namespace treeform::detail::io
