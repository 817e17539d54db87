#include <libmesh/io/colors_3mf.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::uint32_t no_texture = corner_values::none;

void append_corners(std::vector<face>& to, std::size_t first_face, const std::vector<face>& more,
                    bool turned, std::uint32_t none) {
    if (more.empty()) return;
    to.resize(first_face, face{none, none, none});
    to.insert(to.end(), more.begin(), more.end());
    if (turned)
        for (std::size_t f = first_face; f < to.size(); ++f) std::swap(to[f][1], to[f][2]);
}

/// Columns red, green and blue, and alpha unless all is opaque.
void add_color_columns(mesh_file& file, const char* element_name,
                       std::span<const std::uint32_t> colors) {
    constexpr const char* names[] = {"red", "green", "blue", "alpha"};
    const bool opaque = std::all_of(colors.begin(), colors.end(),
                                    [](std::uint32_t c) { return (c & 0xffU) == 0xffU; });
    element& e = file.attributes.find_or_add(element_name, colors.size());
    for (unsigned channel = 0; channel < (opaque ? 3U : 4U); ++channel) {
        std::vector<std::uint8_t> values(colors.size());
        std::transform(colors.begin(), colors.end(), values.begin(), [&](std::uint32_t c) {
            return static_cast<std::uint8_t>(c >> (24 - 8 * channel));
        });
        e.columns.push_back(column::of<std::uint8_t>(names[channel], values));
    }
}

/// The palette number of each point; none where a face or two faces want several.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> colors_of_points(
    const mesh& mesh, const std::vector<face>& colors) {
    std::vector<std::uint32_t> of_point(mesh.points.size(), 0);
    for (std::size_t f = 0; f < colors.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& at = of_point[mesh.faces[f][k]];
            if (colors[f][k] == 0 || (at != 0 && at != colors[f][k])) return std::nullopt;
            at = colors[f][k];
        }
    return of_point;
}

[[nodiscard]] std::vector<std::uint32_t> looked_up(std::vector<std::uint32_t> numbers,
                                                   const model_3mf& model) {
    for (std::uint32_t& n : numbers) n = model.palette[n];
    return numbers;
}

/// Makes equal colors of several groups one number.
void unite_equal_colors(const model_3mf& model, std::vector<face>& colors) {
    std::unordered_map<std::uint32_t, std::uint32_t> number_of_color;
    std::vector<std::uint32_t> number(model.palette.size(), 0);
    for (std::uint32_t n = 1; n < number.size(); ++n)
        number[n] = number_of_color.emplace(model.palette[n], n).first->second;
    for (face& c : colors)
        for (std::uint32_t& n : c) n = number[n];
}

void add_colors(const model_3mf& model, std::vector<face>&& colors, mesh_file& file) {
    if (colors.empty()) return;
    colors.resize(file.mesh.faces.size());
    unite_equal_colors(model, colors);
    const auto mixed = std::count_if(colors.begin(), colors.end(),
                                     [](const face& c) { return c[0] != c[1] || c[0] != c[2]; });
    if (mixed > 0)
        if (const auto of_points = colors_of_points(file.mesh, colors))
            return add_color_columns(file, "vertex", looked_up(*of_points, model));
    std::vector<std::uint32_t> of_faces(colors.size());
    std::transform(colors.begin(), colors.end(), of_faces.begin(),
                   [](const face& c) { return c[0]; });
    add_color_columns(file, "face", looked_up(std::move(of_faces), model));
    if (mixed > 0)
        file.warnings.push_back(
            {"colors",
             std::to_string(mixed) + " faces have several colors, of which one was read"});
}

}  // namespace

void append_looks(looks_3mf& to, std::size_t first_face, const object_3mf& object, bool turned) {
    append_corners(to.colors, first_face, object.colors, turned, 0);
    append_corners(to.texture, first_face, object.texture, turned, no_texture);
}

void add_looks(const model_3mf& model, looks_3mf&& looks, mesh_file& file) {
    add_colors(model, std::move(looks.colors), file);
    if (looks.texture.empty()) return;
    looks.texture.resize(file.mesh.faces.size(), face{no_texture, no_texture, no_texture});
    file.attributes.corners.texture = model.texture;
    file.attributes.corners.texture_of_corner = std::move(looks.texture);
}

}  // namespace treeform::detail::io
