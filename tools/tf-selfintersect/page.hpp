#pragma once
/// \file
/// The findings as an HTML page.

#include "tools/common/output_file.hpp"
#include "tools/tf-selfintersect/search.hpp"

namespace tools {

void write_page(output_file& file, const job& work, const findings& result,
                const search_settings& settings);

}  // namespace tools
