#pragma once
/// \file
/// The formats that are written.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/write.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

using writer = void (*)(const write_job&);
using points_starter = point_sink (*)(const write_job&, std::uint64_t count);

/// Which columns of an element a format holds.
enum class columns_held : std::uint8_t {
    none,
    attribute,  ///< "stl_attribute" of faces
    colors,
    looks,    ///< colors, normals and texture coordinates
    numbers,  ///< any with one value a row
    all       ///< lists, too
};

/// What a format holds of all that a file can have. What it does not hold is said to be left out.
struct holdings {
    columns_held points = columns_held::none;
    columns_held faces = columns_held::none;
    bool alpha = false;  ///< of colors
    bool has_faces = false;
    bool elements = false;  ///< of any name
    bool texture = false;   ///< coordinates of corners
    bool depth = false;     ///< a third of these
    bool normals = false;   ///< of corners
    bool names = false;     ///< of parts
    bool materials = false;
    bool texture_files = false;
    bool comments = false;
    bool remarks = false;  ///< the lines "obj_info"
    bool system = false;   ///< the reference system, and other records of LAS
};

struct known_format {
    std::string_view extension;
    std::string_view binary_name;  ///< empty when there is text only
    std::string_view text_name;    ///< empty when there is no text
    writer binary;
    writer text;
    bool single_only;          ///< the binary kind holds float32 only
    bool single_unless_asked;  ///< holds doubles, which its readers take for float32
    points_starter start;      ///< for points by runs; null when the format is not of points
    holdings holds{};
};

/// What the format does not hold of a file, a warning for each kind. `points` is the element
/// "vertex" in the words of the format, or null.
[[nodiscard]] std::vector<io_warning> left_out(const known_format& format, const mesh_file& file,
                                               const element* points, bool text);

/// \throws io_error when there is none for the options, else for the path
[[nodiscard]] const known_format& find_format(const std::filesystem::path& path,
                                              const write_options& options);

[[nodiscard]] inline bool writes_text(const known_format& format, const write_options& options) {
    return format.binary == nullptr || (options.ascii && format.text != nullptr);
}

}  // namespace treeform::detail::io
