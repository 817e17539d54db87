#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/base/used_points.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/formats.hpp>

#include <algorithm>
#include <string>

namespace treeform::detail::io {

namespace {

using held = columns_held;

constexpr holdings of_stl{.faces = held::attribute, .has_faces = true, .names = true};
constexpr holdings of_obj{.points = held::looks,
                          .has_faces = true,
                          .texture = true,
                          .depth = true,
                          .normals = true,
                          .names = true,
                          .materials = true};
constexpr holdings of_ply{.points = held::all,
                          .faces = held::all,
                          .alpha = true,
                          .has_faces = true,
                          .elements = true,
                          .texture = true,
                          .texture_files = true,
                          .comments = true,
                          .remarks = true};
constexpr holdings of_off{
    .points = held::looks, .faces = held::colors, .alpha = true, .has_faces = true};
constexpr holdings of_table{.points = held::numbers, .alpha = true};
constexpr holdings of_pcd{
    .points = held::numbers, .alpha = true, .comments = true, .remarks = true};
constexpr holdings of_las{.points = held::numbers, .alpha = true, .system = true};
/// Which columns it leaves out, its writer says.
constexpr holdings of_glb{.points = held::all,
                          .faces = held::all,
                          .alpha = true,
                          .has_faces = true,
                          .texture = true,
                          .normals = true,
                          .names = true};
constexpr holdings of_3mf{.points = held::colors,
                          .faces = held::colors,
                          .alpha = true,
                          .has_faces = true,
                          .names = true,
                          .materials = true,
                          .remarks = true};

constexpr known_format formats[] = {
    {"stl", "stl-binary", "stl-ascii", write_stl_binary, write_stl_text, true, false, nullptr,
     of_stl},
    {"obj", "", "obj", nullptr, write_obj, false, false, start_obj_points, of_obj},
    {"ply", "ply-binary-le", "ply-ascii", write_ply, write_ply, false, false, start_ply_points,
     of_ply},
    {"off", "", "off", nullptr, write_off, false, false, nullptr, of_off},
    {"xyz", "", "xyz", nullptr, write_xyz, false, false, start_xyz_points, of_table},
    {"csv", "", "csv", nullptr, write_csv, false, false, start_csv_points, of_table},
    {"pcd", "pcd-binary", "pcd-ascii", write_pcd, write_pcd, false, false, start_pcd_points,
     of_pcd},
    {"las", "las", "", write_las, nullptr, false, false, start_las_points, of_las},
    {"laz", "laz", "", write_laz, nullptr, false, false, start_laz_points, of_las},
    {"glb", "glb", "", write_glb, nullptr, true, false, nullptr, of_glb},
    {"3mf", "3mf", "", write_3mf, nullptr, false, true, nullptr, of_3mf},
};

[[nodiscard]] bool is_held(const column& c, held what, bool alpha) {
    using attribute::column_use;
    if (c.role != column_role::data || what == held::all) return true;
    // What `add_source_columns` adds for those who can use it.
    if (c.name == "source_mesh" || c.name == "source_face") return true;
    if (c.list_length) return false;
    if (what == held::numbers) return true;
    if (what == held::attribute) return c.name == "stl_attribute";
    if (what == held::none || (c.name == "alpha" && !alpha)) return false;
    return attribute::is_use(c.name, column_use::color) ||
           (what == held::looks && (attribute::is_use(c.name, column_use::normal) ||
                                    attribute::is_use(c.name, column_use::texture)));
}

[[nodiscard]] bool has_system(const las_header& las) {
    const auto is_one = [](const las_record& r) {
        return r.user_id.c_str() == std::string_view("LASF_Projection");
    };
    return std::ranges::any_of(las.records, is_one) ||
           std::ranges::any_of(las.extended_records, is_one);
}

/// "a, b of points"
void add_names(std::string& list, const element* e, held what, bool alpha, std::string_view whose) {
    if (e == nullptr) return;
    std::string names;
    for (const column& c : e->columns)
        if (!is_held(c, what, alpha)) names += (names.empty() ? "" : ", ") + c.name;
    if (names.empty()) return;
    list += (list.empty() ? "" : "; ") + names + " of " + std::string(whose);
}

/// Columns, a list for each element.
[[nodiscard]] std::string columns_left_out(const known_format& format, const mesh_file& file,
                                           const element* points, bool text) {
    const holdings& holds = format.holds;
    std::string columns;
    add_names(columns, points, holds.points, holds.alpha, "points");
    const element* const faces = file.attributes.find("face");
    if (!holds.has_faces || faces == nullptr) return columns;
    // Colors of an OBJ are those of its materials, in their file.
    const bool has_materials = format.extension == "obj" && !file.attributes.material_files.empty();
    // A single color of OFF: its number in a table, or lists.
    const bool is_off =
        format.extension == "off" && (faces->find("color_index") || faces->find("off_color"));
    add_names(columns, faces,
              is_off                                   ? held::all
              : has_materials                          ? held::colors
              : text && holds.faces == held::attribute ? held::none
                                                       : holds.faces,
              holds.alpha || has_materials, "faces");
    return columns;
}

[[nodiscard]] std::string corner_values_left_out(const holdings& holds, const corner_values& values,
                                                 const element* points) {
    const auto has = [&](std::string_view column) {
        return points != nullptr && points->find(column) != nullptr;
    };
    const bool has_texture = holds.texture || has("s") || has("u") || has("texture_u");
    const bool has_normals = holds.normals || has("nx") || has("normal_x") || has("NormalX");
    std::string corners;
    if (!values.texture_of_corner.empty()) {
        if (!has_texture)
            corners = "texture coordinates";
        else if (holds.texture && !holds.depth &&
                 std::ranges::any_of(values.texture, [](const auto& row) { return row[2] != 0.0; }))
            corners = "w of texture coordinates";
    }
    if (!values.normal_of_corner.empty() && !has_normals)
        corners += corners.empty() ? "normals" : " and normals";
    return corners.empty() ? corners : corners + " of corners";
}

/// Elements, names and lines.
[[nodiscard]] std::string rest_left_out(const known_format& format, const mesh_file& file,
                                        bool text) {
    const holdings& holds = format.holds;
    const attributes& all = file.attributes;
    std::string rest;
    const auto add = [&](bool there, const std::string& what) {
        if (there) rest += (rest.empty() ? "" : ", ") + what;
    };
    for (const element& e : all.elements)
        add(!holds.elements && e.name != "vertex" && e.name != "face" && e.rows > 0,
            "element " + e.name);
    const bool keeps_names = holds.names && (format.extension != "stl" || text);
    const auto is_named = [](const named_faces& p) {
        return !p.object.empty() || !p.group.empty();
    };
    // A name of all faces is that of the file, more or less.
    const bool has_parts =
        all.parts.size() > 1 || (!all.parts.empty() && all.parts[0].first_face > 0);
    add(!keeps_names && has_parts && std::ranges::any_of(all.parts, is_named), "names of parts");
    // Those of `add_source_columns` belong to its columns.
    const auto is_remark = [](const std::string& line) {
        return !line.starts_with("source_mesh ");
    };
    add(!holds.comments && std::ranges::any_of(all.comments, is_remark), "comments");
    const auto is_lost = [&](const std::string& line) {
        return !holds.remarks || (format.extension == "3mf" && !line.starts_with("unit "));
    };
    add(std::ranges::any_of(all.obj_info, is_lost), "remarks");
    add(!holds.system && file.las && has_system(*file.las), "the reference system of LAS");
    return rest;
}

/// Which column is which; empty where they have no names.
[[nodiscard]] std::string names_left_out(const element* points) {
    std::string names;
    bool is_named = false;
    if (points == nullptr) return names;
    for (const column& c : points->columns) {
        if (c.role != column_role::data || c.list_length) continue;
        names += ' ' + c.name;
        is_named = is_named || !c.name.starts_with("column_");
    }
    return is_named ? names : std::string();
}

}  // namespace

std::size_t count_loose_points(const mesh& m) {
    return m.points.size() - base::used_points(m.points.size(), m.faces).size();
}

std::vector<io_warning> left_out(const known_format& format, const mesh_file& file,
                                 const element* points, bool text) {
    const holdings& holds = format.holds;
    const attributes& all = file.attributes;
    std::string name(format.extension);
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    std::vector<io_warning> lost;
    const auto say = [&](const char* code, const std::string& what) {
        if (!what.empty()) lost.push_back({code, "not written to " + name + ": " + what});
    };
    say("columns-dropped", columns_left_out(format, file, points, text));
    if (!holds.has_faces && !file.mesh.faces.empty())
        lost.push_back({"faces-dropped", "faces left out: " + name + " holds points only"});
    say("corner-values", corner_values_left_out(holds, all.corners, points));
    const auto has_material = [](const named_faces& p) { return !p.material.empty(); };
    if (!holds.materials && std::ranges::any_of(all.parts, has_material))
        say("materials", "materials");
    if (!holds.texture_files && !all.texture_files.empty())
        say("materials", "names of texture files");
    say("data-dropped", rest_left_out(format, file, text));
    if (const std::size_t loose = format.extension == "stl" ? count_loose_points(file.mesh) : 0)
        lost.push_back({"data-dropped", std::to_string(loose) +
                                            (loose == 1 ? " point" : " points") +
                                            " without faces left out: STL holds faces only"});
    if (const std::string names = names_left_out(points);
        format.extension == "xyz" && !names.empty())
        lost.push_back({"columns", "XYZ has no column names; the columns are x y z" + names});
    return lost;
}

const known_format& find_format(const std::filesystem::path& path, const write_options& options) {
    std::string wanted =
        options.format.empty() ? extension_of(path) : plain_extension(options.format);
    if (wanted == "txt" || wanted == "asc" || wanted == "pts") wanted = "xyz";
    for (const known_format& f : formats)
        if (f.extension == wanted) return f;
    if (wanted.empty())
        throw io_error(path.string() + ": the path has no extension, and no format is given");
    throw io_error(path.string() + ": format '" + wanted + "' cannot be written");
}

}  // namespace treeform::detail::io
