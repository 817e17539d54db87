#include <libmesh/io/face_looks.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace treeform::detail::io {

namespace {

constexpr std::uint32_t white = 0xffffffff;

/// 0xRRGGBBAA.
[[nodiscard]] std::uint32_t color_of_row(const std::vector<const column*>& columns, std::size_t row,
                                         bool& is_rounded) {
    std::uint32_t color = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        const double value = c < columns.size() ? color_value(*columns[c], row) : 1.0;
        const double share = value > 0.0 ? std::min(value, 1.0) : 0.0;  // of NaN: none
        const auto channel = static_cast<std::uint32_t>(std::lround(share * 255.0));
        is_rounded = is_rounded || !(std::abs(channel - value * 255.0) < 1e-3);
        color = color << 8 | channel;
    }
    return color;
}

}  // namespace

face_looks::face_looks(const write_job& job) {
    const mesh_file& file = job.file;
    const auto& parts = file.attributes.parts;
    const auto of_faces = color_columns(file, "face");
    auto of_points = color_columns(job.vertices);
    const bool named =
        std::any_of(parts.begin(), parts.end(), [](const part& p) { return !p.material.empty(); });
    leaves_out_points_ = (named || !of_faces.empty()) && !of_points.empty();
    if (leaves_out_points_) of_points.clear();
    lacks_colors_ = named && of_faces.empty() && !file.attributes.material_files.empty();
    if (!named && of_faces.empty() && of_points.empty()) return;
    const std::string nameless;
    std::size_t next = 0;
    for (std::uint32_t f = 0; f < file.mesh.faces.size(); ++f) {
        const std::size_t row = face_row(file, f);
        while (next < parts.size() && parts[next].first_face <= row) ++next;
        const std::string& material = next > 0 ? parts[next - 1].material : nameless;
        const std::uint32_t color =
            of_faces.empty() ? white : color_of_row(of_faces, row, rounds_colors_);
        face_look look;
        if (!material.empty()) {
            look.list = look_list::materials;
            look.entries.fill(material_entry(material, color));
        } else if (!of_points.empty()) {
            look.list = look_list::colors;
            for (std::size_t k = 0; k < 3; ++k)
                look.entries[k] =
                    color_entry(color_of_row(of_points, file.mesh.faces[f][k], rounds_colors_));
        } else {
            look.list = look_list::colors;
            look.entries.fill(color_entry(color));
        }
        looks_.push_back(look);
    }
}

std::uint32_t face_looks::color_entry(std::uint32_t color) {
    const auto number = static_cast<std::uint32_t>(colors_.size());
    const auto [at, is_new] = number_of_color_.emplace(color, number);
    if (is_new) colors_.push_back(color);
    return at->second;
}

std::uint32_t face_looks::material_entry(const std::string& name, std::uint32_t color) {
    const auto number = static_cast<std::uint32_t>(materials_.size());
    const auto [at, is_new] = number_of_material_.emplace(std::pair(name, color), number);
    if (is_new) materials_.emplace_back(name, color);
    return at->second;
}

}  // namespace treeform::detail::io
