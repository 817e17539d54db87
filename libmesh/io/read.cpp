#include <libmesh/io/detail/detect.hpp>
#include <libmesh/io/detail/extension.hpp>
#include <libmesh/io/detail/readers.hpp>
#include <libmesh/io/read.hpp>

#include <string>

namespace tf {

namespace {

[[nodiscard]] mesh_file read_mesh(const detail::source& in, const std::filesystem::path& path,
                                  std::string_view format, const std::string& extension) {
    const detail::detected found = detail::detect(in, detail::plain_extension(format), extension);
    switch (found.kind) {
        case detail::file_kind::stl_binary:
            return detail::read_stl_binary(in);
        case detail::file_kind::stl_text:
            return detail::read_stl_text(in);
        case detail::file_kind::obj:
            return detail::read_obj(in);
        case detail::file_kind::ply:
            return detail::read_ply(in);
        case detail::file_kind::off:
            return detail::read_off(in);
        case detail::file_kind::pcd:
            return detail::read_pcd(in);
        case detail::file_kind::xyz:
            return detail::read_xyz(in, "xyz");
        case detail::file_kind::csv:
            return detail::read_xyz(in, "csv");
        case detail::file_kind::scene:
            break;
    }
    return detail::read_scene(in, path, found.extension);
}

}  // namespace

mesh_file read_mesh(const std::filesystem::path& path, std::string_view format) {
    const detail::source in = detail::source::open(path);
    return read_mesh(in, path == "-" ? std::filesystem::path() : path, format,
                     detail::extension_of(path));
}

mesh_file read_mesh(std::span<const std::byte> bytes, std::string_view name,
                    std::string_view format) {
    const detail::source in(bytes, name);
    return read_mesh(in, {}, format, detail::extension_of(name));
}

}  // namespace tf
