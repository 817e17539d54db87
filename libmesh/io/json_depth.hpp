#pragma once
/// \file
/// A look at JSON before a parser gets it.

#include <libmesh/io/source.hpp>

#include <string_view>

namespace treeform::detail::io {

/// Refuses JSON, a part of `in`, that nests so deeply that no honest file does. JSON that is wrong
/// otherwise is left to the parser.
///
/// \throws io_error naming the byte
void refuse_deep_json(const source& in, std::string_view json);

}  // namespace treeform::detail::io
