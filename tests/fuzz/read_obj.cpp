#include "read_any.hpp"

#include <cstdlib>
#include <string>

namespace {

/// What is written of a mesh that was read is written of it again once it has been read.
void check_round_trip(std::span<const std::byte> bytes) {
    const tf::write_options as_obj{.format = "obj"};
    const std::string once = tf::write_mesh_to_memory(tf::read_mesh(bytes, "fuzz", "obj"), as_obj);
    const std::string twice = tf::write_mesh_to_memory(
        tf::read_mesh(std::as_bytes(std::span(once)), "again", "obj"), as_obj);
    if (once != twice) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int result = tf::fuzz::read_any(data, size, "obj");
    if (result == 0) check_round_trip(std::as_bytes(std::span(data, size)));
    return result;
}
