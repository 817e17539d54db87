#include "read_any.hpp"
#include <treeform/tf.hpp>

#include <support/packages.hpp>

#include <string>
#include <string_view>

/// A package, or the text of its model part: what is changed in a package seldom gets past its
/// checksums.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (bytes.starts_with("PK")) return tf::fuzz::read_any(data, size, "3mf");
    const std::string package = test::package_3mf(std::string(bytes));
    return tf::fuzz::read_any(reinterpret_cast<const std::uint8_t*>(package.data()), package.size(),
                              "3mf");
}
