#pragma once
/// \file
/// The version of the treeform headers, and of the loaded library.

#include <treeform/tree/detail/export.hpp>

// The only place where the version is written: the build reads it from these three lines.
#define TREEFORM_VERSION_MAJOR 0
#define TREEFORM_VERSION_MINOR 1
#define TREEFORM_VERSION_PATCH 0

/// The number of a version, for comparisons:
/// `#if TREEFORM_VERSION >= TREEFORM_VERSION_OF(1, 2, 0)`.
#define TREEFORM_VERSION_OF(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))

/// The version of the headers.
#define TREEFORM_VERSION \
    TREEFORM_VERSION_OF(TREEFORM_VERSION_MAJOR, TREEFORM_VERSION_MINOR, TREEFORM_VERSION_PATCH)

namespace treeform {

/// The version of the loaded library, comparable with `TREEFORM_VERSION`. The two differ if a
/// program runs with a shared library of another version than its headers.
[[nodiscard]] TREEFORM_API int version() noexcept;

/// The same as text: "0.1.0".
[[nodiscard]] TREEFORM_API const char* version_string() noexcept;

}  // namespace treeform
