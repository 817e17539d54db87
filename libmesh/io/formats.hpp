#pragma once
/// \file
/// The formats that can be written.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/write.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace treeform::detail::io {

using writer = void (*)(const write_job&);
using points_starter = point_sink (*)(const write_job&, std::uint64_t count);

/// The columns of an element that a format can store.
enum class columns_held : std::uint8_t {
    none,
    attribute,  ///< "stl_attribute" of faces
    colors,
    looks,    ///< colors, normals and texture coordinates
    numbers,  ///< any column with one value a row
    all       ///< lists, too
};

/// The content that a format can store. Warnings list the rest.
struct holdings {
    columns_held points = columns_held::none;
    columns_held faces = columns_held::none;
    bool alpha = false;  ///< alpha channels of colors
    bool has_faces = false;
    bool elements = false;  ///< elements of any name
    bool texture = false;   ///< texture coordinates of corners
    bool depth = false;     ///< a third texture coordinate
    bool normals = false;   ///< normals of corners
    bool names = false;     ///< names of parts
    bool materials = false;
    bool texture_files = false;
    bool comments = false;
    bool remarks = false;  ///< the lines "obj_info"
    bool system = false;   ///< the coordinate system, and other records of LAS
};

struct known_format {
    std::string_view extension;
    std::string_view binary_name;  ///< empty for text-only formats
    std::string_view text_name;    ///< empty for binary-only formats
    writer binary;
    writer text;
    bool single_only;  ///< the binary variant only has float32
    /// has doubles, but most readers convert them to float32; so the default is float32
    bool single_unless_asked;
    points_starter start;  ///< for points in blocks; null if the format has no points
    holdings holds{};
};

/// Points of no face.
[[nodiscard]] std::size_t count_loose_points(const mesh& m);

/// The content of a file that the format cannot store, as a warning for each kind. `points` is the
/// element "vertex" with the column names of the format, or null.
[[nodiscard]] std::vector<io_warning> left_out(const known_format& format, const mesh_file& file,
                                               const element* points, bool text);

/// \throws io_error if there is no format for the options or, without them, for the path
[[nodiscard]] const known_format& find_format(const std::filesystem::path& path,
                                              const write_options& options);

[[nodiscard]] inline bool writes_text(const known_format& format, const write_options& options) {
    return format.binary == nullptr || (options.ascii && format.text != nullptr);
}

}  // namespace treeform::detail::io
