#include <libmesh/attributes/scene_parts.hpp>
#include <libmesh/io/formats.hpp>
#include <libmesh/io/parts_glb.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace treeform::detail::io {

namespace {

constexpr std::size_t most_colors = 256;
constexpr color_glb full{1.0, 1.0, 1.0, 1.0};
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// [F] Number of the material of each triangle; none when there are too many.
[[nodiscard]] std::vector<std::uint32_t> materials_of(const write_job& job, layout_glb& layout) {
    const mesh_file& file = job.file;
    const auto columns = color_columns(file.attributes.find("face"));
    layout.has_colors = !columns.empty();
    std::vector<std::uint32_t> material(file.mesh.faces.size(), 0);
    std::map<color_glb, std::uint32_t> number;
    for (std::uint32_t f = 0; f < material.size(); ++f) {
        color_glb rgba = full;
        for (std::size_t c = 0; c < columns.size(); ++c)
            rgba[c] = color_value(*columns[c], face_row(file, f));
        const auto [at, added] =
            number.emplace(rgba, static_cast<std::uint32_t>(layout.materials.size()));
        if (added) layout.materials.push_back(rgba);
        if (layout.materials.size() > most_colors) {
            job.result.warnings.push_back(
                {"colors-dropped",
                 "faces have more than 256 different colors; no face colors were written"});
            layout.materials.assign(1, full);
            layout.has_colors = false;
            return std::vector<std::uint32_t>(material.size(), 0);
        }
        material[f] = at->second;
    }
    return material;
}

/// Where parts start: triangles and names. The first starts at 0.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::string>> starts_of(const mesh_file& file) {
    std::vector<std::pair<std::uint32_t, std::string>> starts{{0, {}}};
    std::size_t next = 0;
    const auto& parts = file.attributes.parts;
    for (std::uint32_t f = 0; f < file.mesh.faces.size() && next < parts.size(); ++f) {
        if (parts[next].first_face > face_row(file, f)) continue;
        while (next < parts.size() && parts[next].first_face <= face_row(file, f)) ++next;
        std::string name = part_name(parts[next - 1]);
        if (name == starts.back().second) continue;
        if (starts.back().first == f)
            starts.back().second = std::move(name);
        else
            starts.emplace_back(f, std::move(name));
    }
    return starts;
}

class part_builder {
  public:
    part_builder(const mesh_file& file, bool keeps_all) : file_(file), keeps_all_(keeps_all) {}

    void add_vertices(part_glb& part) const {
        if (keeps_all_) {
            for (std::uint32_t v = 0; v < file_.mesh.points.size(); ++v)
                part.vertices.push_back({v});
        } else {
            for_each_corner(part, [&](std::uint32_t f, std::size_t k) {
                part.vertices.push_back(vertex(f, k));
            });
            std::ranges::sort(part.vertices);
            part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()),
                                part.vertices.end());
        }
        for_each_corner(part, [&](std::uint32_t f, std::size_t k) {
            if (k == 0) part.faces.emplace_back();
            part.faces.back()[k] = number(part, f, k);
        });
    }

  private:
    template <class F>
    static void for_each_corner(const part_glb& part, F&& f) {
        for (const primitive_glb& p : part.primitives)
            for (const std::uint32_t triangle : p.triangles)
                for (std::size_t k = 0; k < 3; ++k) f(triangle, k);
    }
    [[nodiscard]] vertex_glb vertex(std::uint32_t f, std::size_t corner) const {
        const corner_values& values = file_.attributes.corners;
        vertex_glb v{.point = file_.mesh.faces[f][corner]};
        if (!values.texture_of_corner.empty()) v.texture = values.texture_of_corner[f][corner];
        if (!values.normal_of_corner.empty()) v.normal = values.normal_of_corner[f][corner];
        return v;
    }
    [[nodiscard]] std::uint32_t number(const part_glb& part, std::uint32_t f,
                                       std::size_t corner) const {
        if (keeps_all_) return file_.mesh.faces[f][corner];
        const auto at =
            std::lower_bound(part.vertices.begin(), part.vertices.end(), vertex(f, corner));
        return static_cast<std::uint32_t>(at - part.vertices.begin());
    }

    const mesh_file& file_;
    bool keeps_all_;
};

[[nodiscard]] bool is_in_range(const std::array<double, 2>& uv) {
    constexpr double most = std::numeric_limits<float>::max();
    return std::abs(uv[0]) < most && std::abs(uv[1]) < most;
}

}  // namespace

layout_glb lay_out(const write_job& job) {
    layout_glb layout;
    const mesh_file& file = job.file;
    const std::vector<std::uint32_t> material = materials_of(job, layout);
    const auto starts = starts_of(file);
    const corner_values& corners = file.attributes.corners;
    const bool keeps_all =
        starts.size() == 1 && corners.texture_of_corner.empty() && corners.normal_of_corner.empty();
    const std::size_t unused = keeps_all ? 0 : count_loose_points(file.mesh);
    if (unused > 0)
        job.result.warnings.push_back(
            {"data-dropped", std::to_string(unused) + " points without faces left out"});
    for (std::size_t s = 0; s < starts.size(); ++s) {
        const std::size_t end =
            s + 1 < starts.size() ? starts[s + 1].first : file.mesh.faces.size();
        part_glb part{.name = starts[s].second};
        std::map<std::uint32_t, std::size_t> primitive_of;
        for (std::uint32_t f = starts[s].first; f < end; ++f) {
            const auto [at, added] = primitive_of.emplace(material[f], part.primitives.size());
            if (added) part.primitives.push_back({.material = material[f]});
            part.primitives[at->second].triangles.push_back(f);
        }
        part_builder(file, keeps_all).add_vertices(part);
        layout.parts.push_back(std::move(part));
    }
    return layout;
}

attributes_glb::attributes_glb(const write_job& job) : file_(job.file), vertices_(job.vertices) {
    normals_ = scalar_columns(vertices_, {"nx", "ny", "nz"});
    texture_ = scalar_columns(vertices_, {"s", "t"});
    if (texture_.empty()) texture_ = scalar_columns(vertices_, {"u", "v"});
    if (texture_.empty()) texture_ = scalar_columns(vertices_, {"texture_u", "texture_v"});
    colors_ = color_columns(vertices_);
    for (const scalar_type type : {scalar_type::uint8, scalar_type::uint16})
        if (std::ranges::all_of(colors_, [&](const column* c) { return c->type == type; }))
            color_type_ = type;
}

point3 attributes_glb::stored_normal(const vertex_glb& v) const {
    const corner_values& corners = file_.attributes.corners;
    if (!corners.normal_of_corner.empty())
        return v.normal == corner_values::none ? point3{} : corners.normals[v.normal];
    if (normals_.empty()) return {};
    return {normals_[0]->number(v.point), normals_[1]->number(v.point),
            normals_[2]->number(v.point)};
}

std::array<double, 2> attributes_glb::stored_texture(const vertex_glb& v) const {
    const corner_values& corners = file_.attributes.corners;
    if (!corners.texture_of_corner.empty()) {
        if (v.texture == corner_values::none) return {not_given, not_given};
        return {corners.texture[v.texture][0], corners.texture[v.texture][1]};
    }
    if (texture_.empty()) return {not_given, not_given};
    return {texture_[0]->number(v.point), texture_[1]->number(v.point)};
}

std::size_t attributes_glb::count_normals(const part_glb& part) const {
    return static_cast<std::size_t>(std::ranges::count_if(part.vertices, [&](const vertex_glb& v) {
        const point3 n = stored_normal(v);
        const double length = std::hypot(n.x, n.y, n.z);
        return length > 0.0 && std::isfinite(length);
    }));
}

std::size_t attributes_glb::count_texture(const part_glb& part) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        part.vertices, [&](const vertex_glb& v) { return is_in_range(stored_texture(v)); }));
}

std::array<float, 3> attributes_glb::normal(const vertex_glb& v) const {
    const point3 n = stored_normal(v);
    const double length = std::hypot(n.x, n.y, n.z);
    // What is as near to 1 as float32 allows stays as it is.
    const double by = std::abs(length - 1.0) < 1e-6 ? 1.0 : 1.0 / length;
    return {static_cast<float>(n.x * by), static_cast<float>(n.y * by),
            static_cast<float>(n.z * by)};
}

std::array<float, 2> attributes_glb::texture(const vertex_glb& v) const {
    const auto uv = stored_texture(v);
    if (!is_in_range(uv)) return {0.0F, 0.0F};
    return {static_cast<float>(uv[0]), static_cast<float>(1.0 - uv[1])};
}

double attributes_glb::color_share(const column& c, std::size_t row) {
    const double value = color_value(c, row);
    return value > 0.0 ? std::min(value, 1.0) : 0.0;  // of NaN: none
}

std::vector<std::string> attributes_glb::left_out() const {
    std::vector<std::string> names;
    if (vertices_ == nullptr) return names;
    for (const column& c : vertices_->columns) {
        bool is_written = c.role != column_role::data;
        for (const auto* const written : {&normals_, &texture_, &colors_})
            is_written =
                is_written || std::find(written->begin(), written->end(), &c) != written->end();
        if (!is_written) names.push_back(c.name);
    }
    return names;
}

}  // namespace treeform::detail::io
