#include "read_any.hpp"
#include <treeform/tf.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return tf::fuzz::read_any(data, size, "las");
}
