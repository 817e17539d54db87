#pragma once
/// \file
/// Checks the nesting depth of JSON before it is parsed.

#include <libmesh/io/source.hpp>

#include <string_view>

namespace treeform::detail::io {

/// Refuses JSON, a part of `in`, that nests deeper than any legitimate file. Other errors are left
/// to the parser.
///
/// \throws io_error naming the byte
void refuse_deep_json(const source& in, std::string_view json);

}  // namespace treeform::detail::io
