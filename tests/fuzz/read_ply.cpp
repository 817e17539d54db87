#include "read_any.hpp"
#include <treeform/tf.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int result = tf::fuzz::read_any(data, size, "ply");
    if (result == 0) tf::fuzz::check_round_trip(data, size, {.format = "ply", .ascii = true});
    return result;
}
