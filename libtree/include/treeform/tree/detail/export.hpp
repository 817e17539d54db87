#pragma once
/// \file
/// Symbols of the compiled libraries that callers may use; everything else is hidden.

#define TREEFORM_API __attribute__((visibility("default")))
