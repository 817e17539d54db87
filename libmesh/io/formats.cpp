#include <libmesh/io/extension.hpp>
#include <libmesh/io/formats.hpp>

namespace treeform::detail::io {

namespace {

constexpr known_format formats[] = {
    {"stl", "stl-binary", "stl-ascii", write_stl_binary, write_stl_text, true, false, nullptr},
    {"obj", "", "obj", nullptr, write_obj, false, false, start_obj_points},
    {"ply", "ply-binary-le", "ply-ascii", write_ply, write_ply, false, false, start_ply_points},
    {"off", "", "off", nullptr, write_off, false, false, nullptr},
    {"xyz", "", "xyz", nullptr, write_xyz, false, false, start_xyz_points},
    {"csv", "", "csv", nullptr, write_csv, false, false, start_csv_points},
    {"pcd", "pcd-binary", "pcd-ascii", write_pcd, write_pcd, false, false, start_pcd_points},
    {"las", "las", "", write_las, nullptr, false, false, start_las_points},
    {"laz", "laz", "", write_laz, nullptr, false, false, start_laz_points},
    {"glb", "glb", "", write_glb, nullptr, true, false, nullptr},
    {"3mf", "3mf", "", write_3mf, nullptr, false, true, nullptr},
};

}  // namespace

const known_format& find_format(const std::filesystem::path& path, const write_options& options) {
    std::string wanted =
        options.format.empty() ? extension_of(path) : plain_extension(options.format);
    if (wanted == "txt" || wanted == "asc" || wanted == "pts") wanted = "xyz";
    for (const known_format& f : formats)
        if (f.extension == wanted) return f;
    throw io_error(path.string() + ": format '" + wanted + "' cannot be written");
}

}  // namespace treeform::detail::io
