#pragma once
/// \file
/// The formats that are written.

#include <libmesh/io/writers.hpp>
#include <treeform/mesh/write.hpp>

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace treeform::detail::io {

using writer = void (*)(const write_job&);
using points_starter = point_sink (*)(const write_job&, std::uint64_t count);

struct known_format {
    std::string_view extension;
    std::string_view binary_name;  ///< empty when there is text only
    std::string_view text_name;    ///< empty when there is no text
    writer binary;
    writer text;
    bool single_only;          ///< the binary kind holds float32 only
    bool single_unless_asked;  ///< holds doubles, which its readers take for float32
    points_starter start;      ///< for points by runs; null when the format is not of points
};

/// \throws io_error when there is none for the options, else for the path
[[nodiscard]] const known_format& find_format(const std::filesystem::path& path,
                                              const write_options& options);

[[nodiscard]] inline bool writes_text(const known_format& format, const write_options& options) {
    return format.binary == nullptr || (options.ascii && format.text != nullptr);
}

}  // namespace treeform::detail::io
