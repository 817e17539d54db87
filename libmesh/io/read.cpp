#include <libmesh/attributes/known_columns.hpp>
#include <libmesh/base/point_math.hpp>
#include <libmesh/io/detect.hpp>
#include <libmesh/io/readers.hpp>
#include <treeform/mesh/read.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace treeform {

namespace detail::io {

namespace {

/// Number of stored faces with a triangle oriented against the whole face, as in a concave polygon.
/// Deviations below rounding errors do not count.
///
/// \cost O(F); O(1) if all faces are triangles
std::size_t count_concave_faces(const mesh_file& file) {
    constexpr double noise = 1e-6;  // of the face's area, which bounds what rounding turns over
    const std::vector<std::uint32_t>& stored = file.face_of_triangle;
    std::size_t count = 0;
    std::vector<point3> areas;
    for (std::size_t first = 0; first < stored.size();) {
        std::size_t last = first + 1;
        while (last < stored.size() && stored[last] == stored[first]) ++last;
        areas.clear();
        point3 all{};
        for (std::size_t f = first; f < last && last - first > 1; ++f) {
            const auto [a, b, c] = base::triangle_of(file.mesh.points, file.mesh.faces[f]);
            areas.push_back(base::cross(base::minus(b, a), base::minus(c, a)));
            all = base::plus(all, areas.back());
        }
        const double whole = base::dot(all, all);
        const auto is_turned = [&](const point3& a) { return base::dot(a, all) < -noise * whole; };
        if (std::ranges::any_of(areas, is_turned)) ++count;
        first = last;
    }
    return count;
}

[[nodiscard]] mesh_file read_as_is(const source& in, const std::filesystem::path& path,
                                   const reading& how, const std::string& extension) {
    using enum file_kind;
    const auto [kind, of_scene] = detect(in, plain_extension(how.format), extension);
    check_chosen_columns(in, how, kind);
    const std::string_view table = table_name(kind);
    if (!table.empty()) return read_xyz(in, table, how.options.columns);
    if (kind == stl_binary) return read_stl_binary(in);
    if (kind == stl_text) return read_stl_text(in);
    if (kind == obj) return read_obj(in, path);
    if (kind == ply) return read_ply(in);
    if (kind == off) return read_off(in);
    if (kind == pcd) return read_pcd(in);
    if (kind == las) return read_las(in);
    if (kind == package_3mf) return read_3mf(in);
    if (kind == gltf) return read_gltf(in, path);
    return read_scene(in, path, of_scene);
}

[[nodiscard]] mesh_file read_any(const source& in, const std::filesystem::path& path,
                                 const reading& how, const std::string& extension) {
    mesh_file file = read_as_is(in, path, how, extension);
    if (const std::size_t concave = count_concave_faces(file))
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
        attribute::look_at_ranges(*points, file.ranges);
    return file;
}

}  // namespace

}  // namespace detail::io

mesh_file read(const std::filesystem::path& path, std::string_view format,
               const read_options& options) {
    return detail::io::read_any(detail::io::source::open(path),
                                path == "-" ? std::filesystem::path() : path,
                                {std::string(format), options}, detail::io::extension_of(path));
}

mesh_file read(std::span<const std::byte> bytes, std::string_view name, std::string_view format,
               const read_options& options) {
    return detail::io::read_any(detail::io::source(bytes, name), {}, {std::string(format), options},
                                detail::io::extension_of(name));
}

}  // namespace treeform
