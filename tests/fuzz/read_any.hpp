#pragma once
/// \file
/// What every reader promises for any bytes.

#include <treeform/mesh/read.hpp>
#include <treeform/mesh/write.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

namespace treeform::fuzz {

/// Reads the bytes as a file of that format. They are refused with io_error, or they are a mesh
/// whose corners are points, of a size in proportion to theirs, and which can be written again.
inline int read_any(const std::uint8_t* data, std::size_t size, const char* format) {
    try {
        const mesh_file file = read(std::as_bytes(std::span(data, size)), "fuzz", format);
        // Packed points can be more than bytes, but no more often than that; and of scenes many
        // nodes may show one mesh.
        const std::size_t most_ratio = std::string_view(format) == "las" ? 4096 : 32;
        const bool scene = std::string_view(format) == "glb" || std::string_view(format) == "3mf";
        if (!scene &&
            (file.mesh.points.size() / most_ratio > size || file.mesh.faces.size() > size))
            std::abort();
        for (const face& f : file.mesh.faces)
            for (const std::uint32_t corner : f)
                if (corner >= file.mesh.points.size()) std::abort();
        for (const char* const to : {"ply", format})
            if (std::string_view(to) != "stl" || !file.mesh.faces.empty())
                (void)write_to_memory(file, {.format = to, .ascii = size % 2 == 0});
    } catch (const io_error&) {
        return -1;  // nothing to learn for the corpus
    }
    return 0;
}

/// What is written of bytes that were read must be written of it again once it has been read;
/// except for names with bytes that let a short text look like binary data.
inline void check_round_trip(const std::uint8_t* data, std::size_t size,
                             const write_options& options) {
    const auto written = [&](std::span<const std::byte> bytes) {
        return write_to_memory(read(bytes, "fuzz", options.format), options);
    };
    const std::string once = written(std::as_bytes(std::span(data, size)));
    const auto is_odd = [](char c) { return c >= '\0' && c < ' ' && c != '\n'; };
    if (std::any_of(once.begin(), once.end(), is_odd)) return;
    if (written(std::as_bytes(std::span(once))) != once) std::abort();
}

}  // namespace treeform::fuzz
