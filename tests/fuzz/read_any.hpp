#pragma once
/// \file
/// What every reader promises for any bytes.

#include <libmesh/io/read.hpp>
#include <libmesh/io/write.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace tf::fuzz {

/// Reads the bytes as a file of that format. They are refused with io_error, or they are a mesh
/// whose corners are points, of a size in proportion to theirs, and which can be written again.
inline int read_any(const std::uint8_t* data, std::size_t size, const char* format) {
    try {
        const mesh_file file = read_mesh(std::as_bytes(std::span(data, size)), "fuzz", format);
        if (file.mesh.points.size() > size || file.mesh.faces.size() > size) std::abort();
        for (const face& f : file.mesh.faces)
            for (const std::uint32_t corner : f)
                if (corner >= file.mesh.points.size()) std::abort();
        (void)write_mesh_to_memory(file, {.format = "ply", .ascii = size % 2 == 0});
    } catch (const io_error&) {
        return -1;  // nothing to learn for the corpus
    }
    return 0;
}

}  // namespace tf::fuzz
