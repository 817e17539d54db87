#include <libmesh/io/material_colors.hpp>
#include <libmesh/io/text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace treeform::detail::io {

namespace {

using rgba = std::array<std::uint8_t, 4>;

constexpr rgba no_color{255, 255, 255, 255};

struct material_look {
    std::optional<std::array<double, 3>> diffuse{};
    double opacity = 1.0;

    [[nodiscard]] rgba color() const {
        const auto byte = [](double share) {
            return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255.0));
        };
        const auto& [r, g, b] = *diffuse;
        return {byte(r), byte(g), byte(b), byte(opacity)};
    }
};

/// By name; the first of a name is meant, as where files say the same twice.
using material_looks = std::map<std::string, material_look, std::less<>>;

class material_reader {
  public:
    material_reader(const source& in, material_looks& looks, bool& has_transparency)
        : text_(in), looks_(looks), has_transparency_(has_transparency) {}

    void read() {
        while (!text_.text_done()) {
            statement(text_.word());
            text_.skip_line();
        }
    }

  private:
    void statement(std::string_view keyword) {
        if (keyword == "newmtl") {
            const auto [at, is_new] =
                looks_.try_emplace(std::string(text_.rest_of_line()), material_look{});
            now_ = is_new ? &at->second : nullptr;
        }
        if (now_ == nullptr) return;
        if (keyword == "Kd") {
            const auto r = number(), g = number(), b = number();
            if (r) now_->diffuse = {*r, g.value_or(*r), b.value_or(*r)};
        } else if (keyword == "d") {
            now_->opacity = number().value_or(1.0);
        } else if (keyword == "Tr") {
            has_transparency_ = has_transparency_ || number().value_or(0.0) != 0.0;
        }
    }

    [[nodiscard]] std::optional<double> number() {
        if (text_.line_done()) return std::nullopt;
        const parsed<double> n = parse_number(text_.at, text_.end);
        if (n.end == nullptr || !std::isfinite(n.value)) return std::nullopt;
        return text_.take(n);
    }

    text text_;
    material_looks& looks_;
    bool& has_transparency_;
    material_look* now_ = nullptr;
};

/// Of a regular file: nothing else is waited for.
void read_material_file(const std::filesystem::path& path, material_looks& looks,
                        bool& has_transparency) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return;
    try {
        const source in = source::open(path);
        material_reader(in, looks, has_transparency).read();
    } catch (const io_error&) {
        return;  // as one that is not there
    }
}

[[nodiscard]] std::vector<rgba> colors_of_faces(const mesh_file& file,
                                                const material_looks& looks) {
    std::vector<rgba> colors(file.stored_faces, no_color);
    const auto& parts = file.attributes.parts;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto found = looks.find(parts[p].material);
        if (found == looks.end() || !found->second.diffuse) continue;
        const std::size_t end = p + 1 < parts.size() ? parts[p + 1].first_face : file.stored_faces;
        std::fill(colors.begin() + parts[p].first_face,
                  colors.begin() + static_cast<std::ptrdiff_t>(end), found->second.color());
    }
    return colors;
}

}  // namespace

void add_material_colors(mesh_file& file, const std::filesystem::path& path) {
    const auto& names = file.attributes.material_files;
    if (path.empty() || names.empty()) return;
    material_looks looks;
    bool has_transparency = false;
    for (const std::string& name : names)
        read_material_file(path.parent_path() / name, looks, has_transparency);
    const auto& parts = file.attributes.parts;
    const bool used = std::any_of(parts.begin(), parts.end(), [&](const part& p) {
        const auto found = looks.find(p.material);
        return !p.material.empty() && found != looks.end() && found->second.diffuse;
    });
    if (!used) return;
    const std::vector<rgba> colors = colors_of_faces(file, looks);
    const bool opaque =
        std::all_of(colors.begin(), colors.end(), [](const rgba& c) { return c[3] == 255; });
    constexpr std::array<const char*, 4> channels{"red", "green", "blue", "alpha"};
    element& faces = file.attributes.find_or_add("face", colors.size());
    for (std::size_t c = 0; c < (opaque ? 3U : 4U); ++c) {
        std::vector<std::uint8_t> values(colors.size());
        std::transform(colors.begin(), colors.end(), values.begin(),
                       [&](const rgba& color) { return color[c]; });
        faces.columns.push_back(column::of<std::uint8_t>(channels[c], values));
    }
    if (has_transparency)
        file.warnings.push_back({"materials",
                                 "transparency Tr of materials was not read, since programs "
                                 "disagree on its meaning; d is read"});
}

}  // namespace treeform::detail::io
