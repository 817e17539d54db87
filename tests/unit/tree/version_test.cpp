#include <treeform/tf.hpp>
#include <treeform/tree/version.hpp>

#include <doctest/doctest.h>

#include <string>

TEST_CASE("version: the loaded library is the one of the headers") {
    CHECK(tf::version() == TREEFORM_VERSION);
    CHECK(std::string(tf::version_string()) == std::to_string(TREEFORM_VERSION_MAJOR) + "." +
                                                   std::to_string(TREEFORM_VERSION_MINOR) + "." +
                                                   std::to_string(TREEFORM_VERSION_PATCH));
}

TEST_CASE("version: numbers compare as versions do") {
    static_assert(TREEFORM_VERSION_OF(1, 0, 0) > TREEFORM_VERSION_OF(0, 999, 999));
    static_assert(TREEFORM_VERSION_OF(1, 2, 0) > TREEFORM_VERSION_OF(1, 1, 999));
    static_assert(TREEFORM_VERSION_OF(1, 2, 3) > TREEFORM_VERSION_OF(1, 2, 2));
}
