#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/io/concave_faces.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/extension.hpp>
#include <libmesh/io/material_colors.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/reading.hpp>
#include <treeform/mesh/read.hpp>

#include <string>

namespace treeform {

namespace {

[[nodiscard]] mesh_file read_obj(const detail::io::source& in, const std::filesystem::path& path) {
    mesh_file file = detail::io::read_obj(in);
    detail::io::add_material_colors(file, path);
    return file;
}

[[nodiscard]] mesh_file read_as_is(const detail::io::source& in, const std::filesystem::path& path,
                                   const detail::io::reading& how, const std::string& extension) {
    const detail::io::detected found =
        detail::io::detect(in, detail::io::plain_extension(how.format), extension);
    detail::io::check_chosen_columns(in, how, found.kind);
    switch (found.kind) {
        case detail::io::file_kind::stl_binary:
            return detail::io::read_stl_binary(in);
        case detail::io::file_kind::stl_text:
            return detail::io::read_stl_text(in);
        case detail::io::file_kind::obj:
            return read_obj(in, path);
        case detail::io::file_kind::ply:
            return detail::io::read_ply(in);
        case detail::io::file_kind::off:
            return detail::io::read_off(in);
        case detail::io::file_kind::pcd:
            return detail::io::read_pcd(in);
        case detail::io::file_kind::las:
            return detail::io::read_las(in);
        case detail::io::file_kind::xyz:
            return detail::io::read_xyz(in, "xyz", how.options.columns);
        case detail::io::file_kind::pts:
            return detail::io::read_xyz(in, "pts", how.options.columns);
        case detail::io::file_kind::csv:
            return detail::io::read_xyz(in, "csv", how.options.columns);
        case detail::io::file_kind::package_3mf:
            return detail::io::read_3mf(in);
        case detail::io::file_kind::gltf:
            return detail::io::read_gltf(in, path);
        case detail::io::file_kind::scene:
            break;
    }
    return detail::io::read_scene(in, path, found.extension);
}

[[nodiscard]] mesh_file read(const detail::io::source& in, const std::filesystem::path& path,
                             const detail::io::reading& how, const std::string& extension) {
    mesh_file file = read_as_is(in, path, how, extension);
    if (const std::size_t concave = detail::io::count_concave_faces(file))
        file.warnings.push_back(
            {"concave-faces", std::to_string(concave) + (concave == 1 ? " face is" : " faces are") +
                                  " not convex: triangles of their fan from the first corner "
                                  "overlap"});
    const std::size_t dropped = how.options.drop_non_finite ? file.drop_non_finite() : 0;
    if (dropped > 0)
        file.warnings.push_back({"non-finite", std::to_string(dropped) +
                                                   (dropped == 1 ? " point" : " points") +
                                                   " with a NaN or infinite coordinate dropped"});
    if (const element* points = file.attributes.find("vertex"))
        detail::attribute::look_at_ranges(*points, file.ranges);
    return file;
}

}  // namespace

mesh_file read(const std::filesystem::path& path, std::string_view format,
               const read_options& options) {
    const detail::io::source in = detail::io::source::open(path);
    return read(in, path == "-" ? std::filesystem::path() : path, {std::string(format), options},
                detail::io::extension_of(path));
}

mesh_file read(std::span<const std::byte> bytes, std::string_view name, std::string_view format,
               const read_options& options) {
    const detail::io::source in(bytes, name);
    return read(in, {}, {std::string(format), options}, detail::io::extension_of(name));
}

}  // namespace treeform
